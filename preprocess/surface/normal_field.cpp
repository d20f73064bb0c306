#include "preprocess/surface/normal_field.h"

#include <algorithm>
#include <cmath>

#include "engine/base/vector_clones.h"
#include "engine/scene/splat.h"
#include "preprocess/surface/sheet.h"

namespace splatray {
namespace {

constexpr double NORMAL_RIDGE = 1e-3;  // keeps the fit defined where neighbours lie in a line

/// Sums of the fit of a symmetric matrix [[x, y], [y, z]] that maps tangential offsets to leans: of the normal equations
/// for (u, v, 0) and (0, u, v), whose matrix is [[uu, uv, 0], [uv, uu + vv, uv], [0, uv, vv]].
class SlopeFit {
 public:
  void add(const glm::dvec2& offset, const glm::dvec2& lean, double weight) {
    const glm::dvec2 squared = offset * offset;
    uu_ += weight * squared.x;
    uv_ += weight * (offset.x * offset.y);
    both_ += weight * (squared.y + squared.x);
    vv_ += weight * squared.y;
    right_ +=
        weight * glm::dvec3(offset.x * lean.x, offset.y * lean.x + offset.x * lean.y, offset.y * lean.y);
    variance_ += weight * glm::dot(lean, lean);
  }

  /// The matrix' x, y, z times the share of the leans' variance it explains; zero where nothing is known.
  [[nodiscard]] glm::dvec3 solve() const {
    const double trace = uu_ + both_ + vv_;
    if (!(trace > 0.0) || !(variance_ > 0.0)) return glm::dvec3(0.0);
    const glm::dmat3 normal(uu_, uv_, 0.0, uv_, both_, uv_, 0.0, uv_, vv_);
    const glm::dvec3 slope = glm::inverse(normal + glm::dmat3(NORMAL_RIDGE * trace)) * right_;
    const double explained = 2.0 * glm::dot(slope, right_) - glm::dot(slope, normal * slope);
    return slope * std::clamp(explained / variance_, 0.0, 1.0);
  }

 private:
  double uu_ = 0.0, uv_ = 0.0, both_ = 0.0, vv_ = 0.0;
  glm::dvec3 right_{0.0};
  double variance_ = 0.0;
};

/// Neighbours on a point's tangent plane.
struct Leans {
  Leans(const Neighbourhood& around, const glm::dvec3& normal) {
    const TangentFrame frame(normal);
    const std::size_t count = around.count;
    VectorsAround unit;
    for (std::size_t j = 0; j < count; ++j) {
      const double x = around.normals.x[j], y = around.normals.y[j], z = around.normals.z[j];
      const double inverse_length = 1.0 / std::sqrt(x * x + y * y + z * z);
      unit.x[j] = x * inverse_length;
      unit.y[j] = y * inverse_length;
      unit.z[j] = z * inverse_length;
    }
    unit.dot(normal, count, along);
    unit.dot(frame.u, count, lean_u);
    unit.dot(frame.v, count, lean_v);
    around.offset.dot(frame.u, count, offset_u);
    around.offset.dot(frame.v, count, offset_v);
    for (std::size_t j = 0; j < count; ++j) {
      lean_u[j] /= along[j];
      lean_v[j] /= along[j];
      weight[j] = 1.0 / around.distance_squared[j];
    }
  }

  NumbersAround along;           ///< the normal's component along the point's
  NumbersAround lean_u, lean_v;  ///< of the normal or its opposite, whichever is on the point's side
  NumbersAround offset_u, offset_v;
  NumbersAround weight;
};

}  // namespace

SPLATRAY_VECTOR_CLONES glm::vec3 fit_normal_field(const Neighbourhood& around) {
  const Leans leans(around, glm::normalize(around.normal));
  SlopeFit fit;
  for (std::size_t j = 0; j < around.count; ++j) {
    const double along = around.oriented ? leans.along[j] : std::abs(leans.along[j]);
    const glm::dvec2 offset(leans.offset_u[j], leans.offset_v[j]);
    if (along < SHEET_COSINE ||
        glm::dot(offset, offset) < SHEET_LATERAL * SHEET_LATERAL * around.distance_squared[j])
      continue;
    fit.add(offset, {leans.lean_u[j], leans.lean_v[j]}, leans.weight[j]);
  }
  return glm::vec3(fit.solve());
}

}  // namespace splatray
