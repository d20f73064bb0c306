#include "preprocess/scan/smooth/reproject.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "preprocess/scan/plane_fit.h"
#include "preprocess/scan/smooth/layers.h"
#include "preprocess/surface/neighbours.h"
#include "preprocess/surface/number_lists.h"

namespace splatray {
namespace {

constexpr std::size_t NEIGHBOURS_AROUND = 24;  // neighbours
constexpr std::size_t LEAST_NEIGHBOURS = 6;    // of them, that a plane is put through
constexpr double LAYERED = 0.2;                // noise from which points are projected again
// Cosines of normals of one sheet: 40 degrees, so that edges stay sharp, and 60, as a hit's cluster has it, where points lie in
// layers. There the normals of one bent sheet scatter more, and what is left out makes holes.
constexpr float ONE_SHEET_COSINE = 0.766F, ONE_LAYERED_SHEET_COSINE = 0.5F;
constexpr float NARROW = 2.0F;  // of the weights: exp(-NARROW d^2 / the farthest's)

/// Sums of weighted places, and from them the plane through them.
struct WeightedPlace {
  double weight = 0.0;
  glm::dvec3 sum{0.0};
  Covariance products{};

  void add(const glm::vec3& offset, float w) {
    const glm::dvec3 d(offset);
    weight += w, sum += double{w} * d;
    products.xx += w * d.x * d.x, products.yy += w * d.y * d.y, products.zz += w * d.z * d.z;
    products.xy += w * d.x * d.y, products.xz += w * d.x * d.z, products.yz += w * d.y * d.z;
  }
  [[nodiscard]] glm::dvec3 mean() const { return sum / weight; }
  [[nodiscard]] glm::dvec3 axis() const {
    const glm::dvec3 m = mean();
    const double by = 1.0 / weight;
    const Covariance spread{by * products.xx - m.x * m.x, by * products.yy - m.y * m.y,
                            by * products.zz - m.z * m.z, by * products.xy - m.x * m.y,
                            by * products.xz - m.x * m.z, by * products.yz - m.y * m.z};
    return least_axis_of(spread, variances_of(spread));
  }
};

/// An axis on the side of a normal; the normal where there is none.
glm::vec3 sided(const glm::dvec3& axis, const glm::vec3& normal) {
  if (axis == glm::dvec3(0.0)) return normal;
  const glm::vec3 unit(axis);
  return glm::dot(unit, normal) < 0.0F ? -unit : unit;
}

/// Points that are looked at again, with their neighbours.
class Again {
 public:
  Again(Cloud& cloud, const Reprojection& how)
      : cloud_(cloud),
        how_(how),
        least_cosine_(projects() ? ONE_LAYERED_SHEET_COSINE : ONE_SHEET_COSINE),
        normal_(cloud.normal) {}

  /// Whether points are projected again.
  [[nodiscard]] bool projects() const { return how_.noise > LAYERED; }

  /// Finds the neighbours, and from them the first normals.
  void look(const Stage& stage) {
    const NeighbourSearch search(cloud_, Sites::oriented_surface);
    if (projects())
      listed_ = NumberLists<NEIGHBOURS_AROUND>(cloud_.size());  // once the search's own work is freed
    search.find_all(NEIGHBOURS_AROUND, stage, [&](std::uint32_t i, std::span<const Neighbour> nearest) {
      if (how_.moves[i] == 0) return;
      if (projects()) keep_list(i, nearest);
      Offsets offsets;
      for (const Neighbour& neighbour : nearest)
        if (is_like(i, neighbour.index())) offsets.add(cloud_.coord[neighbour.index()] - cloud_.coord[i]);
      normal_[i] = axis_of(offsets, cloud_.normal[i]);
    });
    std::swap(cloud_.normal, normal_);
  }

  /// Puts the points onto the planes of those around that are like-sided.
  void project(std::vector<float>& lift) {
    std::vector<float> here(cloud_.size());
    tbb::parallel_for(std::size_t{0}, cloud_.size(), [&](std::size_t i) {
      normal_[i] = cloud_.normal[i];
      if (how_.moves[i] == 0) return;
      const float by = -NARROW / farthest_squared(i);
      WeightedPlace plane;
      plane.add(glm::vec3(0.0F), 1.0F);
      std::size_t count = 0;
      for (const std::uint32_t j : listed_[i]) {
        if (j == i || !is_like(i, j)) continue;
        const glm::vec3 offset = cloud_.coord[j] - cloud_.coord[i];
        plane.add(offset, std::exp(by * glm::dot(offset, offset)));
        ++count;
      }
      if (count < LEAST_NEIGHBOURS) return;
      normal_[i] = sided(plane.axis(), cloud_.normal[i]);
      here[i] = static_cast<float>(glm::dot(glm::dvec3(normal_[i]), plane.mean()));
      lift[i] += here[i];
    });
    std::swap(cloud_.normal, normal_);
    move_points(cloud_, here);
  }

  /// Takes the normals from the points as they are now.
  void take_axes() {
    tbb::parallel_for(std::size_t{0}, cloud_.size(), [&](std::size_t i) {
      normal_[i] = cloud_.normal[i];
      if (how_.moves[i] == 0) return;
      Offsets offsets;
      for (const std::uint32_t j : listed_[i])
        if (j != i && is_like(i, j)) offsets.add(cloud_.coord[j] - cloud_.coord[i]);
      normal_[i] = axis_of(offsets, cloud_.normal[i]);
    });
    std::swap(cloud_.normal, normal_);
  }

 private:
  /// Whether two points are of one sheet: edges stay.
  [[nodiscard]] bool is_like(std::size_t i, std::size_t j) const {
    const float along = glm::dot(cloud_.normal[i], cloud_.normal[j]);
    return (how_.sided ? along : std::abs(along)) >= least_cosine_ &&
           is_same_sheet(how_.sheet_end, i, glm::dot(cloud_.normal[i], cloud_.coord[j] - cloud_.coord[i]));
  }

  static glm::vec3 axis_of(const Offsets& offsets, const glm::vec3& normal) {
    if (offsets.count < LEAST_NEIGHBOURS) return normal;
    const Covariance spread = covariance_of(offsets, offsets.count);
    return sided(least_axis_of(spread, variances_of(spread)), normal);
  }

  /// Squared distance of the farthest listed neighbour; positive where there are any.
  [[nodiscard]] float farthest_squared(std::size_t i) const {
    float squared = 0.0F;
    for (const std::uint32_t j : listed_[i]) {
      const glm::vec3 offset = cloud_.coord[j] - cloud_.coord[i];
      squared = std::max(squared, glm::dot(offset, offset));
    }
    return squared;
  }

  void keep_list(std::uint32_t i, std::span<const Neighbour> nearest) {
    NumberLists<NEIGHBOURS_AROUND>::List list;
    std::fill(
        std::transform(nearest.begin(), nearest.end(), list.begin(), [](Neighbour n) { return n.index(); }),
        list.end(), i);
    listed_.set(i, list);
  }

  Cloud& cloud_;
  Reprojection how_;
  float least_cosine_;                     ///< of normals of one sheet
  NumberLists<NEIGHBOURS_AROUND> listed_;  ///< of each point that moves, or fewer and itself
  std::vector<glm::vec3> normal_;          ///< those that come next
};

}  // namespace

void reproject_points(Cloud& cloud, const Reprojection& how, std::vector<float>& lift, const Stage& stage) {
  Again again(cloud, how);
  again.look(stage);
  if (again.projects()) {
    again.project(lift);
    again.take_axes();
  }
}

}  // namespace splatray
