/// What an image may hold beside its colours, one row each: the names of --aov and the channels of EXR files are made of them.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/image/image.h"

namespace splatray {

/// Where an AOV's values come from.
enum class AovSource {
  centre_ray,  ///< Image::aov
  noise,       ///< Image::error
  albedo       ///< Image::albedo
};

struct Aov {
  const char* name;  ///< of --aov
  const char* help;
  std::vector<const char*> channels;  ///< of an EXR file
  AovSource source;
  /// Puts a pixel's values behind the others, one a channel.
  void (*put)(const Image& image, std::size_t pixel, std::vector<float>& values);
};

/// All of them, in the order of an EXR file's channels.
[[nodiscard]] std::span<const Aov> all_aovs();

/// Some of them: a bit each, in their order.
using AovSet = std::uint32_t;
[[nodiscard]] inline bool has_aov(AovSet set, std::size_t aov) { return (set >> aov & 1U) != 0; }
/// Whether any of the set comes from there.
[[nodiscard]] bool needs(AovSet set, AovSource source);
/// All that an image has.
[[nodiscard]] AovSet aovs_of(const Image& image);
/// Channels of all in the set.
[[nodiscard]] std::size_t count_channels(AovSet set);

}  // namespace splatray
