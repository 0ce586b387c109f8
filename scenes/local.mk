gallery_scenes = \
	%D%/gallery/csg.scn %D%/gallery/glass.scn %D%/gallery/mirrors.scn \
	%D%/gallery/quadrics.scn %D%/gallery/sponge.scn %D%/gallery/spots.scn

EXTRA_DIST += %D%/gallery/montage.sh doc/architecture.md doc/gallery.png \
	doc/performance.md doc/testing.md
gallerydir = $(pkgdatadir)/gallery
dist_gallery_DATA = $(gallery_scenes)
