// Shading by depth alone (eye-dome lighting: Boucheny 2009, "Visualisation scientifique de grands volumes de donnees: pour une
// approche perceptive", section 4.3).
#ifndef SPLATRAY_EYE_DOME_GLSL
#define SPLATRAY_EYE_DOME_GLSL
#include "../lang/language.glsl"

/// How deep lies what a pixel shows, as it is compared with its neighbours: the logarithm of its distance, world units, or in
/// orthographic pictures, which have no eye to be near to, `per_world` times it; infinity where it shows nothing.
float dome_level(float distance_world, float per_world) {
  bool seen = distance_world > 0.0f && distance_world < INFINITY_F;
  if (!seen) return INFINITY_F;
  return per_world > 0.0f ? distance_world * per_world : log2(distance_world);
}

/// How far a pixel lies behind a neighbour.
float dome_step(float own, float beside) { return max(0.0f, own - beside); }

/// The factor, 0..1, of a pixel that lies `behind` its eight neighbours, all steps together.
float dome_factor(float exponent, float behind) { return exp(exponent * behind); }

#endif
