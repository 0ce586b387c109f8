// Bounds of counts: tables by samples took the square of them.
camera { location -5 * z aperture 0.8 blur_samples 1e6 focal_point 0 confidence 0.5 variance 1 bokeh { pigment { rgb 0 } } }
plane { z, 0 pigment { rgb 1 } finish { emission 1 } }
