/// What a picture should show: for every pixel the first point its centre ray truly meets.
#pragma once
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

namespace splatray::testing {

/// What the ray through a pixel's centre truly meets first.
struct TruePixel {
  /// Along the ray from the eye; +inf = a miss.
  double depth_world = std::numeric_limits<double>::infinity();
  glm::dvec3 normal_world{0.0};  ///< unit, turned against the ray; 0 on a miss
  bool edge = false;             ///< on a silhouette: within one pixel of a miss or of a depth jump

  [[nodiscard]] bool hit() const { return depth_world < std::numeric_limits<double>::infinity(); }
};

/// A picture of true pixels.
struct Truth {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  double jump_world = 0.0;  ///< neighbours whose depths differ by more than this lie on different surfaces
  std::vector<TruePixel> pixels;  ///< top row first
};

/// Sets `jump_world`, and `edge` of every pixel one of whose eight neighbours answers hit or miss differently or differs by
/// more than `jump_world` in depth; of such neighbours both pixels are edges.
void mark_edges(Truth& truth, double jump_world);

/// Writes the truth as a plain binary file in this machine's byte order: bytes "SPLTRUTH", uint32 width and height, float64
/// jump_world, then for each pixel float64 depth and normal[3] and a byte edge. Throws Error (failed); leaves no partial file.
void write_truth(const Truth& truth, const std::filesystem::path& path);
/// Reads that of a picture of this size back. Throws Error (input_unreadable) when it is of another size, not that long, or
/// begins otherwise.
[[nodiscard]] Truth read_truth(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height);

}  // namespace splatray::testing
