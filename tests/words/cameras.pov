#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location -5 * z look_at 0 }
camera { fisheye angle 180 }
camera { ultra_wide_angle angle 90 }
camera { omnimax }
camera { panoramic }
camera { cylinder 1 angle 90 }
camera { spherical angle 120 60 }
