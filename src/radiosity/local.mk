liblambert_a_SOURCES += \
	%D%/chart.c %D%/chart.h %D%/clear.c %D%/patch_count.c %D%/patch_trace.c %D%/patches.c %D%/patches.h %D%/rooms.c \
	%D%/enclosure.h %D%/factor_hemicube.c %D%/factor_nodes.c %D%/factor_nodes.h %D%/factor_pair.c %D%/factor_rays.c \
	%D%/factors.c %D%/form_factor.h %D%/form_factors.def %D%/hemicube.h %D%/hulls.c \
	%D%/polygon.c %D%/polygon.h %D%/ray_put.h \
	%D%/display.c %D%/elements.c %D%/emitters.c %D%/error_target.c %D%/lamps.c %D%/radiosity.c %D%/radiosity.h %D%/store.c %D%/volume.c \
	%D%/probe.c %D%/prune.c %D%/refine.c %D%/shafts.c \
	%D%/sequence.c %D%/sequence.h %D%/solve_dense.c %D%/solve_gather.c %D%/solve_gather.h %D%/solve_hierarchical.c \
	%D%/solve_smooth.c %D%/solve_smooth.h \
	%D%/solve_shoot.c %D%/solve_stochastic.c %D%/solve_sweep.c %D%/solver.c \
	%D%/solver.h %D%/solvers.def
