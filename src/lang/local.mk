liblambert_a_SOURCES += \
	%D%/ast.c %D%/ast.h %D%/bulk.c %D%/bulk.h %D%/directive.c %D%/format.c %D%/format.h %D%/keywords.def %D%/literal.c %D%/literal.h %D%/lex_print.c %D%/lexeme.h %D%/lexer.h %D%/macro.c %D%/macro.h \
	%D%/number.c %D%/number.h %D%/output.c %D%/parse.c %D%/parse.h %D%/parse_error.c %D%/parse_state.h %D%/parse_token.c %D%/scan.h \
	%D%/stream.c %D%/stream.h %D%/stream_state.h %D%/token.c %D%/token.h
