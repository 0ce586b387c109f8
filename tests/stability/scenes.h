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

// What POV-Ray gets wrong, for failures.sh.
#define FACING                                                                           \
    "#version 3.7; global_settings { assumed_gamma 1 }\n"                                \
    "light_source { <-30, 40, -50>, rgb 1 }\n"                                           \
    "#default { finish { ambient .2 diffuse .8 } }\n"
static const struct failure {
    const char *name, *scene;
} failures[] = {
    {"drilled", // T02: two colours of a film instead of the hole
     FACING "camera { location -5*z right x look_at 0 angle 30 } background { rgb 1 }\n"
            "difference { box { -1, 1 pigment { rgb x } } cylinder { -z, z, .9 pigment { "
            "rgb y } } rotate <7, 11, 0> }\n"},
    {"nothing", // T03
     FACING "camera { location -5*z right x look_at 0 angle 40 } background { rgb 1 }\n"
            "#declare A = box { -1, 1 pigment { rgb x } }\n"
            "difference { object { A } object { A pigment { rgb z } } rotate <33, -21, "
            "64> }\n"},
    {"merge", // T04
     FACING
     "camera { location -5*z right x look_at 0 angle 40 } background { rgb 1 }\n"
     "merge { box { -1, 1 } box { -1, 1 } pigment { rgb <.9, .6, .2> } rotate <33, "
     "-21, 64> }\n"},
    {"crest", // T12: the topmost ten-millionths of a torus
     FACING
     "camera { orthographic location <-5, .25, 0> direction x up 4e-7*y right z }\n"
     "background { rgb 1 } torus { 1, .25 pigment { rgb <.3, .5, .9> } finish { "
     "ambient 1 diffuse 0 } }\n"},
    {"far", // T21, T22
     FACING
     "#declare T = 1e7*<.7312345, .4567891, .8123457>; background { rgb 1 }\n"
     "camera { location T - 5*z right x look_at T angle 30 }\n"
     "quadric { <1, 1, 1>, 0, 0, -1 translate T pigment { rgb <.9, .6, .2> } finish "
     "{ ambient .3 } }\n"},
    {"fan", // T44
     FACING
     "camera { orthographic location <.06, -5, .03> direction y up .14*z right "
     ".14*x } background { rgb 1 }\n"
     "bicubic_patch { type 1 flatness 0 u_steps 4 v_steps 4 <0, 0, 0>, <0, 0, 0>, "
     "<0, 0, 0>, <0, 0, 0>, <1, 0, 0>, <1, 0, .3>, <1, 0, .6>, <1, 0, 1>, <2, 0, "
     "0>, <2, 0, .6>, <2, 0, 1.2>, <2, 0, 2>, <3, 0, 0>, <3, 0, 1>, <3, 0, 2>, <3, "
     "0, 3> pigment { rgb 1 } finish { ambient 0 diffuse 1 } }\n"
     "light_source { <1, -9, 1>, rgb .6 }\n"},
};

#endif
