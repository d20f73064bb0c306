/// What a ray sees of a capture of 3D Gaussians (Kerbl et al. 2023, "3D Gaussian Splatting for Real-Time Radiance Field Rendering").
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <vector>

#include "preprocess/read/scan/box_cells.h"

namespace splatray {

/// One Gaussian as captures store it, decoded.
struct Gaussian {
  glm::dvec3 center_world;
  glm::dvec3 deviation_world;  ///< standard deviations along its axes, >= 0
  glm::dquat axes;             ///< turns x, y and z to its axes; of any length but 0
  double opacity;              ///< in its centre, 0..1
  glm::dvec3 color;            ///< display-encoded, seen from all sides on average; 0..1 is shown
};

/// Its greatest deviation.
[[nodiscard]] double size_of(const Gaussian& one);

/// Its deviations, none less than a ten-thousandth of the greatest.
[[nodiscard]] glm::dvec3 flat_deviations(const Gaussian& one);

/// The numbers of its axes, from the shortest to the longest.
[[nodiscard]] glm::ivec3 axes_by_length(const Gaussian& one);

/// What a ray into the capture meets.
struct GaussianSight {
  double share_left;         ///< of the light that comes from outside, at the place that was asked for
  glm::dvec3 surface_world;  ///< where half of it is lost
  glm::dvec3 color;          ///< of all that the ray meets, blended from the front on; display-encoded
};

/// Gaussians and cells that find them.
class GaussianCloud {
 public:
  /// What one thread needs again and again.
  struct Scratch {
    struct Hit {
      double along_world, alpha;
      std::uint32_t gaussian;
    };
    std::vector<std::uint32_t> seen_by, near;
    std::vector<Hit> hits;
    std::uint32_t search = 0;
  };

  /// Takes at least one; each has finite numbers and a deviation above 0.
  explicit GaussianCloud(const std::vector<Gaussian>& gaussians);

  /// Out of the capture at a place: against the gradient of its density, blurred by the median Gaussian's deviation so that a surface has a
  /// smooth field (Yu et al. 2024, "Gaussian Opacity Fields", for normals by the gradient). Unit; none where nothing is near.
  [[nodiscard]] std::optional<glm::dvec3> outward(const glm::dvec3& place_world) const;

  /// What a ray against `outward` through the place meets within two median deviations before and behind it: each Gaussian at its greatest
  /// density on the ray (Kerbl et al. 2023; the half as the median depth of Huang et al. 2024, "2D Gaussian Splatting"). None where less than
  /// half of the light is lost.
  [[nodiscard]] std::optional<GaussianSight> look(const glm::dvec3& place_world, const glm::dvec3& outward,
                                                  Scratch& scratch) const;

 private:
  struct Part {
    glm::dvec3 center_world;
    glm::dmat3 precision;          ///< the inverse of its covariance
    glm::dmat3 blurred_precision;  ///< of that with the blur
    double opacity, blurred_opacity;
    glm::dvec3 color;
    double most_deviations_squared;  ///< within which its alpha is not too faint
  };
  /// Around what of a part a ray can meet; few bytes, as nearly all of them are passed by.
  struct Ball {
    glm::vec3 center;  ///< from origin_world_
    float radius_world;
  };

  [[nodiscard]] Part part_of(const Gaussian& one) const;
  /// Fills scratch.near with the numbers of all balls that the line meets within `reach_world` of the place.
  void find_near(const glm::dvec3& place_world, const glm::dvec3& direction, double reach_world,
                 Scratch& scratch) const;

  double median_world_;  ///< of the greatest deviation
  glm::dvec3 origin_world_{0.0};
  std::vector<Part> parts_;
  std::vector<Ball> balls_;            ///< beside parts_
  BoxCells alpha_cells_, blur_cells_;  ///< boxes of parts where they are not too faint, and of their blur
};

}  // namespace splatray
