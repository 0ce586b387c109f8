liblambert_a_SOURCES += %D%/parser.y %D%/lexer.l %D%/nodes.h

# Everything that includes "parser.h" waits for bison.
BUILT_SOURCES += %D%/parser.h
