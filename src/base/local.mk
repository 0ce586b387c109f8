liblambert_a_SOURCES += \
	%D%/arena.c %D%/arena.h \
	%D%/clock.h %D%/digest.h \
	%D%/memory.c %D%/memory.h \
	%D%/diag.c %D%/diag.h %D%/diagnostics.def \
	%D%/library.c %D%/library.h \
	%D%/parallel.c %D%/parallel.h \
	%D%/read_text.c %D%/read_text.h \
	%D%/source.c %D%/source.h \
	%D%/stack.c %D%/stack.h \
	%D%/watch.h \
	%D%/whole_file.c %D%/whole_file.h
