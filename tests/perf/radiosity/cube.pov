#version 3.7;
// The inside of a unit cube, reflectance .5, whose floor gives off .5: truth C1, halved.
#ifndef (View) #declare View = 1; #end
#ifndef (Count) #declare Count = 35; #end
#ifndef (Error) #declare Error = 1.8; #end
#ifndef (Recursion) #declare Recursion = 2; #end
#ifndef (Nearest) #declare Nearest = 5; #end
#ifndef (Pretrace) #declare Pretrace = .04; #end
global_settings {
  assumed_gamma 1
  #ifndef (lambert)
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
#declare Matt = texture { pigment { rgb 1 } finish { ambient 0 diffuse .5 emission 0 } };
difference { box { -1, 2 } box { <0, 0, -.3>, 1 } texture { Matt } }
box { <-.1, -.1, -.5>, <1.1, 1.1, 0> pigment { rgb 1 } finish { ambient 0 diffuse .5 emission .5 } }
// 0: floor, 1: ceiling, 2: wall
#switch (View)
  #case (0) camera { orthographic location <.5, .5, .5> right .998*x up .998*y look_at <.5, .5, 0> } #break
  #case (1) camera { orthographic location <.5, .5, .5> right .998*x up .998*y look_at <.5, .5, 1> } #break
  #case (2) camera { orthographic location <.5, .5, .5> right .998*x up .998*z sky z look_at <.5, 1, .5> } #break
#end
