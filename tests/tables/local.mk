# All rows of the tables of values that POV-Ray 3.7 gave.
TESTS += %D%/values.sh %D%/surfaces.sh
EXTRA_DIST += %D%/values.sh %D%/surfaces.sh tests/data/surface-values.tsv \
	tests/data/gray8.png tests/data/graya8.png tests/data/img4x3.pgm \
	tests/data/img4x3.ppm tests/data/pal.gif tests/data/pal.png \
	tests/data/rgb16.png tests/data/rgba8.png
