/// Points with normals and colours, as the generator makes them, and the PLY file they are written to.
#pragma once
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

namespace splatray {

/// Oriented points in metres, y up. Either all points have a colour or none has.
struct OrientedPoints {
  std::vector<glm::dvec3> position;
  std::vector<glm::dvec3> normal;  ///< unit, beside position
  std::vector<glm::dvec3> color;   ///< linear rgb, 0..1, beside position; empty = none
  bool is_scan = false;            ///< as a scanner has them: their file holds no normals
};

/// A colour (linear rgb) for a point, by its position.
using Paint = std::function<glm::dvec3(glm::dvec3 position)>;

/// The cloud rotated (`axes` holds the images of x, y, z; orthonormal), then moved.
[[nodiscard]] OrientedPoints moved(OrientedPoints cloud, glm::dvec3 offset,
                                   const glm::dmat3& axes = glm::dmat3(1.0));

/// The cloud with every normal turned round.
[[nodiscard]] OrientedPoints flipped(OrientedPoints cloud);

/// The cloud with `paint` on every point.
[[nodiscard]] OrientedPoints painted(OrientedPoints cloud, const Paint& paint);

/// The points at which `keep` is true.
[[nodiscard]] OrientedPoints kept(const OrientedPoints& cloud,
                                  const std::function<bool(glm::dvec3 position)>& keep);

/// Adds `more` behind the points of `cloud`; both have colours or neither has. One that is a scan makes all a scan.
void append(OrientedPoints& cloud, const OrientedPoints& more);

/// Writes a binary little-endian PLY: float x y z, nx ny nz but for scans and, with colours, uchar red green blue (sRGB).
/// Throws Error (failed) when the file cannot be written.
void write_ply(const OrientedPoints& cloud, const std::filesystem::path& path);

}  // namespace splatray
