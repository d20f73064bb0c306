/// Points of the unit square that shapes map to their surfaces.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace splatray {

/// How many points, and how they are spread. The result depends on nothing else.
struct Sampling {
  std::uint64_t count = 0;
  bool even = true;        ///< golden-ratio lattice; false = independent random points (white noise)
  std::uint64_t seed = 1;  ///< white noise: the random sequence; even: a shift of the lattice
};

/// `count` points of [0,1)^2. The even ones, (i + 1/2) / count and the fraction of i / golden ratio, stay
/// well spaced under every area-preserving map that stretches along the axes (González 2010, "Measurement of
/// Areas on a Sphere Using Fibonacci and Latitude-Longitude Lattices", for the sphere), so a shape needs only
/// such a map to be sampled evenly.
[[nodiscard]] std::vector<glm::dvec2> unit_square(const Sampling& sampling);

}  // namespace splatray
