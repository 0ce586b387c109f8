liblambert_a_SOURCES += \
	%D%/arena.c %D%/arena.h \
	%D%/diag.c %D%/diag.h %D%/diagnostics.def \
	%D%/source.c %D%/source.h \
	%D%/stack.c %D%/stack.h
