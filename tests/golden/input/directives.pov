#version 3.7;
global_settings { assumed_gamma 1 }
#macro Post(Place, Height)
  #local Top = Place + Height * y;
  cylinder { Place, Top, 0.1 }
  #if (Height > 1.5) sphere { Top, 0.2 } #else box { Top - 0.1, Top + 0.1 } #end
#end
#declare Row = array[3] { 1, 2, 1.5 }
#for (I, 0, dimension_size(Row, 1) - 1)
  Post(I * 2 * x, Row[I])
#end
#switch (Row[0] + 1)
  #case (1) sphere { -1, 1 } #break
  #range (1.5, 2.5) box { -2, -1 }
  #else torus { 1, 0.25 }
#end
#ifdef (Row) #undef Row #end
#while (defined(Row)) #end
