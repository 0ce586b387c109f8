gallery_scenes = \
	%D%/gallery/csg.scn %D%/gallery/glass.scn %D%/gallery/mirrors.scn \
	%D%/gallery/quadrics.scn %D%/gallery/sponge.scn %D%/gallery/spots.scn

gallerydir = $(pkgdatadir)/gallery
dist_gallery_DATA = $(gallery_scenes)
