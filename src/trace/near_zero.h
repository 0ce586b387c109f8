#ifndef TRACE_NEAR_ZERO_H
#define TRACE_NEAR_ZERO_H

// "Is zero" for colours, cosines, indices of refraction and heights in fog, as the scene language has it
// (spec/lighting.md 0).
static const double NEAR_ZERO = 1e-10;

#endif
