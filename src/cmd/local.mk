bin_PROGRAMS += lambert
lambert_SOURCES = \
	%D%/args.c %D%/check.c %D%/cmd.h %D%/commands.c %D%/compare.c %D%/format.c %D%/heap.c %D%/help.c %D%/ini.c %D%/main.c %D%/mesh.c %D%/output.c \
	%D%/process.c %D%/progress.c %D%/render.c %D%/report.c %D%/report.h %D%/scenes.c %D%/stats.c %D%/streams.c
lambert_LDADD = $(lambert_libs)

# The manual page and the completion come from the table of options.
lambert.1: lambert$(EXEEXT)
	$(AM_V_GEN)./lambert$(EXEEXT) --man > $@.part && mv $@.part $@
lambert.bash: lambert$(EXEEXT)
	$(AM_V_GEN)./lambert$(EXEEXT) --completion=bash > $@.part && mv $@.part $@
nodist_man_MANS = lambert.1
bashcompletiondir = $(datadir)/bash-completion/completions
nodist_bashcompletion_DATA = lambert.bash
CLEANFILES += lambert.1 lambert.bash
# Completion is looked up by the name of the command.
install-data-hook:
	cd $(DESTDIR)$(bashcompletiondir) && mv -f lambert.bash lambert
uninstall-hook:
	rm -f $(DESTDIR)$(bashcompletiondir)/lambert
