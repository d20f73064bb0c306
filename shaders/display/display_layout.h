/// What crosses between C++ and display.comp.glsl, which makes of a picture's means what a screen takes.
#ifndef SPLATRAY_DISPLAY_LAYOUT_H
#define SPLATRAY_DISPLAY_LAYOUT_H
#include "../layout.h"

#ifdef __cplusplus
namespace splatray {
#endif

/// What a dispatch does.
SPLATRAY_CONST DISPLAY_PLAIN = 0u;         ///< shows a picture; a thread for each pixel
SPLATRAY_CONST DISPLAY_SEEN = 1u;          ///< shows one of LOOK_SEEN; a thread for each pixel
SPLATRAY_CONST DISPLAY_MEASURE_REST = 2u;  ///< adds up how bright the picture shown is, one at rest
SPLATRAY_CONST DISPLAY_MEASURE_SEEN = 3u;  ///< adds up how bright a picture of LOOK_SEEN is
SPLATRAY_CONST DISPLAY_MATCH = 4u;         ///< one thread: finds the gain of pictures of LOOK_SEEN
SPLATRAY_CONST DISPLAY_SUMMED = 128u;      ///< pixels that a thread measures: as many have sums of 32 bits

/// Tone curves that mix channels; others are in the table of bytes alone.
SPLATRAY_CONST DISPLAY_TONE_TABLE = 0u;
SPLATRAY_CONST DISPLAY_TONE_NEUTRAL = 1u;
SPLATRAY_CONST DISPLAY_TONE_AGX = 2u;

/// Specialization constants: DISPLAY_PLAIN and its like, DISPLAY_TONE_*.
SPLATRAY_CONST DISPLAY_SPEC_STEP = 0u;
SPLATRAY_CONST DISPLAY_SPEC_TONE = 1u;

struct DisplayParams {
  uint width;  ///< pixels
  uint height;
  uint samples;         ///< in each pixel of `means`
  uint next_row;        ///< rows above it have one more
  uint samples_before;  ///< in each pixel of `before`, which is not read where they are none
  float factor;         ///< of radiance before a curve that mixes channels: 2^exposure
  float dome_exponent;  ///< eye_dome.glsl
  float per_world;      ///< eye_dome.glsl
};

/// Upper bits of a float that the tables of bytes go by, and words of one of them: four bytes each, the first lowest.
SPLATRAY_CONST DISPLAY_DROPPED_BITS = 15u;
SPLATRAY_CONST DISPLAY_TABLE_WORDS = 1u << (30u - DISPLAY_DROPPED_BITS);
/// Words of the curves: the table of the display, that of colours shown as they are, and the linear values of 256 bytes, floats.
SPLATRAY_CONST DISPLAY_AS_IT_IS = DISPLAY_TABLE_WORDS;
SPLATRAY_CONST DISPLAY_LINEAR = 2u * DISPLAY_TABLE_WORDS;
SPLATRAY_CONST DISPLAY_CURVE_WORDS = DISPLAY_LINEAR + 256u;

/// Words of what is known of the pictures before. Two sums of brightness, in units of 1 / DISPLAY_BRIGHTNESS, 64 bits, and how many
/// pixels each is of: of the last picture at rest, and of the first of LOOK_SEEN after it.
SPLATRAY_CONST DISPLAY_SUM_REST = 0u;
SPLATRAY_CONST DISPLAY_SUM_SEEN = 3u;
SPLATRAY_CONST DISPLAY_GAIN = 6u;  ///< float: what makes pictures of LOOK_SEEN as bright as those at rest
SPLATRAY_CONST DISPLAY_CUT = 7u;   ///< not 0: the driver has cut the loops of some pixel
SPLATRAY_CONST DISPLAY_STATE_WORDS = 8u;
SPLATRAY_CONST DISPLAY_BRIGHTNESS = 65536u;

/// Descriptor bindings (set 0), storage buffers all.
SPLATRAY_CONST DISPLAY_BIND_PARAMS = 0u;
SPLATRAY_CONST DISPLAY_BIND_MEANS = 1u;   ///< vec4 of each pixel, the last samples' mean
SPLATRAY_CONST DISPLAY_BIND_BEFORE = 2u;  ///< vec4 of each pixel, the mean of those before
SPLATRAY_CONST DISPLAY_BIND_CURVES = 3u;
SPLATRAY_CONST DISPLAY_BIND_STATE = 4u;
SPLATRAY_CONST DISPLAY_BIND_PIXELS = 5u;  ///< a word of each pixel: rgba, 8 bits a channel, r lowest
SPLATRAY_CONST DISPLAY_BINDINGS = 6u;

#ifdef __cplusplus
}  // namespace splatray
#endif
#endif
