liblambert_a_SOURCES += \
	%D%/ast.h %D%/keywords.def %D%/parse.h %D%/stream.h %D%/token.h
