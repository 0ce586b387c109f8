#!/bin/sh
# Two thousand levels of everything that nests, and an error, not a crash, far beyond.
. "${top_srcdir:-.}/tests/cli/common.sh"
pov() { printf '#version 3.7;\nglobal_settings { assumed_gamma 1 }\n'; cat; }
levels() { awk -v n="$1" -v open="$2" -v close_="$3" -v middle="$4" \
  'BEGIN { for (i = 0; i < n; i++) printf open "\n", i; printf "%s", middle
    for (i = 0; i < n; i++) printf "%s", close_; print "" }' | pov; }
reads() { exits 0 "$lambert" check deep.pov; }
too_deep() { exits 1 "$lambert" check deep.pov && has err 'E0105'; }

echo '#macro Down(N) #if (N > 0) Down(N - 1) #else sphere { 0, 1 } #end #end Down(2000)' | pov >deep.pov
check "recursion" reads
echo '#macro F(N) #if (N > 0) (1 + F(N - 1)) #else 0 #end #end #if (F(2000) != 2000) #error "wrong" #end sphere { 0, 1 }' | pov >deep.pov
check "recursion in expressions" reads
echo '#macro F(N) #if (N > 0) #local R = 1 + F(N - 1); #else #local R = 0; #end R #end #if (F(2000) != 2000) #error "wrong" #end sphere { 0, 1 }' | pov >deep.pov
check "recursion in right sides" reads
echo '#macro Down(N) Down(N + 1) #end Down(0)' | pov >deep.pov
check "recursion without end" too_deep
echo '#macro F(N) #local R = F(N + 1); R #end #declare A = F(0);' | pov >deep.pov
check "the same in right sides" too_deep
{
  levels 2000 '#macro M%d() ' ' #end' ''
  echo 'M0() sphere { 0, 1 }'
} >deep.pov
check "macros in macros" reads
awk 'BEGIN { for (i = 0; i < 2000; i++) printf "#macro M%d() M%d() #end\n", i, i + 1
  print "#macro M2000() sphere { 0, 1 } #end\nM0()" }' | pov >deep.pov
check "a chain of macros" reads
awk 'BEGIN { printf "#macro G(A) A + 1 #end\n#declare A = "
  for (i = 0; i < 2000; i++) printf "G("
  printf "0"
  for (i = 0; i < 2000; i++) printf ")"
  print ";\n#if (A != 2000) #error \"wrong\" #end sphere { 0, 1 }" }' | pov >deep.pov
check "calls in arguments" reads
levels 2000 '#if (1 + %d)' ' #end' 'sphere { 0, 1 }' >deep.pov
check "conditions" reads

renders() { exits 0 "$lambert" deep.pov -q +W16 +H12 +FP -o "$1" && size_ppm "$1" 16 12; }
levels 2000 'union { sphere { <0.001*%d, 0, 3>, 1 pigment { rgb 1 } }' '}' 'box { <-1, -1, 2>, 1 }' >deep.pov
echo 'light_source { -5*z, rgb 1 }' >>deep.pov
check "unions" renders union.ppm
awk 'BEGIN { split("union intersection difference merge", op)
  for (i = 0; i < 2000; i++) printf "%s { sphere { <0.0001*%d, 0, 3>, 1 pigment { rgb 1 } }\n", op[i % 4 + 1], i
  printf "sphere { 3*z, 0.5 }"
  for (i = 0; i < 2000; i++) printf "}"
  print "\nlight_source { -5*z, rgb 1 }" }' | pov >deep.pov
check "all operators" renders mixed.ppm
levels 100000 'union { sphere { %d, 1 }' '}' 'sphere { 0, 1 }' >deep.pov
check "far too many" too_deep
finish
