#!/bin/sh
# Faces of two opaque objects in one place, placed by different arithmetic: the object that
# comes first in the scene is seen everywhere, whichever that is.
. "${top_srcdir:-.}/tests/cli/common.sh"

first='texture { pigment { rgb <1, 0, 0> } finish { ambient 1 diffuse 0 } }'
second='texture { pigment { rgb <0, 1, 0> } finish { ambient 1 diffuse 0 } }'

# scene NAME OBJECT OBJECT: without the texture's end; makes NAME.pov.
scene()
{
  cat >"$1.pov" <<EOF2
#version 3.7;
global_settings { assumed_gamma 1 }
#declare At = ${at:-0};
camera { location <1.3, 4, -5> + At look_at At + y angle 25 }
background { rgb <0, 0, 1> }
$2 $first translate At }
$3 $second translate At }
EOF2
}

# seen NAME: the picture shows the first object and nothing of the second.
seen()
{
  "$lambert" -q "$1.pov" -o "$1.ppm" +FP8 +W64 +H48 -A || return
  tail -c $((64 * 48 * 3)) "$1.ppm" | od -An -v -tu1 -w3 |
    awk '{ red += $1 > 128; green += $2 > 128 } END { exit !(red > 99 && !green) }'
}

# one NAME A B: what is seen of B lies in a face of A.
one()
{
  scene "$1" "$2" "$3"
  check "the first of two: $1" seen "$1"
}

# both NAME A B: they fill the same space.
both()
{
  one "$1" "$2" "$3"
  one "$1, the other way" "$3" "$2"
}

turn='rotate <9, 20, 4>'
both "boxes" "box { <-1, 0, -1>, 1 $turn" "box { <-3, 0, -3>, 3 scale 1/3 rotate 20*z rotate -20*z $turn"
one "a plane, a box" "plane { y, 1 $turn" "box { <-1, -1, -1>, 1 $turn"
one "a box, a disc" "box { <-9, 0, -9>, <9, 1, 9> $turn" "disc { y, y, 1.2 $turn"
both "a box cut by a plane" "box { <-2, 0, -2>, <2, 1, 2> $turn" "intersection { box { <-2, 0, -2>, <2, 3, 2> } plane { y, 1 } $turn"
one "cylinders" "cylinder { 0, y, 1.2 rotate 13*z" "cylinder { -y*2, y*.5, 1 translate y/2 rotate 20*z rotate -7*z"
both "triangles" "triangle { <-1, 1, -1>, <1, 1, -1>, <0, 1, 1> $turn" "triangle { <-3, 3, -3>, <3, 3, -3>, <0, 3, 3> rotate 33*z scale 1/3 rotate -33*z $turn"
one "a box, a triangle" "box { <-2, 0, -2>, <2, 1, 2> $turn" "triangle { <-1, 1, -1>, <1, 1, -1>, <0, 1, 1> scale 3 scale 1/3 $turn"
# Curved faces.
again='rotate 41*x rotate <-41, 0, 0>'
both "balls" "sphere { y, 1 $turn" "sphere { 3*y, 3 scale 1/3 $again $turn"
both "ellipsoids" "sphere { y, 1 scale <1.3, 1, 1> $turn" "sphere { 3*y, 3 scale <1.3, 1, 1>/3 $again $turn"
both "a ball as a quadric" "sphere { y, 1 $turn" "quadric { 1, 0, -2*y, 0 scale 1/3 scale 3 $again $turn"
both "a ball as a poly" "sphere { y, 1 $turn" "poly { 2, <1, 0, 0, 0, 1, 0, -2, 1, 0, 0> scale 1/3 scale 3 $again $turn"
both "a polynomial as a quadric" "quadric { <1, 2, 1>, <.3, 0, .2>, <0, -2, 0>, -.5 $turn" "polynomial { 2, xyz(2, 0, 0): 2, xyz(0, 2, 0): 4, xyz(0, 0, 2): 2, xyz(1, 1, 0): .6, xyz(0, 1, 1): .4, xyz(0, 1, 0): -4, xyz(0, 0, 0): -1 scale 1/3 scale 3 $again $turn"
both "a ball cut from a block" "sphere { y, 1 $turn" "difference { sphere { 3*y, 3 } box { -.1, .1 } scale 1/3 $again $turn"
both "cones" "cone { 0, 1, 2*y, .2 $turn" "cone { 0, 3, 6*y, .6 scale 1/3 $again $turn"
both "open cylinders" "cylinder { 0, y, 1 open $turn" "cylinder { 0, 3*y, 3 open scale 1/3 $again $turn"
one "cylinders of two lengths" "cylinder { 0, 2*y, 1 open $turn" "cylinder { y, 4.5*y, 3 open scale 1/3 $again $turn"
both "paraboloids" "quadric { x+z, 0, -y, 0 clipped_by { plane { y, 1.4 } } $turn" "quadric { x+z, 0, -3*y, 0 clipped_by { plane { y, 4.2 } } scale 1/3 $again $turn"
both "tori" "torus { .9, .3 translate y $turn" "torus { 2.7, .9 translate 3*y scale 1/3 $again $turn"
both "squeezed tori" "torus { .9, .3 translate y scale <1, .8, 1> $turn" "torus { 2.7, .9 translate 3*y scale <1, .8, 1>/3 $again $turn"
at='<1e6, -7e5, 3e5>'
both "balls far away" "sphere { y, 1 $turn" "sphere { 3*y, 3 scale 1/3 $again $turn"
both "tori far away" "torus { .9, .3 translate y $turn" "torus { 2.7, .9 translate 3*y scale 1/3 $again $turn"
at=0
# Shapes that are known by their declaration alone.
for shape in "superellipsoid { <.4, .7>" "lathe { cubic_spline 4, <0, -1>, <1, -.5>, <.5, .5>, <0, 1>" \
  "blob { threshold .4 sphere { -x/2, 1, 1 } sphere { x/2, 1, 1 }" "julia_fractal { <-.1, .8, -.2, 0>" \
  "height_field { function 9, 9 { .5 + .5*x*y } translate -1/2 scale 2"; do
  one "two of one ${shape%% *}" "#declare Shape = $shape }; object { Shape translate y $turn" "object { Shape translate y $again $turn"
done
# Of three boxes in one place the outer two look alike; the one between is not seen.
cat >three.pov <<END
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.3, 4, -5> look_at <0, 1, 0> angle 25 }
background { rgb <0, 0, 1> }
#declare Red = $first
box { <-1, 0, -1>, 1 $turn texture { Red } }
box { <-3, 0, -3>, 3 scale 1/3 rotate 20*z rotate -20*z $turn $second }
box { <-7, 0, -7>, 7 scale 1/7 rotate 50*x rotate -50*x $turn texture { Red } }
END
check "the first of three" seen three
finish
