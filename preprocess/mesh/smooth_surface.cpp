#include "preprocess/mesh/smooth_surface.h"

#include <algorithm>
#include <cmath>

#include "preprocess/base/unit_or_zero.h"

namespace splatray {
namespace {

/// Cosines of 45 and 30 degrees: normals that turn by more along an edge are of a coarse drawing, not of a smooth surface.
constexpr double SHARP_COSINE = 0.7071067811865476, SMOOTH_COSINE = 0.8660254037844387;
constexpr double LEANS_COSINE = 0.99985;  // 1 degree: discs that lean less leave no slits
constexpr double COARSE = 8.0;  // least height of a facet, in samples' distances, that a disc is small beside
constexpr double ONE_PLANE = 0.99;  // cosine, 8 degrees: planes that meet in no clear line

/// The shortest vector from which `along` leads into both planes through the origin with these unit normals.
glm::dvec3 from_planes(const glm::dvec3& along, const glm::dvec3& normal, const glm::dvec3& other) {
  const double cosine = glm::dot(normal, other);
  const double height = glm::dot(along, normal), other_height = glm::dot(along, other);
  if (std::abs(cosine) > ONE_PLANE) return 0.5 * (height * normal + other_height * other);
  return ((height - cosine * other_height) * normal + (other_height - cosine * height) * other) /
         (1.0 - cosine * cosine);
}

}  // namespace

glm::dvec3 SmoothTriangle::place(const glm::dvec3& weights) const {
  glm::dvec3 chord(0.0), off(0.0);
  for (glm::length_t i = 0; i < 3; ++i) {
    const auto corner = static_cast<std::size_t>(i);
    chord += weights[i] * corners[corner];
    off += weights[i] * weights[(i + 1) % 3] * bow[corner];
  }
  return chord + 0.5 * off;
}

glm::dvec3 SmoothTriangle::normal(const glm::dvec3& weights) const {
  std::array<glm::dvec3, 3> slope;  // how the place changes with each weight
  for (std::size_t i = 0; i < 3; ++i) {
    const auto next = static_cast<glm::length_t>((i + 1) % 3),
               before = static_cast<glm::length_t>((i + 2) % 3);
    slope[i] = corners[i] + 0.5 * (weights[next] * bow[i] + weights[before] * bow[(i + 2) % 3]);
  }
  return unit_or_zero(glm::cross(slope[1] - slope[0], slope[2] - slope[0]));
}

double SmoothTriangle::least_height() const {
  const glm::dvec3 first = corners[1] - corners[0], second = corners[2] - corners[1];
  const double longest = std::max({glm::length(first), glm::length(second), glm::length(first + second)});
  return longest > 0.0 ? glm::length(glm::cross(first, second)) / longest : 0.0;
}

glm::vec3 SmoothTriangle::disc_normal(const glm::dvec3& weights, const glm::vec3& seen,
                                      double spacing_world) const {
  if (least_height() < COARSE * spacing_world) return seen;
  const glm::dvec3 plane = normal(weights);
  const double along = glm::dot(plane, glm::dvec3(seen));
  if (std::abs(along) > LEANS_COSINE || std::abs(along) < SHARP_COSINE) return seen;
  return glm::vec3(along < 0.0 ? -plane : plane);
}

glm::dvec3 SmoothSurface::corner_normal(std::uint32_t triangle, glm::uint place) const {
  const glm::uvec3& t = mesh_.triangles[triangle];
  const std::size_t corner = weld_[t.x] == place ? 0 : (weld_[t.y] == place ? 1 : 2);
  return glm::dvec3(corners_[3 * std::size_t{triangle} + corner]);
}

/// The same bits from both triangles of an edge.
glm::dvec3 SmoothSurface::bow_of(std::uint32_t triangle, std::uint32_t side) const {
  const std::size_t first = 3 * std::size_t{triangle};
  if (chords_.empty() || chords_[first + side] == 0) return glm::dvec3(0.0);
  const std::uint32_t beside = edges_.beside(triangle, side);
  const glm::uvec3& t = mesh_.triangles[triangle];
  const auto from = static_cast<glm::length_t>(side), to = (from + 1) % 3;
  const glm::dvec3 normal_from(corners_[first + side]), normal_to(corners_[first + (side + 1) % 3]);
  const glm::dvec3 other_from = corner_normal(beside, weld_[t[from]]),
                   other_to = corner_normal(beside, weld_[t[to]]);
  const double turn = std::min(glm::dot(normal_from, normal_to), glm::dot(other_from, other_to));
  const glm::dvec3 along = mesh_.vertices.position[t[from]] - mesh_.vertices.position[t[to]];
  return glm::smoothstep(SHARP_COSINE, SMOOTH_COSINE, turn) *
         (from_planes(along, normal_from, other_from) - from_planes(along, normal_to, other_to));
}

SmoothTriangle SmoothSurface::triangle(std::uint32_t index) const {
  SmoothTriangle smooth;
  for (std::uint32_t i = 0; i < 3; ++i) {
    smooth.corners[i] = mesh_.vertices.position[mesh_.triangles[index][static_cast<glm::length_t>(i)]];
    smooth.bow[i] = bow_of(index, i);
  }
  return smooth;
}

}  // namespace splatray
