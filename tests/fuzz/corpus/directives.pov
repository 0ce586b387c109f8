#macro M(A) #if (A < 2) sphere { <A, 0, 0>, 1 } #else M(A - 1) #end #end
#for (I, 0, 3) M(I) #end
#declare T = texture { pigment { rgb 1 } } texture { finish { phong 1 } }
union { #while (0) #end box { 0, 1 texture { T } } 
