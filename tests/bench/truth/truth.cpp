#include "tests/bench/truth/truth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string>

#include "engine/base/error.h"
#include "engine/file/atomic_file.h"

namespace splatray::testing {
namespace {

constexpr std::array<char, 8> MAGIC{'S', 'P', 'L', 'T', 'R', 'U', 'T', 'H'};

struct Header {
  std::array<char, 8> magic;
  std::uint32_t width;
  std::uint32_t height;
  double jump_world;
};

/// A pixel as the file has it, without padding between pixels.
struct FilePixel {
  double values[4];
  char edge;
};
constexpr std::size_t PIXEL_BYTES = 4 * sizeof(double) + 1;

bool on_different_surfaces(const TruePixel& a, const TruePixel& b, double jump_world) {
  if (!a.hit() || !b.hit()) return a.hit() != b.hit();
  return std::abs(a.depth_world - b.depth_world) > jump_world;
}

/// Whether a pixel within one pixel of (x, y) shows another surface.
bool has_other_neighbour(const Truth& truth, std::uint32_t x, std::uint32_t y) {
  const TruePixel& pixel = truth.pixels[std::size_t{y} * truth.width + x];
  for (std::uint32_t row = y - std::min(y, 1U); row <= std::min(y + 1, truth.height - 1); ++row) {
    for (std::uint32_t column = x - std::min(x, 1U); column <= std::min(x + 1, truth.width - 1); ++column) {
      const TruePixel& other = truth.pixels[std::size_t{row} * truth.width + column];
      if (on_different_surfaces(pixel, other, truth.jump_world)) return true;
    }
  }
  return false;
}

}  // namespace

void mark_edges(Truth& truth, double jump_world) {
  truth.jump_world = jump_world;
  for (std::uint32_t y = 0; y < truth.height; ++y)
    for (std::uint32_t x = 0; x < truth.width; ++x)
      truth.pixels[std::size_t{y} * truth.width + x].edge = has_other_neighbour(truth, x, y);
}

void write_truth(const Truth& truth, const std::filesystem::path& path) {
  const Header header{MAGIC, truth.width, truth.height, truth.jump_world};
  std::string bytes(reinterpret_cast<const char*>(&header), sizeof(header));
  for (const TruePixel& pixel : truth.pixels) {
    const glm::dvec3& n = pixel.normal_world;
    const FilePixel out{{pixel.depth_world, n.x, n.y, n.z}, static_cast<char>(pixel.edge ? 1 : 0)};
    bytes.append(reinterpret_cast<const char*>(&out), PIXEL_BYTES);
  }
  write_text_file(bytes, path);
}

Truth read_truth(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height) {
  std::ifstream stream(path, std::ios::binary);
  Header header{};
  stream.read(reinterpret_cast<char*>(&header), sizeof(header));
  if (!stream || header.magic != MAGIC)
    throw Error(ExitCode::input_unreadable,
                path.string() + ": found no truth, expected bytes that begin with SPLTRUTH");
  const auto size = [](std::uint32_t columns, std::uint32_t rows) {
    return std::to_string(columns) + " x " + std::to_string(rows) + " pixels";
  };
  if (header.width != width || header.height != height)
    throw Error(ExitCode::input_unreadable, path.string() + ": found " + size(header.width, header.height) +
                                                ", expected " + size(width, height) +
                                                "; was it prepared with --quick, or measured so?");
  Truth truth{header.width, header.height, header.jump_world, {}};
  truth.pixels.resize(std::size_t{header.width} * header.height);
  for (TruePixel& pixel : truth.pixels) {
    FilePixel in{};
    stream.read(reinterpret_cast<char*>(&in), PIXEL_BYTES);
    pixel = {in.values[0], {in.values[1], in.values[2], in.values[3]}, in.edge != 0};
  }
  if (!stream)
    throw Error(ExitCode::input_unreadable, path.string() + ": found its end early, expected " +
                                                std::to_string(truth.pixels.size()) + " pixels");
  return truth;
}

}  // namespace splatray::testing
