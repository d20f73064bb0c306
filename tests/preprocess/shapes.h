/// Point sets with known geometry, for tests of preprocess.
#pragma once
#include <cstdint>

#include "preprocess/build.h"
#include "preprocess/surface/cloud.h"

namespace splatray::test {

/// Progress that is reported to no one.
inline const Progress SILENT;

/// `count` points on the unit sphere at `center`, with outward normals and its area. Even: a Fibonacci
/// spiral.
[[nodiscard]] InputObject even_sphere(std::size_t count, glm::dvec3 center = glm::dvec3(0.0));
/// The same, uniformly at random (white noise).
[[nodiscard]] InputObject random_sphere(std::size_t count, std::uint64_t seed);
/// side x side points of a square lattice in the plane z = 0, `spacing` apart, from the origin, normals +z.
[[nodiscard]] InputObject square_lattice(std::size_t side, double spacing);

[[nodiscard]] Input input_of(InputObject object);
/// The object's points in another order, attributes with them.
[[nodiscard]] InputObject shuffled(const InputObject& object, std::uint64_t seed);
/// make_cloud without its counts.
[[nodiscard]] Cloud cloud_of(InputObject object);

}  // namespace splatray::test
