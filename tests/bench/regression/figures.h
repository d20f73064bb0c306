/// What is measured of a build's pictures and points. Of all figures less is better.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "engine/scene/camera.h"

namespace splatray::testing {

using Figures = std::map<std::string, double>;

/// A picture of a camera, and the mesh that it should show.
struct PictureOfMesh {
  std::filesystem::path picture;  ///< EXR with depth and normal
  Camera camera;
};

/// Over all pixels of the pictures, beside the mesh's (mesh_truth):
/// - wrong: hit in one and miss in the other, ppm of all
/// - holes: of those with a surface off its silhouettes, those that show none or one behind it, ppm
/// - far: that show one before it, further than 1 % of the mesh's diagonal, ppm of all
/// - depth p50, depth p95: off the true one, ppm of the diagonal
/// - normals p50, normals p95, normals p99: degrees
/// - pixels: how many there were, which is no figure but says how noisy the shares are.
[[nodiscard]] Figures picture_figures(const std::filesystem::path& mesh,
                                      const std::vector<PictureOfMesh>& pictures);

/// Of the points that a scene draws (`drawn`, a file of them with normals), each as the measured point nearest to it:
/// - sides: turned away from the scanner, ppm of those on surfaces; normals p50, normals p95: off the true axis, degrees
/// - lost: points on surfaces that are not drawn, ppm; strays: of mixed pixels and strays those that are drawn, percent
/// - moved: points further from all measured ones than 1/500 of the diagonal, ppm.
[[nodiscard]] Figures point_figures(const std::filesystem::path& scan, const std::filesystem::path& truth,
                                    const std::filesystem::path& drawn);

/// Of a picture: light, the mean radiance where something is; cover, the mean coverage. No figures yet: compared with others of the
/// same view they are.
[[nodiscard]] Figures light_figures(const std::filesystem::path& picture);

/// The mean light of parts x parts equal parts of a picture, row by row from the top.
[[nodiscard]] std::vector<std::vector<double>> part_means(const std::filesystem::path& picture,
                                                          std::uint32_t parts);

}  // namespace splatray::testing
