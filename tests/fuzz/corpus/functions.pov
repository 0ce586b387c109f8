#declare F = function(a, b) { sum(k, 1, 3, sin(k*a)*pow(b, k)) + select(a, -1, 0, 1) }
#declare T = function { transform { rotate 30*y scale <1, 2, 0> } }
#declare P = function { pattern { bozo turbulence 1e9 } }
isosurface { function { F(x, y) - T(x, y, z).y/0 + P(x, 1e308*y, z) } threshold -1e308
  contained_by { sphere { 0, 1e-300 } } evaluate 1, -1, 1e30 accuracy 0 max_trace 99 open }
isosurface { function { sqrt(-1 - x*x) + ln(y)/mod(z, 0) } contained_by { box { -1e200, 1e200 } } all_intersections }
parametric { function { u/0 } function { tan(v*1e300) } function { atan2(0, 0) + u } <1, 1>, <-1, 1e9>
  precompute 3, x, z contained_by { box { 0, 1 } } max_gradient 1e308 }
