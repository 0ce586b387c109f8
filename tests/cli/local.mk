EXTRA_DIST += \
	%D%/common.sh %D%/clear_shadows.sh %D%/commands.sh %D%/continue.sh %D%/coincident.sh %D%/contact.sh %D%/deep.sh \
	%D%/files.sh %D%/format.sh %D%/images.sh %D%/include_hints.sh %D%/interrupt.sh %D%/mesh.sh \
	%D%/mesh2.sh %D%/options.sh %D%/patches.sh %D%/photons.sh %D%/samples.sh %D%/radiosity.sh %D%/scene_files.sh
TESTS += \
	%D%/clear_shadows.sh %D%/commands.sh %D%/continue.sh %D%/coincident.sh %D%/contact.sh %D%/deep.sh %D%/files.sh \
	%D%/format.sh %D%/images.sh %D%/include_hints.sh %D%/interrupt.sh %D%/mesh.sh %D%/mesh2.sh \
	%D%/options.sh %D%/patches.sh %D%/photons.sh %D%/samples.sh %D%/radiosity.sh %D%/scene_files.sh
