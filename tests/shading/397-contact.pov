// expect: 0 0 0.285969 0.235309 0.333593
// expect: 1 0 0.458854 0.215488 0.164797
// expect: 2 0 0.053376 0.212406 0.562310
// expect: 3 0 0.072511 0.203601 0.505943
// expect: 4 0 0.141405 0.257282 0.487053
// expect: 5 0 0.313176 0.235325 0.314183
// expect: 0 1 0.304051 0.289693 0.444968
// expect: 1 1 0.322621 0.199527 0.132784
// expect: 2 1 0.089998 0.229725 0.531304
// expect: 3 1 0.109239 0.225483 0.492164
// expect: 4 1 0.125765 0.213077 0.435538
// expect: 5 1 0.403296 0.284504 0.362234
// expect: 0 2 0.099184 0.227817 0.501808
// expect: 1 2 0.290654 0.187228 0.131716
// expect: 2 2 0.091203 0.215885 0.492958
// expect: 3 2 0.115557 0.210437 0.441657
// expect: 4 2 0.169955 0.208087 0.357794
// expect: 5 2 0.133318 0.202640 0.391119
// expect: 0 3 0.388296 0.286915 0.364645
// expect: 1 3 0.087694 0.198657 0.406867
// expect: 2 3 0.106889 0.163638 0.318441
// expect: 3 3 0.092271 0.165499 0.344274
// expect: 4 3 0.087694 0.198657 0.406867
// expect: 5 3 0.510918 0.345403 0.424552
// expect: 0 4 0.345098 0.325063 0.496132
// expect: 1 4 0.219623 0.308522 0.572625
// expect: 2 4 0.096391 0.208270 0.416602
// expect: 3 4 0.096391 0.208270 0.416602
// expect: 4 4 0.530495 0.312261 0.311772
// expect: 5 4 0.539757 0.361364 0.440421
// size: 6 5
// tol: abs 2e-4 rel 6e-4
// about: two halves of a ball of glass in contact, placed by different arithmetic; the values are of the whole ball.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 20 }
camera { location <1, 2, -6> right x up y direction 2.2*z look_at 0 }
light_source { <3, 8, -5>, 1 }
plane { y, -1.3 pigment { gradient x color_map { [0 rgb <1, 0.4, 0.2>] [1 rgb <0.2, 0.5, 1>] } scale 3 } finish { ambient 0.3 } }
background { rgb <0.2, 0.3, 0.5> }
#declare Glass = texture { pigment { rgbt 1 } }
#declare Dim = interior { ior 1.5 fade_color <0.6, 0.8, 0.9> fade_distance 1 fade_power 1001 }
#declare Cut = <1, 2, -0.5>;
intersection { sphere { 0, 1.2 } plane { Cut, 0.2 } texture { Glass } interior { Dim } }
intersection { sphere { 0, 3.6 } plane { -Cut, -0.6 } scale 1/3 rotate 33*x rotate -33*x texture { Glass } interior { Dim } }
