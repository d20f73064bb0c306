/// What crosses between C++ and denoise.comp.glsl, the filter of engine/image/denoise.h on a device.
#ifndef SPLATRAY_DENOISE_LAYOUT_H
#define SPLATRAY_DENOISE_LAYOUT_H
#include "../layout.h"

#ifdef __cplusplus
namespace splatray {
#define SPLATRAY_REAL inline constexpr float
#else
#define SPLATRAY_REAL const float
#endif

/// What a dispatch does, a thread for each pixel, but for DENOISE_PIECES: one for each piece of a row.
SPLATRAY_CONST DENOISE_FINITE = 0u;    ///< as make_finite
SPLATRAY_CONST DENOISE_PIECES = 1u;    ///< which pieces of rows show a surface
SPLATRAY_CONST DENOISE_TAKE = 2u;      ///< light over base colours, of two halves
SPLATRAY_CONST DENOISE_VARIANCE = 3u;  ///< of one of the halves
SPLATRAY_CONST DENOISE_GUIDE = 4u;     ///< of a pass
SPLATRAY_CONST DENOISE_PASS = 5u;      ///< a pass, DenoiseParams::stride pixels between its taps
SPLATRAY_CONST DENOISE_JOIN = 6u;      ///< the picture of the light
SPLATRAY_CONST DENOISE_RIMS = 7u;      ///< the picture without noise
SPLATRAY_CONST DENOISE_KEEP = 8u;  ///< none of these: keeps the picture as the part of one of more samples
SPLATRAY_CONST DENOISE_STEPS = 9u;
SPLATRAY_CONST DENOISE_PASSES = 5u;  ///< the last one's taps lie 16 pixels apart

/// Numbers of the filter, one for both texts.
SPLATRAY_REAL DENOISE_BASE_LEAST = 0.05f;   ///< light of darker surfaces is that of such ones
SPLATRAY_REAL DENOISE_NOISE_WIDTH = 2.25f;  ///< standard errors of a difference by which light may differ
/// The same in the half that is filtered, whose own outliers stay out
SPLATRAY_REAL DENOISE_OWN_WIDTH = 6.0f;
/// How many times the light around a pixel may give to its surface: more would tint it by the chance of one sample.
SPLATRAY_REAL DENOISE_EXCESS_MOST = 32.0f;
SPLATRAY_REAL DENOISE_RIM_LIKENESS = 0.01f;  ///< less, and a neighbour is of another surface
/// Light of more, over a base colour, has a square beyond float32
SPLATRAY_REAL DENOISE_RADIANCE_MOST = 1e15f;
SPLATRAY_REAL DENOISE_LEAST_LIKE = 1e-6f;  ///< pixels less alike, all of them together, share no light
SPLATRAY_REAL DENOISE_SPARK = 1.5f;        ///< of the brightest in the other half: brighter is chance
/// By how much of their common length two base colours may differ. What highlights send back does not grow with the base colour, so that
/// light over base colour is another where that is; points' colours have noise of a fifth, which must not keep them apart.
SPLATRAY_REAL DENOISE_BASE_WIDTH = 0.5f;
SPLATRAY_REAL DENOISE_BASE_DARK = 0.1f;  ///< differences of darker base colours hardly count

/// Specialization constant: DENOISE_FINITE and its like.
SPLATRAY_CONST DENOISE_SPEC_STEP = 0u;

SPLATRAY_CONST DENOISE_PIECE = 256u;  ///< pixels of a piece of a row

struct DenoiseParams {
  uint width;  ///< pixels
  uint height;
  float share;    ///< of the samples, that `part` is of: Image::part_share
  float weight;   ///< of `means` beside `before`: of the samples, those that they are of
  uint light;     ///< the first of three planes that a pass reads
  uint filtered;  ///< the same that it writes
  uint stride;
  uint zero;
};

/// Planes of the filter's memory, a vec4 of each pixel.
SPLATRAY_CONST DENOISE_PLANE_RGBA = 0u;
/// From DENOISE_TAKE on: the picture of the light that is not filtered
SPLATRAY_CONST DENOISE_PLANE_PART = 1u;
SPLATRAY_CONST DENOISE_PLANE_BASE = 2u;     ///< w: the least change of depth towards a neighbour of the row
SPLATRAY_CONST DENOISE_PLANE_SURFACE = 3u;  ///< normal, depth
/// Bright of both halves, variance, w: as above, of the column; at the end the picture
SPLATRAY_CONST DENOISE_PLANE_GUIDE = 4u;
/// First of three planes: the first half with its variance, the second one, and the excess.
SPLATRAY_CONST DENOISE_PLANE_LIGHT = 5u;
SPLATRAY_CONST DENOISE_PLANES = 11u;  ///< with the other three

/// Words beside them, of each pixel: its object, whether it is of a rim; then whether each piece shows a surface.
SPLATRAY_CONST DENOISE_WORDS = 3u;

/// Descriptor bindings (set 0), storage buffers all.
SPLATRAY_CONST DENOISE_BIND_PARAMS = 0u;
SPLATRAY_CONST DENOISE_BIND_MEANS = 1u;   ///< vec4 of each pixel: the last samples' mean
SPLATRAY_CONST DENOISE_BIND_BEFORE = 2u;  ///< vec4 of each pixel: the mean of those before
SPLATRAY_CONST DENOISE_BIND_PART = 3u;    ///< vec4 of each pixel
SPLATRAY_CONST DENOISE_BIND_BASE = 4u;    ///< vec4 of each pixel: base colours
SPLATRAY_CONST DENOISE_BIND_AOV = 5u;     ///< AovPixel of each pixel
SPLATRAY_CONST DENOISE_BIND_PLANES = 6u;
SPLATRAY_CONST DENOISE_BIND_WORDS = 7u;
SPLATRAY_CONST DENOISE_BIND_RESULT = 8u;  ///< vec4 of each pixel
SPLATRAY_CONST DENOISE_BINDINGS = 9u;

#ifdef __cplusplus
}  // namespace splatray
#endif
#endif
