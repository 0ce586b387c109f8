liblambert_a_SOURCES += \
	%D%/builder.h %D%/eval.h %D%/value.h
