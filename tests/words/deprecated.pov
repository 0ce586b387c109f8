#version 3.7;
global_settings { assumed_gamma 1 }
#declare deprecated once "old" Old = 1;
#declare Newer = Old;
#statistics "shown\n"
#render "shown\n"
#declare Found = file_exists("nowhere.inc");
