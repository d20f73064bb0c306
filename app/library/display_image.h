/// Pictures as a display shows them.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "engine/image/image.h"

namespace splatray {

/// Display-encoded picture, 0..1 per channel, top row first.
struct DisplayImage {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<vec3> rgb;
  std::vector<float> alpha{};  ///< coverage, with colours that are not multiplied by it; empty: opaque
  double dots_per_inch = 0.0;  ///< on paper; 0: for no paper
};

/// How what is brighter than a display can be is brought below 1.
enum class Tone {
  soft,  ///< each channel alone: identity up to 0.8, then 1 - 0.2 exp(-(x - 0.8) / 0.2), which joins with equal slope
  neutral,  ///< Khronos PBR Neutral (2024): colours below 0.76 keep their hue and saturation, brighter ones go towards white
  agx,  ///< AgX (T. Sobotka 2022) with the base look, by the polynomial of B. Wrensch 2023: like film, all colours softer
  none  ///< cut off at 1
};
inline constexpr std::array TONE_NAMES = {"soft", "neutral", "agx", "none"};  ///< of Tone

/// What stands between a picture and a display.
struct Display {
  Display(double ev = 0.0, Tone curve = Tone::soft, bool covers = false)
      : exposure_ev(ev), tone(curve), transparent(covers) {}  // NOLINT: a number of stops alone will do

  double exposure_ev;  ///< brightness, stops
  Tone tone;
  bool transparent;  ///< what nothing covers shows through

  bool operator==(const Display&) const = default;
};

/// The tone curve of linear radiance, after 2^exposure_ev: linear, each channel 0..1; NaN and negative values become 0.
[[nodiscard]] vec3 toned(vec3 radiance, const Display& display);
/// Linear radiance to display value: toned, then the sRGB transfer function.
[[nodiscard]] vec3 display_value(vec3 radiance, const Display& display);
[[nodiscard]] DisplayImage display_image(const Image& image, const Display& display);

/// The exposure, stops, that brings the mean of the logarithm of what objects' pixels send out to that of a grey of 0.25, less where
/// the brightest twentieth would come near white, but not so little that the median is dark; of all pixels where none is covered; 0
/// where all are black.
[[nodiscard]] double automatic_exposure_ev(const Image& image);
/// Rounds each channel to the 8 bits a PNG stores.
void quantise(DisplayImage& image);

}  // namespace splatray
