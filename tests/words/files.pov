#version 3.7;
global_settings { assumed_gamma 1 charset utf8 }
#fopen Out "lambert-words.tmp" write
#write (Out, 1, ",")
#write (Out, uint8 1, sint8 -1, uint16be 1, uint16le 1, sint16be 1, sint16le 1, sint32be 1, sint32le 1)
#fclose Out
#fopen Out "lambert-words.tmp" append
#fclose Out
#fopen In "lambert-words.tmp" read
#read (In, One)
