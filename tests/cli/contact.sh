#!/bin/sh
# Clear bodies in contact, placed by different arithmetic: rays cross both faces. Two halves of
# a ball of glass are the ball; water in a glass is the same whichever comes first.
. "${top_srcdir:-.}/tests/cli/common.sh"

cat >scene.inc <<'END'
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 20 }
#ifndef (Size) #declare Size = 1; #end
#ifndef (Far) #declare Far = 0; #end
#declare At = Far * <1e6, -7e5, 3e5>;
#declare Place = transform { scale Size translate At }
camera { location <1, 2, -6> * Size + At look_at At angle 40 }
light_source { <3, 8, -5>, 1 transform Place }
plane { y, -1.3 pigment { checker rgb 1 rgb 0.3 } finish { ambient 0.3 } transform Place }
sky_sphere { pigment { gradient y color_map { [0 rgb <0.5, 0.6, 0.9>] [1 rgb <0.1, 0.2, 0.5>] } } }
#macro Clear(Ior, Dim)
  texture { pigment { rgbt 1 } finish { reflection { 0, 1 fresnel } conserve_energy } }
  interior { ior Ior fade_color Dim fade_distance Size fade_power 1001 }
#end
END

cat >halves.pov <<'END'
#include "scene.inc"
#declare Turn = transform { rotate 33*x rotate <-33, 0, 0> }
#ifdef (Whole)
sphere { 0, 1.2 Clear(1.5, <0.6, 0.8, 0.9>) transform Place }
#else
#declare Cut = <1, 2, -0.5>;
intersection { sphere { 0, 1.2 } plane { Cut, 0.2 } Clear(1.5, <0.6, 0.8, 0.9>) transform Place }
intersection { sphere { 0, 3.6 } plane { -Cut, -0.6 } scale 1/3 transform Turn Clear(1.5, <0.6, 0.8, 0.9>) transform Place }
#end
END

cat >water.pov <<'END'
#include "scene.inc"
#declare Glass = difference { cylinder { -1.2*y, 1.5*y, 1 } cylinder { -y, 1.6*y, 0.9 } Clear(1.5, 1) rotate <0, 20, 5> }
#declare Other = transform { rotate <0, 50, 0> rotate <0, -30, 5> }
#declare Same = transform { rotate <0, 20, 5> }
#declare Water = cylinder { -y, 0.8*y, 0.9 Clear(1.33, <0.6, 0.8, 0.9>) transform { #ifdef (Alike) Same #else Other #end } }
#ifdef (Swapped)
object { Water transform Place }
object { Glass transform Place }
#else
object { Glass transform Place }
object { Water transform Place }
#end
END

# picture NAME SCENE [NAME=VALUE...]
picture()
{
  name=$1.ppm
  scene=$2
  shift 2
  set -- $(printf 'Declare=%s ' "$@")
  "$lambert" -q "$scene.pov" -o "$name" +W96 +H72 -A "$@"
}

# alike A B: hardly a pixel differs by more than 8/255.
alike() { "$lambert" compare "$1.ppm" "$2.ppm" --tolerance=0.02 >alike.out || { sed 's/^/# /' alike.out; false; }; }

picture whole halves Whole=1
for place in Size=1 Size=1e-5 Size=1e5 Far=1; do
  picture halves halves $place
  check "two halves of a ball are the ball: $place" alike halves whole
done
picture alike water Alike=1
picture other water Alike0=1
check "water in a glass, placed by other arithmetic" alike alike other
picture swapped water Swapped=1
check "water before its glass" alike other swapped
LAMBERT_SHADING=general picture general water Alike0=1
check "the general way of shading" cmp -s other.ppm general.ppm
LAMBERT_ISA=base picture base water Alike0=1
check "another instruction set" cmp -s other.ppm base.ppm

finish
