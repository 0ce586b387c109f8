#!/bin/sh
# Blocks of mesh2 that are read whole and those read through the grammar (a comment in the
# block sees to that): the same meshes, pictures and errors.
. "${top_srcdir:-.}/tests/cli/common.sh"

head='#version 3.7;
global_settings {assumed_gamma 1}
camera {location <0.3, 0.4, -3> look_at 0}
light_source {<4, 6, -9>, 1}
'

# same NAME CODE TEXT: with the comments, and with blanks in their place.
same()
{
  printf '%s%s\n' "$head" "$3" >slow.pov
  sed 's,/[*][*]/,    ,' slow.pov >fast.pov
  for way in slow fast; do
    "$lambert" $way.pov --dump-csg >$way.csg 2>/dev/null
    "$lambert" $way.pov +W32 +H24 -D "+O$way.png" -q >$way.out 2>$way.err
    test $? = "$2" || return 1
    sed "s,/[*][*]/,    ,; s/$way/scene/g" $way.err >$way.say
    cmp -s slow.pov fast.pov && return 1
  done
  cmp slow.csg fast.csg && cmp slow.say fast.say &&
    { test "$2" != 0 || cmp slow.png fast.png; }
}

# mesh VERTICES FACES MORE
mesh()
{
  printf '%s\n' "mesh2 {
  vertex_vectors { $1 /**/ }
  normal_vectors { 3, <0, 0.1, -1>, <.1, 0, -1.>, <-1e-1, -0, -1.0E+0> /**/ }
  uv_vectors { 3, <0, 0>, <1, 0>, <0.5, 1> /**/ }
  face_indices { $2 /**/ }
  $3
  uv_mapping pigment { checker rgb 1 rgb <1, 0, 0> scale 0.2 } finish { specular 0.6 }
}"
}
three='3, <-1.25, -1, 0>, <1, -.5, 1e-3>, <0, 12345678901234567890e-19, 0.1>'

check "normals, uv vectors, all forms of numbers" same n 0 "$(mesh "$three" '1, <0, 1, 2>')"
check "no commas between vectors, blanks anywhere" \
  same b 0 "$(mesh '3 < -1,-1 ,0><1,  -1, 0> <0,1,0>,' '1 <0, 1,2>')"
check "indices of their own" same i 0 "$(mesh "$three" '1, <0, 1, 2>' \
  'uv_indices { 1, <2, 1, 0> /**/ } normal_indices { 1, <1, 1, 0> /**/ }')"
check "an index out of range" same r 1 "$(mesh "$three" '1, <0, 1, 3>')"
check "a negative index" same m 1 "$(mesh "$three" '1, <0, 1, -1>')"
check "fewer vectors than said" same f 1 "$(mesh "4$three" '1, <0, 1, 2>')"
check "more vectors than said" same o 0 "$(mesh "$three, <1, 1, 1>" '1, <0, 1, 2>')"
check "a fraction as an index" same q 0 "$(mesh "$three" '1, <0, 1.0, 2.5>')"
check "names and sums" same s 0 "$(mesh '3, <0, 0, 0>, x, y + <0, 0, 1>' '1, <0, 1, 1 + 1>')"
check "a second comma" same c 1 "$(mesh '3,, <0, 0, 0>, <1, 0, 0>, <0, 1, 0>' '1, <0, 1, 2>')"
check "counts that differ" same d 1 "$(mesh "$three" '1, <0, 1, 2>' \
  'normal_indices { 2, <0, 1, 2>, <0, 1, 2> /**/ } uv_indices { 2, <0, 1, 2>, <0, 1, 2> /**/ }')"
check "a block where none belongs" same w 1 'sphere { 0, 1 face_indices { 1, <0, 1, 2> /**/ } }'
check "textures of faces" same t 0 "mesh2 { vertex_vectors { $three /**/ }
  texture_list { 1, texture { pigment { rgb y } } } face_indices { 1, <0, 1, 2> /**/ } }"
finish
