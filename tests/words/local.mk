# A minimal scene for every word that no other test has.
TESTS += %D%/words.sh %D%/mistakes.sh
EXTRA_DIST += %D%/mistakes.out %D%/mistakes.sh %D%/mistakes.tsv %D%/words.sh %D%/words.tsv \
	%D%/atmosphere.pov \
	%D%/blob.pov \
	%D%/blocks-of-colours.pov \
	%D%/bokeh.pov \
	%D%/camera.pov \
	%D%/cameras.pov \
	%D%/conic-sweep.pov \
	%D%/deprecated.pov \
	%D%/files.pov \
	%D%/finish.pov \
	%D%/global.pov \
	%D%/images.pov \
	%D%/lights.pov \
	%D%/material-map.pov \
	%D%/media.pov \
	%D%/mesh-camera.pov \
	%D%/modifiers.pov \
	%D%/patterns.pov \
	%D%/photons.pov \
	%D%/radiosity.pov \
	%D%/shapes.pov \
	%D%/subsurface.pov \
	%D%/warps.pov
