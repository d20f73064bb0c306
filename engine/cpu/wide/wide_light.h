/// Light at many places at once: random numbers, directions towards the environment, and how plain surfaces scatter. Plain data alone, as
/// in wide_walk.h.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "shaders/layout.h"

namespace splatray {

/// Places that are looked at together, at most.
inline constexpr std::uint32_t WIDE_PLACES = 256;

/// A number of each place.
template <class Value>
struct alignas(64) OfPlaces : std::array<Value, WIDE_PLACES> {};
/// A vector of each place.
using VectorsOfPlaces = std::array<OfPlaces<float>, 3>;

/// What all places share.
struct WideLight {
  const Material* materials;            ///< by object
  const float* albedo;                  ///< the albedo table (shaders/lang/albedo_layout.h)
  const std::uint32_t* sky;             ///< words of the sky table (engine/scene/sky/sky_table.h)
  const vec4* environment;              ///< texels
  std::uint32_t sky_width, sky_height;  ///< cells; 0: no light comes from the environment
  std::uint32_t environment_width, environment_height;
  std::array<float, 3> right, up, back;  ///< the environment's axes in the world
  std::array<float, 3> factor;           ///< on the texels
  std::uint32_t seed;
  bool layered;  ///< surfaces have a layer that mirrors over their base
};

/// Vertices of paths on surfaces that are plain: neither metal nor glass, without a coat, and no mirrors.
struct WideVertices {
  std::uint32_t count = 0;
  OfPlaces<std::uint32_t> pixel, sample, bounce, object;
  VectorsOfPlaces normal;  ///< unit, against the ray
  VectorsOfPlaces dir;     ///< of the ray, unit
  VectorsOfPlaces base;    ///< base colours, 0..1
  /// Set by WideSampler: the numbers that choose a light and its point, and a direction of the world towards the environment, its radiance
  /// and its probability per solid angle, as sky_sample of shaders/light/sky.glsl gives them.
  VectorsOfPlaces light_random, light_dir, radiance;
  OfPlaces<float> light_pdf;
  /// Set by WideScatterer: bsdf_value of shaders/light/bsdf.glsl towards light_dir and its `pdf`; a direction of the world that the path
  /// goes on in, its weight and probability, and the number that decides whether it does.
  VectorsOfPlaces value, next_dir, weight;
  OfPlaces<float> value_pdf, next_pdf, next_random;
};

/// Rays that meet nothing.
struct WideEscapes {
  std::uint32_t count = 0;
  VectorsOfPlaces dir;       ///< unit
  VectorsOfPlaces radiance;  ///< set: of the environment there
  OfPlaces<float> pdf;  ///< set: as sky_pdf of shaders/light/sky.glsl gives it; 0 where there is no sky table
};

using WideSampler = void (*)(const WideLight& light, WideVertices& vertices);
using WideScatterer = void (*)(const WideLight& light, WideVertices& vertices);
using WideEscaper = void (*)(const WideLight& light, WideEscapes& escapes);

}  // namespace splatray
