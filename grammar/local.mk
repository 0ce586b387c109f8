# sources of grammar
