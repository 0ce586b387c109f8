#ifndef MATH_PI_H
#define MATH_PI_H

// Macros, since constants are made of them.
#define PI     3.14159265358979323846
#define DEGREE (PI / 180) // in radians

#endif
