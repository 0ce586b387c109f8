#!/bin/sh
# generate.sh NAME >SCENE: the scenes of the parsing benchmark (run.sh). The same
# bytes each time: what looks random is a linear congruence.
head='#version 3.7;
global_settings { assumed_gamma 1 }'

literal() # COUNT FORMAT: spheres written out, one a line
{
  awk -v n="$1" -v form="$2" 'function r() { s = (s*1103515245 + 12345) % 2147483648; return s/2147483648 }
    BEGIN { s = 1; for (i = 0; i < n; i++) printf form "\n", r(), r(), r(), r(), r(), r() }'
}

printf '%s\n' "$head"
case $1 in
loops)
  cat <<'EOF'
#declare S = 0;
#for (I, 1, 2000000)
  #declare S = S + sin(I*0.001)*2 - mod(I, 7)/3;
#end
#declare K = 0;
#while (K < 1000000)
  #if (mod(K, 2) = 0) #declare S = S + 1; #else #declare S = S - 0.5; #end
  #declare K = K + 1;
#end
#debug concat(str(S, 0, 6), "\n")
sphere { 0, 1 }
EOF
  ;;
macros)
  cat <<'EOF'
#macro Add(A, B) (A + B) #end
#macro Mul(A, B) #local R = A*B; R #end
#macro Vec(I) <I, Add(I, 1), Mul(I, 2)> #end
#declare S = <0, 0, 0>;
#for (I, 1, 200000)
  #declare S = S + Vec(I);
  #declare S = S*Add(0.5, 0.25);
#end
#debug concat(vstr(3, S, ",", 0, 3), "\n")
sphere { 0, 1 }
EOF
  ;;
recursion)
  cat <<'EOF'
#declare Calls = 0;
#macro Fib(N)
  #declare Calls = Calls + 1;
  #if (N > 1) Fib(N - 1) Fib(N - 2) #end
#end
Fib(25)
#debug concat(str(Calls, 0, 0), "\n")
sphere { 0, 1 }
EOF
  ;;
strings)
  cat <<'EOF'
#declare S = "";
#for (I, 1, 20000) #declare S = concat(S, "x"); #end
#declare T = 0;
#for (I, 1, 300000)
  #declare A = concat("a", str(I, 0, 2), "b");
  #declare T = T + strlen(substr(strupr(A), 1, 3)) + asc(A);
#end
#debug concat(str(T + strlen(S), 0, 0), "\n")
sphere { 0, 1 }
EOF
  ;;
arrays)
  cat <<'EOF'
#declare A = array[1000000];
#for (I, 0, 999999) #declare A[I] = I*0.5; #end
#declare B = array[1000][1000];
#for (I, 0, 999) #for (J, 0, 999) #declare B[I][J] = <I, J, A[I*1000 + J]>; #end #end
#declare S = 0;
#for (I, 0, 999) #for (J, 0, 999) #declare S = S + B[I][J].z; #end #end
#debug concat(str(S, 0, 1), "\n")
sphere { 0, 1 }
EOF
  ;;
objects_loop)
  cat <<'EOF'
#declare R = seed(1);
union {
#for (I, 1, 1000000)
  sphere { <rand(R), rand(R), rand(R)>*10, 0.01 pigment { rgb <rand(R), rand(R), rand(R)> } }
#end
}
EOF
  ;;
objects_textured) literal 1000000 'sphere { <%.4f, %.4f, %.4f>, 0.01 texture { pigment { rgb <%.3f, %.3f, %.3f> } } }' ;;
objects_plain) literal 1000000 'sphere { <%.4f, %.4f, %.4f>, 0.01 } // %.0f%.0f%.0f' ;;
mesh2)
  awk 'BEGIN {
    n = 708; printf "mesh2 {\n  vertex_vectors {\n    %d", n*n
    for (i = 0; i < n; i++) for (j = 0; j < n; j++)
      printf ",\n    <%.6f, %.6f, %.6f>", i/n, ((i*i + 3*j) % 97)/9700, j/n
    printf "\n  }\n  face_indices {\n    %d", 2*(n - 1)*(n - 1)
    for (i = 0; i < n - 1; i++) for (j = 0; j < n - 1; j++) {
      a = i*n + j
      printf ",\n    <%d, %d, %d>, <%d, %d, %d>", a, a + 1, a + n, a + 1, a + n, a + n + 1
    }
    print "\n  }\n}"
  }'
  ;;
nested)
  awk 'BEGIN {
    for (i = 0; i < 2000; i++) printf "union { sphere { %d*x, 1 }\n", i
    for (i = 0; i < 2000; i++) printf "}"
    print ""
  }'
  ;;
copies)
  cat <<'EOF'
#declare O = sphere { 0, 1 }
#for (I, 1, 2000) #declare O = union { object { O } sphere { I*x, 1 } } #end
object { O }
EOF
  ;;
*)
  echo "generate.sh: no scene '$1'" >&2
  exit 64
  ;;
esac
