#include "engine/scene/splat.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

namespace splatray {
namespace {

constexpr int OCT = static_cast<int>(OCT_SCALE);
constexpr std::uint32_t LATTICE_SIZE = 1U << LATTICE_BITS;

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
  if (field >= FIELD_LEANS) return glm::dmat3(0.0);
  const TangentFrame frame(normal);
  const double uv = decode_slope(field >> 10);
  return decode_slope(field) * glm::outerProduct(frame.u, frame.u) +
         uv * (glm::outerProduct(frame.u, frame.v) + glm::outerProduct(frame.v, frame.u)) +
         decode_slope(field >> 20) * glm::outerProduct(frame.v, frame.v);
}

std::uint32_t pack_lean(const glm::dvec3& lean, const glm::dvec3& normal) {
  const TangentFrame frame(normal);
  const auto encode = [&](const glm::dvec3& axis) {
    const double q = std::clamp(glm::dot(axis, lean), -1.0, 1.0) * LEAN_SCALE;
    return static_cast<std::uint32_t>(std::lround(q) + static_cast<long>(LEAN_SCALE));
  };
  return FIELD_LEANS | encode(frame.v) << 15 | encode(frame.u);
}

glm::dvec3 unpack_lean(std::uint32_t field, const glm::dvec3& normal) {
  if (field < FIELD_LEANS) return glm::dvec3(0.0);
  const TangentFrame frame(normal);
  const auto decode = [](std::uint32_t bits) { return double(bits & 0x7FFFU) / LEAN_SCALE - 1.0; };
  return decode(field) * frame.u + decode(field >> 15) * frame.v;
}

bool any_leans(std::span<const std::uint32_t> fields) {
  return std::any_of(fields.begin(), fields.end(), [](std::uint32_t field) { return field >= FIELD_LEANS; });
}

}  // namespace splatray
