liblambert_a_SOURCES += \
	%D%/cache.c %D%/cache.h %D%/fill.c %D%/fill.h %D%/gather.c %D%/gather.h %D%/store.c %D%/store.h
