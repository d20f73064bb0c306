#include "engine/scene/clip.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "engine/scene/octahedral.h"
#include "engine/scene/splat.h"

namespace splatray {
namespace {

constexpr double SLACK =
    1.5;  // lattice units that lines lie further out: centres and planes are rounded to such
constexpr std::uint32_t NONE = CLIP_NONE & 0xFFFFU;
constexpr int STEPS = static_cast<int>(CLIP_STEPS);
constexpr int HALF_TURN = 2 * STEPS;  // directions

/// The disc's plane as clip lines see it.
struct ClipFrame {
  explicit ClipFrame(const uvec4& words) {
    const int scale = OCT_SCALE;
    normal = octahedral_vector(static_cast<int>(words.z & 0xFFFFU) - scale,
                               static_cast<int>(words.z >> 16) - scale, scale);
    const glm::dvec3 size = glm::abs(normal);
    const glm::length_t least = size.x <= size.y && size.x <= size.z ? 0 : (size.y <= size.z ? 1 : 2);
    axis[least] = 1.0;
    side = glm::cross(axis, normal);
    const int exponent = 1 + static_cast<int>(words.w >> 25);
    step = std::ldexp(0.5 * scale, (exponent + 2) / 2);
  }

  [[nodiscard]] glm::dvec3 across(int direction) const {
    const double a = std::abs(128 - direction) - STEPS;
    const double b = std::abs(128 - (direction + 192) % 256) - STEPS;
    return a * side + b * static_cast<double>(OCT_SCALE) * axis;
  }

  glm::dvec3 normal;     ///< as stored
  glm::dvec3 axis{0.0};  ///< along which it is least
  glm::dvec3 side;       ///< axis cross normal
  double step;           ///< of a line's distance
};

/// The direction of a line whose `across` is nearest to a vector of the plane.
int nearest_direction(const ClipFrame& frame, const glm::dvec3& unit_normal, const glm::dvec3& dir) {
  const glm::dvec3 up = frame.axis - unit_normal * glm::dot(unit_normal, frame.axis);
  const double a = glm::dot(dir, frame.side) / glm::dot(frame.side, frame.side);
  const double b = glm::dot(dir, up) / glm::dot(up, up) / static_cast<double>(OCT_SCALE);
  const int turn = static_cast<int>(std::lround(STEPS * std::abs(b) / (std::abs(a) + std::abs(b))));
  if (a >= 0.0) return b >= 0.0 ? turn : (256 - turn) % 256;
  return b >= 0.0 ? 128 - turn : 128 + turn;
}

/// One line, rounded outwards; NONE where it cuts nothing off.
std::uint32_t pack_line(const uvec4& words, const ClipFrame& frame, const ClipEdge& edge) {
  const Splat splat = unpack_splat(words);
  const glm::dvec3 in_plane = edge.dir - splat.normal * glm::dot(splat.normal, edge.dir);
  const double length = glm::length(in_plane);
  if (!(length > 0.5)) return NONE;
  const glm::dvec3 dir = in_plane / length;
  const double distance = glm::dot(edge.place - splat.center, dir);
  const double radius = std::sqrt(splat.radius_squared);
  if (!(distance < radius)) return NONE;
  const int direction = nearest_direction(frame, splat.normal, dir);
  const glm::dvec3 across = frame.across(direction);
  const glm::dvec3 in_disc = across - splat.normal * glm::dot(splat.normal, across);
  const double half_chord = std::sqrt(std::max(splat.radius_squared - distance * distance, 0.0));
  const double limit = distance * glm::dot(across, dir) +
                       half_chord * std::abs(glm::dot(across, glm::cross(splat.normal, dir))) +
                       SLACK * glm::length(in_disc);
  const double q = std::ceil(std::max(limit, 0.0) / frame.step) + CLIP_ZERO;
  if (q >= 255.0 || (q - CLIP_ZERO) * frame.step >= radius * glm::length(in_disc)) return NONE;
  return static_cast<std::uint32_t>(q) << 8 | static_cast<std::uint32_t>(direction);
}

constexpr int LEAST_EXPONENT = -45;  // of an ellipse's factor
constexpr std::uint32_t MOST_CODE = 2 * CLIP_ZERO - 1;

/// Squared length of what of a line's `across` lies in the disc's plane.
double squared_in_plane(const glm::dvec3& across, const glm::dvec3& unit_normal) {
  const double out = glm::dot(across, unit_normal);
  return glm::dot(across, across) - out * out;
}

}  // namespace

std::array<ClipLine, 2> unpack_clip(std::uint32_t clip, const uvec4& words) {
  const ClipFrame frame(words);
  const auto line = [&](std::uint32_t bits) {
    const int q = static_cast<int>(bits >> 8 & 0xFFU) - static_cast<int>(CLIP_ZERO);
    return ClipLine{frame.across(static_cast<int>(bits & 0xFFU)), q * frame.step};
  };
  return {line(clip), line(is_ellipse(clip) ? NONE : clip >> 16)};
}

std::uint32_t pack_clip(const uvec4& words, std::span<const ClipEdge> edges) {
  assert(edges.size() <= 2);
  const ClipFrame frame(words);
  std::array<std::uint32_t, 2> lines{NONE, NONE};
  for (std::size_t i = 0; i < edges.size(); ++i) lines[i] = pack_line(words, frame, edges[i]);
  if (lines[0] == NONE) std::swap(lines[0], lines[1]);
  return lines[0] | lines[1] << 16;
}

Ellipse unpack_ellipse(std::uint32_t clip, const uvec4& words) {
  const std::uint32_t code = clip >> 23;
  const double factor = std::ldexp(8.0 + (code & 7U), static_cast<int>(code >> 3) + LEAST_EXPONENT);
  return {ClipFrame(words).across(static_cast<int>(clip >> 16 & 0x7FU)), factor};
}

ClipLine side_of(const Ellipse& ellipse, const Splat& splat) {
  constexpr double ROUNDING = 1.0 + 1e-12;
  const double squared = squared_in_plane(ellipse.across, splat.normal);
  const double limit = std::sqrt(splat.radius_squared * squared / (1.0 + ellipse.factor * squared));
  return {ellipse.across, limit * ROUNDING};
}

std::uint32_t pack_ellipse(const uvec4& words, const glm::dvec3& dir, double aspect, std::uint32_t clip) {
  assert(aspect >= 1.0);
  if (!(aspect >= LEAST_ASPECT)) return clip;
  const ClipFrame frame(words);
  const glm::dvec3 normal = unpack_splat(words).normal;
  const int direction = nearest_direction(frame, normal, dir) % HALF_TURN;
  const double factor = (aspect * aspect - 1.0) / squared_in_plane(frame.across(direction), normal);
  int exponent = 0;
  const auto mantissa = static_cast<std::uint32_t>(16.0 * std::frexp(factor, &exponent));  // 8 to 15
  exponent -= 4 + LEAST_EXPONENT;
  assert(exponent >= 0);  // across is at most 2^21 long
  const std::uint32_t code = static_cast<std::uint32_t>(exponent) << 3 | (mantissa & 7U);
  return std::min(code, MOST_CODE) << 23 | static_cast<std::uint32_t>(direction) << 16 | (clip & 0xFFFFU);
}

ClipContent clip_content(std::span<const std::uint32_t> clips) {
  ClipContent content;
  for (const std::uint32_t clip : clips) {
    content.ellipses = content.ellipses || is_ellipse(clip);
    content.lines = content.lines || cuts_off(clip);
  }
  return content;
}

}  // namespace splatray
