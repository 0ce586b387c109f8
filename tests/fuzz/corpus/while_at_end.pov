#declare I = -20;
#while (I <}