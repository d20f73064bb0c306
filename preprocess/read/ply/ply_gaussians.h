/// Captures of 3D Gaussians in PLY files: those of training (Kerbl et al. 2023), also flat ones (2D Gaussians, Huang et al. 2024), and
/// the packed ones of PlayCanvas (SuperSplat's "compressed PLY": 256 Gaussians a chunk, 16 bytes each).
#pragma once
#include <string>
#include <vector>

#include "preprocess/points.h"
#include "preprocess/read/ply/ply_body.h"
#include "preprocess/read/scan/gaussian_surface.h"

namespace splatray {

/// What the packed values of 256 Gaussians lie between: places, logarithms of deviations, and display-encoded colours.
struct GaussianChunk {
  glm::dvec3 least_place, most_place, least_scale, most_scale;
  glm::dvec3 least_color{0.0}, most_color{1.0};
};

/// Reads the elements of such a file, as they follow each other in it.
class PlyGaussians {
 public:
  /// Whether an element's rows are Gaussians, plain (f_dc_0 or rot_0) or packed (packed_position).
  [[nodiscard]] static bool are_in(const PlyElement& vertices);
  /// Whether this element of such a file is to be read by read().
  [[nodiscard]] static bool takes(const PlyElement& element);
  /// Reads an element's rows; `in` stands on the first. How many there are, which may be less than the element declares. Throws
  /// Error (input_unreadable) where properties or chunks are missing.
  std::uint64_t read(PlyBody& in, const PlyElement& element);
  /// The points, behind the last element; what became of the Gaussians goes to `note`. Throws Error (input_unreadable) where none is left.
  [[nodiscard]] Points take(const PlyBody& in, const Progress& progress, std::string& note);

 private:
  std::vector<GaussianChunk> chunks_;
  GaussianSurface surface_;
};

}  // namespace splatray
