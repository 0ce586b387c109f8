#!/bin/sh
# What a scene reads, writes and asks of objects while it is read.
. "${top_srcdir:-.}/tests/cli/common.sh"
reads() { exits 0 "$lambert" --dump-csg "$@"; }
says() { reads "$1" && has err "$2"; }

cat >write.pov <<'EOS'
#fopen F "text" write
#write(F,1,",",1/3," ",1e10,<1,2>,<1,2,3>,"\n",<1/3,2,3,4>,<1,2,3,4,5>,"a\"b",-7)
#fclose F
#fopen F "text" append
#write(F, uint8 1 300 -2 2.5, uint8 (65) 66 300, sint16le -2, uint16be 258, sint8 -128.6 3,-2)
#fclose F
EOS
printf '1,0.333333 1e+10<1,2> <1,2,3> \n<0.333333,2,3,4> <1,2,3,4,5> a"b-7' >want
printf '\001\377\003AB\377\376\377\001\002\200\003-2' >>want
check "write and append" reads write.pov
check "the bytes are POV-Ray's" cmp text want
mkdir folder
mv write.pov folder
rm text
check "in the working directory without -o" reads folder/write.pov
check "as POV-Ray has it" cmp text want
rm text
mv folder/write.pov .
check "below the folder of the picture" reads write.pov -o folder/x.png
check "not in the working directory then" cmp folder/text want

printf '\377\376s\0p\0h\0e\0r\0e\0' >utf16.pov
utf16() { exits 1 "$lambert" check utf16.pov && has err "utf16.pov:1:1: error: this file is UTF-16: save it as UTF-8"; }
check "UTF-16 is told so, once" utf16

cat >data <<'EOS'
1, -2.5, <1,2,3>, "he\"l\\lo", +3e2, // a comment
7 8 9, 10
EOS
cat >read.pov <<'EOS'
#macro S(X) #debug concat(str(X,0,2)," ") #end
#declare V = array[3] {1,2,3}
#fopen F "data" read
#read(F,A,B,C,D) #debug concat(str(A,0,3)," ",str(B,0,3)," ",vstr(3,C,",",0,2)," ",D," ")
#read(F,V[1],V[2]) S(V[1]) S(V[2])
#declare Q = 99;
#read(F,A) #ifdef(F) #debug "open " #end
#read(F,A,Q) S(A) S(Q) #ifndef(F) #debug "closed" #end
#fopen F "made" write #write(F,"1,2,") #fclose F
#fopen F "made" read
#while (defined(F)) #read(F,A) S(A) #end
#debug "\n"
EOS
check "read" says read.pov '^1.000 -2.500 1.00,2.00,3.00 he"l\\lo 300.00 7.00 open 10.00 99.00 closed1.00 2.00 2.00 $'

outside() { echo "#fopen F \"$1\" write #write(F,1)" >bad.pov; exits 1 "$lambert" --dump-csg bad.pov && has err "'$1'.*$2"; }
check "not above the folder" outside ../x "may write in"
check "not elsewhere" outside /etc/lambert-test "may write in"
has_hint() { has err 'permit-write DIR'; }
check "the option is named" has_hint
ln -s "$work/../nowhere" link
check "not through a link" outside link "cannot be opened"
ln -s / root
check "nor through a folder that is one" outside root/x "may write in"
check "a folder that is not there" outside none/x "cannot be opened"
mkdir -p d/below other
writes() { echo "#fopen F \"$1\" write #write(F,1)" >ok.pov; shift; exits 0 "$lambert" --dump-csg ok.pov "$@"; }
check "a permitted folder" writes "$work/other/x" -o d/p.png --permit-write other
check "it is written" test -s other/x
check "the scene's own folder by its whole name" writes "$work/own" -o d/p.png
check "it is written there" test -s own
check "one of several" writes ../other/y -o d/p.png --permit-write d/below --permit-write "$work/other/"
check "a folder whose name begins alike" outside "$work/other2/x" "cannot be opened\|may write in"
mkdir other2 && echo '#declare Got = 3;' >other2/in.inc
granted() { echo "$1" >d/r.pov; shift; (cd d && exits 0 "$lambert" --dump-csg r.pov "$@"); }
include='#include "../other2/in.inc"'
check "reading is free" granted "$include"
in_d() { echo "$1" >d/r.pov; shift; (cd d && exits 1 "$lambert" --dump-csg r.pov "$@" && has err 'permit-read DIR'); }
check "unless restricted: an include" in_d "$include" --restrict-read
check "a data file" in_d '#fopen F "../other2/in.inc" read' --restrict-read
printf 'P2 1 1 255 0\n' >other2/i.pgm
check "a picture" in_d 'sphere { 0, 1 pigment { image_map { pgm "../other2/i.pgm" } } }' --permit-read ../other
check "a permitted one" granted "$include" --permit-read ../other2
check "the library path" granted '#include "in.inc"' --restrict-read +L../other2
ln -s ../other2/in.inc d/link.inc
check "not through a link" in_d '#include "link.inc"' --restrict-read
echo '#fopen F "none" read #while(defined(F)) #read(F,A) #end' >bad.pov
missing() { exits 1 "$lambert" --dump-csg bad.pov && has err '1 error$'; }
check "a file that is not there" missing

cat >trace.pov <<'EOS'
#declare N = <0,0,0>;
#declare S = sphere { <1,2,3>, 2 }
#declare D = difference { box { -1,1 } sphere { <0,1,0>,.8 } rotate 10*z }
#macro T(O,A,B)
  #local P = trace(O,A,B,N);
  #debug concat(vstr(3,P,",",0,8)," / ",vstr(3,N,",",0,8),"\n")
#end
T(S,<0,10,2.5>,<.1,-1,0>)
T(S,<0,10,2.5>,<.1,1,0>)
T(D,<.1,10,.2>,-y)
T(D,<.1,0.1,.2>,-y)
T(D,<.1,0.1,.2>,<.2,3,.1>)
T(union { object { S } object { D } plane { y,-2 } },<6.1,10,.2>,-y)
T(object { D inverse },<.1,10,.2>,-y)
EOS
cat >want <<'EOS'
0.61031227,3.89687730,2.50000000 / -0.19484386,0.94843865,-0.25000000
0.00000000,0.00000000,0.00000000 / 0.00000000,0.00000000,0.00000000
0.10000000,0.26015841,0.20000000 / -0.34206022,0.90581168,-0.25000000
0.10000000,-0.99779391,0.20000000 / 0.17364818,-0.98480775,0.00000000
0.11106624,0.26599356,0.20553312 / -0.35589302,0.89851774,-0.25691640
6.10000000,-2.00000000,0.20000000 / 0.00000000,1.00000000,0.00000000
0.10000000,0.26015841,0.20000000 / 0.34206022,-0.90581168,0.25000000
EOS
cat >loop.pov <<'EOS'
#declare I = 0; #declare S = 0;
#while (I < 150000) #declare S = S + I; #declare I = I + 1; #end
EOS
check "a long loop takes little memory" reads loop.pov --max-parse-memory 8
traced() { reads trace.pov && grep / err | grep -v lambert | cmp - want; }
check "trace() meets what POV-Ray's does" traced
finish
