#!/bin/sh
# Hints on names and files that are missing, from the includes of the library path.
. "${top_srcdir:-.}/tests/cli/common.sh"
mkdir lib
cat >lib/zoo.inc <<'EOS'
#declare Zebra_Pigment = pigment { rgb 1 };
#macro Zoo_Cage(A, B)
  #declare Zoo_Inner = A;
#end
# declare Zoo_Wall = 3;
EOS
cat >lib/aviary.inc <<'EOS'
#declare Zebra_Pigment = pigment { rgb 0 };
EOS
mkdir lib/folder.inc
refuses() { printf '%s\n' "$1" >scene.pov && exits 1 "$lambert" check +Llib scene.pov; }
hints() { refuses "$1" && has err "$2"; }
check "the include that declares it; the first by name" \
  hints 'sphere { 0, 1 texture { Zebra_Pigment } }' 'declared in "aviary.inc": #include it first'
check "a macro" hints 'Zoo_Cage(1, 2)' 'declared in "zoo.inc": #include it first'
check "a number" hints '#declare A = Zoo_Wall;' 'declared in "zoo.inc"'
check "an object" hints 'object { Zoo_Wall }' 'declared in "zoo.inc"'
check "the closest of an include" hints 'sphere { 0, 1 texture { Zebra_Pigmnt } }' "did you mean 'Zebra_Pigment' of \"aviary.inc\"?"
check "of the scene first" hints '#declare Zebra_Pigmant = 1; #declare B = Zebra_Pigmnt;' "did you mean 'Zebra_Pigmant'?"
says_nothing() { hints "$1" "$2" && ! has err 'include\|mean' >/dev/null; }
check "what a macro declares within is not offered" says_nothing '#declare A = Zoo_Inner;' "'Zoo_Inner' is not declared"
check "no macro is called by a name of another kind" says_nothing 'Zoo_Wall(1)' "'Zoo_Wall' is neither"
check "an include of nearly that name" hints '#include "zo.inc"' 'did you mean "zoo.inc"?'
check "letters swapped, capitals" hints 'SPEHRE { 0, 1 }' "did you mean 'sphere'?"
finish
