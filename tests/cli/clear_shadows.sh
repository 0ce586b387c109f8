#!/bin/sh
# Shadow rays go on through clear shapes from each crossing, which is met once: the shadow of a
# ball is the same whatever shape makes it.
. "${top_srcdir:-.}/tests/cli/common.sh"

# ball NAME SHAPE: its shadow.
ball()
{
  cat >"$1.pov" <<EOF2
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.2, 1.6, -4> look_at -y*.7 angle 50 }
light_source { <4, 6, -5>, rgb 1 }
plane { y, -1.4 pigment { rgb 1 } }
$2 no_image no_reflection pigment { rgbt <.9, .8, 1, .5> } }
EOF2
  "$lambert" -q "$1.pov" -o "$1.png" +W100 +H80 -A
}

# same NAME: as the sphere's, but for its outline.
same()
{
  "$lambert" compare "$1.png" sphere.png |
    sed -n 's/.*8\/255: [0-9.]* % (\([0-9]*\) of.*/\1/p' >off
  [ "$(cat off)" -le 2 ]
}

ball sphere 'sphere { 0, 1'
ball isosurface 'isosurface { function { x*x + y*y + z*z - 1 } contained_by { box { -1.3, 1.3 } }'
ball poly 'poly { 2, <1,0,0,0, 1,0,0, 1,0,-1>'
ball superellipsoid 'superellipsoid { <1, 1>'
for name in isosurface poly superellipsoid; do
  check "the shadow of a clear ball, a $name" same $name
done
finish
