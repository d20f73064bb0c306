#include "engine/scene/scene.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

namespace splatray {
namespace {

constexpr int OCT = static_cast<int>(OCT_SCALE);
constexpr int AXIS_SCALE = static_cast<int>(SLAB_AXIS_SCALE);
constexpr std::uint32_t LATTICE_SIZE = 1U << LATTICE_BITS;

int sign_not_zero(double value) { return value < 0.0 ? -1 : 1; }

/// The octahedral coordinates of a normal, not rounded.
glm::dvec2 octahedral_exact(const glm::dvec3& normal, int scale) {
  const double sum = std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z);
  const glm::dvec2 exact = glm::dvec2(normal) * (scale / sum);
  if (normal.z >= 0.0) return exact;
  return {(scale - std::abs(exact.y)) * sign_not_zero(exact.x),
          (scale - std::abs(exact.x)) * sign_not_zero(exact.y)};
}

/// The two octahedral coordinates, of the four around the exact ones, whose direction is nearest the normal
/// ("precise" encoding, Cigolle et al. 2014, sec. 3.3).
glm::ivec2 octahedral_nearest(const glm::dvec3& normal, int scale) {
  const glm::dvec2 exact = octahedral_exact(normal, scale);
  glm::ivec2 best{0};
  double best_dot = -2.0;
  for (int corner = 0; corner < 4; ++corner) {
    const int u = std::clamp(static_cast<int>(std::floor(exact.x)) + (corner & 1), -scale, scale);
    const int v = std::clamp(static_cast<int>(std::floor(exact.y)) + (corner >> 1), -scale, scale);
    const glm::dvec3 vector = octahedral_vector(u, v, scale);
    const double dot = glm::dot(normal, vector) / glm::length(vector);
    if (dot > best_dot) {
      best_dot = dot;
      best = {u, v};
    }
  }
  return best;
}

std::uint32_t lattice_coordinate(double value) {
  const double rounded = std::round(value);
  assert(rounded >= 0.0 && rounded < LATTICE_SIZE);
  return static_cast<std::uint32_t>(rounded);
}

/// The 16 stored bits of a squared radius, rounded up.
std::uint32_t pack_radius_squared(double radius_squared) {
  assert(std::isfinite(radius_squared) && radius_squared >= 0.0 && radius_squared <= 0x1p100);
  float value = std::max(static_cast<float>(radius_squared), 2.0F);
  if (value < radius_squared) value = std::nextafter(value, INFINITY);
  return ((std::bit_cast<std::uint32_t>(value) + 0x3FFFU) >> 14) & 0xFFFFU;
}

std::uint32_t encode_channel(float linear) {
  const float clamped = linear > 0.0F ? std::min(linear, 1.0F) : 0.0F;  // NaN becomes 0
  return static_cast<std::uint32_t>(std::lround(255.0F * std::sqrt(clamped)));
}

std::uint32_t encode_slope(double slope) {
  const double q = std::copysign(std::sqrt(std::min(std::abs(2.0 * slope), 1.0)), slope) * FIELD_SCALE;
  return static_cast<std::uint32_t>(std::lround(q) + 512);
}

/// Of a slab's five bits, in units of the cell's half size.
double slab_thickness(std::uint32_t bits) {
  return (1.0 + 0.25 * (bits & 3U)) * (1U << (bits >> 2)) / SLAB_THINNEST;
}

/// Splats in one of the parts that a leaf's halves are told in.
std::uint32_t list_share(std::uint32_t listed) { return (listed + SLAB_SHARES - 1) / SLAB_SHARES; }

double decode_slope(std::uint32_t bits) {
  const double q = (static_cast<double>(bits & 0x3FFU) - 512.0) / FIELD_SCALE;
  return 0.5 * q * std::abs(q);
}

}  // namespace

uvec4 pack_splat(const Splat& splat) {
  assert(splat.object <= OBJECT_MASK);
  assert(glm::dot(splat.normal, splat.normal) > 0.0 && std::isfinite(glm::dot(splat.normal, splat.normal)));
  const std::uint32_t x = lattice_coordinate(splat.center.x);
  const std::uint32_t y = lattice_coordinate(splat.center.y);
  const std::uint32_t z = lattice_coordinate(splat.center.z);
  const glm::ivec2 oct = octahedral_nearest(splat.normal, OCT);
  return {x << 11 | y >> 10, y << 22 | z,
          static_cast<std::uint32_t>(oct.x + OCT) | static_cast<std::uint32_t>(oct.y + OCT) << 16,
          pack_radius_squared(splat.radius_squared) << 16 | splat.object};
}

std::uint32_t pack_color(glm::vec3 linear) {
  return encode_channel(linear.x) | encode_channel(linear.y) << 8 | encode_channel(linear.z) << 16 |
         0xFF000000U;
}

glm::vec3 unpack_color(std::uint32_t color) {
  const glm::vec3 root = glm::vec3(color & 0xFFU, color >> 8 & 0xFFU, color >> 16 & 0xFFU) / 255.0F;
  return root * root;
}

TangentFrame::TangentFrame(const glm::dvec3& n) {
  const double sign = n.z >= 0.0 ? 1.0 : -1.0;
  const double a = -1.0 / (sign + n.z);
  u = {1.0 + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
  v = {n.x * n.y * a, sign + n.y * n.y * a, -n.y};
}

std::uint32_t pack_field(const glm::dmat3& slope, const glm::dvec3& normal) {
  const TangentFrame frame(normal);
  return encode_slope(glm::dot(frame.u, slope * frame.u)) |
         encode_slope(glm::dot(frame.u, slope * frame.v)) << 10 |
         encode_slope(glm::dot(frame.v, slope * frame.v)) << 20;
}

glm::dmat3 unpack_field(std::uint32_t field, const glm::dvec3& normal) {
  const TangentFrame frame(normal);
  const double uv = decode_slope(field >> 10);
  return decode_slope(field) * glm::outerProduct(frame.u, frame.u) +
         uv * (glm::outerProduct(frame.u, frame.v) + glm::outerProduct(frame.v, frame.u)) +
         decode_slope(field >> 20) * glm::outerProduct(frame.v, frame.v);
}

glm::dvec3 nearest_slab_axis(const glm::dvec3& direction) {
  const glm::ivec2 oct = octahedral_nearest(direction.x < 0.0 ? -direction : direction, AXIS_SCALE);
  return octahedral_vector(oct.x, oct.y, AXIS_SCALE) / static_cast<double>(AXIS_SCALE);
}

std::uint32_t pack_slab(const Slab& slab, std::uint32_t listed) {
  assert(slab.low >= -1.0 && slab.low <= slab.high && slab.high <= 1.0);
  assert(slab.lower_end <= listed && slab.upper_begin <= listed);
  assert(slab.axis == nearest_slab_axis(slab.axis));
  const auto oct = glm::ivec2(glm::round(octahedral_exact(slab.axis, AXIS_SCALE)));
  const double low = std::min(std::floor(slab.low * SLAB_SCALE), SLAB_SCALE - 1.0);
  std::uint32_t thickness = 0;
  while (low / SLAB_SCALE + slab_thickness(thickness) < slab.high) ++thickness;
  const std::uint32_t share = list_share(listed);
  const std::uint32_t lower = std::max((slab.lower_end + share - 1) / share, 1U) - 1;
  const std::uint32_t upper = std::min(slab.upper_begin / share, SLAB_SHARES - 1);
  return static_cast<std::uint32_t>(oct.x) | static_cast<std::uint32_t>(oct.y + AXIS_SCALE) << 5 |
         static_cast<std::uint32_t>(low + SLAB_SCALE) << 11 | thickness << 19 | lower << 24 | upper << 28;
}

Slab unpack_slab(std::uint32_t word, std::uint32_t listed) {
  const int u = static_cast<int>(word & 31U);
  const int v = static_cast<int>(word >> 5 & 63U) - AXIS_SCALE;
  const double low = static_cast<double>(word >> 11 & 255U) / SLAB_SCALE - 1.0;
  const std::uint32_t share = list_share(listed);
  return {octahedral_vector(u, v, AXIS_SCALE) / static_cast<double>(AXIS_SCALE), low,
          low + slab_thickness(word >> 19 & 31U), std::min(share * ((word >> 24 & 15U) + 1), listed),
          std::min(share * (word >> 28), listed)};
}

int halved_axis(const glm::dvec3& slab_axis) {
  const glm::dvec3 along = glm::abs(slab_axis);
  if (along.x <= along.y && along.x <= along.z) return 0;
  return along.y <= along.z ? 1 : 2;
}

OctreeBox empty_box(std::uint32_t word, const OctreeCell& cell) {
  const auto steps = [word](int first_bit) {
    return glm::ivec3(word >> first_bit & 3U, word >> (first_bit + 4) & 3U, word >> (first_bit + 8) & 3U);
  };
  const auto size = static_cast<int>(cell.size);
  const glm::ivec3 low(cell.low);
  return {low - size * steps(0), low + size + size * steps(2)};
}

std::vector<OctreeCell> leaf_cells(const Scene& scene) {
  std::vector<OctreeCell> cells(scene.begin_end.size() - 1);
  visit_cells(scene, [&cells](std::uint32_t word, const OctreeCell& cell) {
    if (word >> NODE_TAG_SHIFT == NODE_FILLED) cells[word & NODE_ADDRESS_MASK] = cell;
    return true;
  });
  return cells;
}

std::uint32_t top_levels(std::size_t splats, std::size_t filled_leaves) {
  if (filled_leaves > std::size_t{1} << TOP_LEAF_SHIFT) return 0;
  std::uint32_t levels = 0;
  while (levels < TOP_LEVELS_MOST && std::size_t{1} << 3 * (levels + 1) <= splats) ++levels;
  return levels;
}

std::vector<std::uint32_t> top_table(const Scene& scene, std::uint32_t levels) {
  const std::uint32_t shift = LATTICE_BITS - levels;
  std::vector<std::uint32_t> table(std::size_t{1} << 3 * levels);
  visit_cells(scene, [&](std::uint32_t word, const OctreeCell& cell) {
    const bool inner = word >> NODE_TAG_SHIFT == NODE_INNER;
    if (inner && cell.size > 1U << shift) return true;
    const std::uint32_t level = LATTICE_BITS - static_cast<std::uint32_t>(std::countr_zero(cell.size));
    const std::uint32_t entry = inner ? word : word | level << TOP_LEAF_SHIFT;
    const glm::uvec3 first = cell.low >> shift;
    const std::size_t edge = cell.size >> shift;
    for (std::size_t z = first.z; z < first.z + edge; ++z)
      for (std::size_t y = first.y; y < first.y + edge; ++y)
        std::fill_n(&table[(z << levels | y) << levels | first.x], edge, entry);
    return false;
  });
  return table;
}

}  // namespace splatray
