gallery_scenes = \
	%D%/gallery/csg.scn %D%/gallery/glass.scn %D%/gallery/mirrors.scn \
	%D%/gallery/quadrics.scn %D%/gallery/sponge.scn %D%/gallery/spots.scn

EXTRA_DIST += %D%/radiosity/room.scn %D%/gallery/montage.sh doc/architecture.md doc/gallery.png doc/room.png \
	doc/examples.md doc/optimisation.md doc/performance.md doc/radiosity.md doc/testing.md
gallerydir = $(pkgdatadir)/gallery
dist_gallery_DATA = $(gallery_scenes)

scene_includesdir = $(pkgdatadir)/include
dist_scene_includes_DATA = \
	%D%/include/arrays.inc %D%/include/colors.inc %D%/include/consts.inc \
	%D%/include/debug.inc %D%/include/finish.inc %D%/include/functions.inc \
	%D%/include/glass.inc %D%/include/glass_old.inc %D%/include/golds.inc \
	%D%/include/ior.inc %D%/include/makegrass.inc %D%/include/math.inc \
	%D%/include/meshmaker.inc %D%/include/metals.inc %D%/include/rad_def.inc \
	%D%/include/rand.inc %D%/include/screen.inc %D%/include/shapes.inc \
	%D%/include/shapes2.inc %D%/include/shapes3.inc %D%/include/shapes_old.inc \
	%D%/include/shapesq.inc %D%/include/skies.inc %D%/include/stage1.inc \
	%D%/include/stars.inc %D%/include/stdcam.inc %D%/include/stdinc.inc \
	%D%/include/stoneold.inc %D%/include/stones.inc %D%/include/stones1.inc \
	%D%/include/stones2.inc %D%/include/strings.inc %D%/include/sunpos.inc \
	%D%/include/textures.inc %D%/include/transforms.inc %D%/include/woodmaps.inc \
	%D%/include/woods.inc
