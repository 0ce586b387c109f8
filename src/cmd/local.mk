# Built by `make lambert` until every stage that it links is there.
EXTRA_PROGRAMS = lambert
lambert_SOURCES = \
	%D%/args.c %D%/cmd.h %D%/compare.c %D%/help.c %D%/ini.c %D%/main.c %D%/output.c \
	%D%/process.c %D%/progress.c %D%/render.c %D%/scenes.c
lambert_LDADD = $(lambert_libs)
