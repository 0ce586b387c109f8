#version 3.7;
global_settings { assumed_gamma 1 }
blob { threshold 0.5 component 1, 1, <0, 0, 0> component 1, 1, x hierarchy sturm }
#warning "seen\n"
