#ifndef TESTS_STABILITY_SCENES_H
#define TESTS_STABILITY_SCENES_H

// Scenes of the picture tests, without their first line.

// Solids of most kinds, a difference with coincident faces, a mirror, glass, shadows;
// no noise, which is a pattern of absolute places. K is the size, O the place.
static const char still_life[] =
    "#declare K = %.17g; #declare O = <1, -1, 1>*%.17g;\n"
    "camera { location O + K*<1, 2, -6> right x look_at O + K*<0, .3, 0> angle 40 }\n"
    "light_source { O + K*<4, 6, -5>, rgb 1 }\n"
    "light_source { O + K*<-6, 3, -2>, rgb .3 }\n"
    "#default { finish { ambient .1 diffuse .8 phong .4 } }\n"
    "union {\n"
    "  plane { y, -1 pigment { rgb <.7, .8, .6> } }\n"
    "  difference { box { <-2, -1, 0>, <-.5, .5, 1.5> }\n"
    "    box { <-1.5, -.5, -1>, <-1, .5, 2> } cylinder { <-3, 0, .75>, <0, 0, .75>, .3 "
    "}\n"
    "    pigment { rgb <.9, .3, .2> } }\n"
    "  intersection { sphere { <.8, -.2, .6>, .8 } plane { <1, 1, -.3>, .5 }\n"
    "    pigment { rgb <.2, .4, .9> } finish { reflection .4 } }\n"
    "  torus { .5, .15 rotate 60*x translate <.3, .9, .2> pigment { rgb <.8, .8, .1> } "
    "}\n"
    "  cone { <-1.2, .5, .7>, .5, <-1.2, 1.6, .7>, 0 pigment { rgb <.3, .8, .4> } }\n"
    "  sphere { <-.2, -.6, -1>, .4 pigment { rgbf <.9, 1, 1, .9> }\n"
    "    finish { reflection .1 } interior { ior 1.4 } }\n"
    "  prism { 0, .5, 4, <0, 0>, <.6, 0>, <.3, .6>, <0, 0> translate <.9, -1, -1.2>\n"
    "    pigment { rgb <.6, .2, .7> } }\n"
    "  scale K translate O\n"
    "}\n";

// T32: seen from above, hidden from the eye; light falls straight down.
static const char rising_sheet[] =
    "camera { orthographic location <0, 10, 0> direction -y right 1.9*x up 1.9*z }\n"
    "light_source { <0, 100, 0>, rgb 1 }\n"
    "plane { y, 0 pigment { rgb 1 } finish { ambient 0 diffuse 1 } }\n"
    "union { triangle { <-1, .0002, -1>, <1, .002, -1>, <1, .002, 1> }\n"
    "  triangle { <-1, .0002, -1>, <1, .002, 1>, <-1, .0002, 1> }\n"
    "  pigment { rgb 1 } no_image }\n";

// T33: K is the size.
static const char close_glass[] =
    "#declare K = %.17g;\n"
    "camera { orthographic location 10*K*y direction -y right 1.9*K*x up "
    "1.9*K*z }\n"
    "light_source { <30, 100, 20>*K, rgb 1 }\n"
    "plane { y, 0 pigment { rgb 1 } finish { ambient 0 diffuse 1 } }\n"
    "box { <-1, 7e-5, -1>, <1, .5, 1> pigment { rgbf 1 }\n"
    "  finish { ambient 0 diffuse 0 } interior { ior 1.5 } scale K }\n";

#endif
