#version 3.7;
// The Cornell box of Cornell's Program of Computer Graphics (published corners) with
// reflectances .73, (.65 .05 .05), (.12 .45 .15); the light is a hole's lid in the ceiling.
global_settings {
  assumed_gamma 1
  #ifndef (lambert)
#ifndef (Count) #declare Count = 35; #end
  #ifndef (Error) #declare Error = 1.8; #end
  #ifndef (Recursion) #declare Recursion = 2; #end
  #ifndef (Nearest) #declare Nearest = 5; #end
  #ifndef (Pretrace) #declare Pretrace = .04; #end
  radiosity {
    count Count error_bound Error recursion_limit Recursion nearest_count Nearest
    pretrace_start .08 pretrace_end Pretrace brightness 1 low_error_factor .5
    normal off media off
  }
  #end
}
#ifdef (lambert)
#declare lambert_gi = "radiosity";
#end
#ifndef (Light) #declare Light = 20; #end
#macro M(C) texture { pigment { C } finish { ambient 0 diffuse 1 } } #end
#declare White = M(rgb .73);
#declare Red = M(rgb <.65, .05, .05>);
#declare Green = M(rgb <.12, .45, .15>);
#declare Lamp = texture { pigment { rgb 1 } finish { ambient 0 diffuse .78 emission Light } };
camera {
  location <278, 273, -800> direction .035*z up .025*y right .025*x
}
mesh {
  triangle { <213, 548.8, 227>, <343, 548.8, 227>, <343, 548.8, 332> }
  triangle { <213, 548.8, 227>, <343, 548.8, 332>, <213, 548.8, 332> }
  texture { Lamp }
} // light
mesh {
  triangle { <552.8, 0, 0>, <0, 0, 0>, <0, 0, 559.2> }
  triangle { <552.8, 0, 0>, <0, 0, 559.2>, <549.6, 0, 559.2> }
  texture { White }
} // floor
mesh {
  triangle { <0, 548.8, 0>, <556, 548.8, 0>, <556, 548.8, 227> }
  triangle { <0, 548.8, 0>, <556, 548.8, 227>, <0, 548.8, 227> }
  triangle { <0, 548.8, 332>, <556, 548.8, 332>, <556, 548.8, 559.2> }
  triangle { <0, 548.8, 332>, <556, 548.8, 559.2>, <0, 548.8, 559.2> }
  triangle { <0, 548.8, 227>, <213, 548.8, 227>, <213, 548.8, 332> }
  triangle { <0, 548.8, 227>, <213, 548.8, 332>, <0, 548.8, 332> }
  triangle { <343, 548.8, 227>, <556, 548.8, 227>, <556, 548.8, 332> }
  triangle { <343, 548.8, 227>, <556, 548.8, 332>, <343, 548.8, 332> }
  texture { White }
} // ceiling
mesh {
  triangle { <549.6, 0, 559.2>, <0, 0, 559.2>, <0, 548.8, 559.2> }
  triangle { <549.6, 0, 559.2>, <0, 548.8, 559.2>, <556, 548.8, 559.2> }
  texture { White }
} // back
mesh {
  triangle { <0, 0, 559.2>, <0, 0, 0>, <0, 548.8, 0> }
  triangle { <0, 0, 559.2>, <0, 548.8, 0>, <0, 548.8, 559.2> }
  texture { Green }
} // right
mesh {
  triangle { <552.8, 0, 0>, <549.6, 0, 559.2>, <556, 548.8, 559.2> }
  triangle { <552.8, 0, 0>, <556, 548.8, 559.2>, <556, 548.8, 0> }
  texture { Red }
} // left
mesh {
  triangle { <130, 165, 65>, <82, 165, 225>, <240, 165, 272> }
  triangle { <130, 165, 65>, <240, 165, 272>, <290, 165, 114> }
  texture { White }
} // short top
mesh {
  triangle { <130, 0, 65>, <82, 0, 225>, <82, 165, 225> }
  triangle { <130, 0, 65>, <82, 165, 225>, <130, 165, 65> }
  texture { White }
} // short side
mesh {
  triangle { <82, 0, 225>, <240, 0, 272>, <240, 165, 272> }
  triangle { <82, 0, 225>, <240, 165, 272>, <82, 165, 225> }
  texture { White }
} // short side
mesh {
  triangle { <240, 0, 272>, <290, 0, 114>, <290, 165, 114> }
  triangle { <240, 0, 272>, <290, 165, 114>, <240, 165, 272> }
  texture { White }
} // short side
mesh {
  triangle { <290, 0, 114>, <130, 0, 65>, <130, 165, 65> }
  triangle { <290, 0, 114>, <130, 165, 65>, <290, 165, 114> }
  texture { White }
} // short side
mesh {
  triangle { <423, 330, 247>, <265, 330, 296>, <314, 330, 456> }
  triangle { <423, 330, 247>, <314, 330, 456>, <472, 330, 406> }
  texture { White }
} // tall top
mesh {
  triangle { <423, 0, 247>, <265, 0, 296>, <265, 330, 296> }
  triangle { <423, 0, 247>, <265, 330, 296>, <423, 330, 247> }
  texture { White }
} // tall side
mesh {
  triangle { <265, 0, 296>, <314, 0, 456>, <314, 330, 456> }
  triangle { <265, 0, 296>, <314, 330, 456>, <265, 330, 296> }
  texture { White }
} // tall side
mesh {
  triangle { <314, 0, 456>, <472, 0, 406>, <472, 330, 406> }
  triangle { <314, 0, 456>, <472, 330, 406>, <314, 330, 456> }
  texture { White }
} // tall side
mesh {
  triangle { <472, 0, 406>, <423, 0, 247>, <423, 330, 247> }
  triangle { <472, 0, 406>, <423, 330, 247>, <472, 330, 406> }
  texture { White }
} // tall side
