# A scene for each file of scenes/include, and the values of macros.
TESTS += %D%/includes.sh
EXTRA_DIST += %D%/includes.sh \
	%D%/arrays.scn \
	%D%/colors.scn \
	%D%/consts.scn \
	%D%/debug.scn \
	%D%/finish.scn \
	%D%/functions.scn \
	%D%/glass.scn \
	%D%/glass_old.scn \
	%D%/golds.scn \
	%D%/ior.scn \
	%D%/makegrass.scn \
	%D%/math.scn \
	%D%/meshmaker.scn \
	%D%/metals.scn \
	%D%/rad_def.scn \
	%D%/rand.scn \
	%D%/screen.scn \
	%D%/shapes.scn \
	%D%/shapes2.scn \
	%D%/shapes3.scn \
	%D%/shapes_old.scn \
	%D%/shapesq.scn \
	%D%/skies.scn \
	%D%/stage1.scn \
	%D%/stars.scn \
	%D%/stdcam.scn \
	%D%/stdinc.scn \
	%D%/stoneold.scn \
	%D%/stones.scn \
	%D%/stones1.scn \
	%D%/stones2.scn \
	%D%/strings.scn \
	%D%/sunpos.scn \
	%D%/textures.scn \
	%D%/transforms.scn \
	%D%/woodmaps.scn \
	%D%/woods.scn \
	%D%/values/math.scn %D%/values/math.txt \
	%D%/values/colors.scn %D%/values/colors.txt \
	%D%/values/transforms.scn %D%/values/transforms.txt
