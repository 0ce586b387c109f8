camera { location <0,1,-5> look_at 0 }
pigment { color_map { [0 rgb <1,0,0>] [0.5 rgb 1 filter .5] [1 color red 1] } }
polynomial { 2, xyz(2,0,0):1, xyz(0,0,0):-1 }
julia_fractal { <0,1,2,3> sin max_iteration 5 }
#declare F = function (a, b) { a*b < 3 & sin(a)=1 }
#declare A = array[2][2] { {1,2}, {3,4} }
light_source { <1,2,3>, color rgb <1,1,1> spotlight radius 10 }
image_map { png "x.png" once }
#declare B = <1,2,3>.x + x.y;
sphere_sweep { linear_spline 2, <0,0,0>, 1 <1,2,3>, 2 tolerance 1e-3 }
