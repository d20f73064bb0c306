#include "preprocess/read/ply/ply_gaussians.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

#include "preprocess/read/scan/gaussian_surface.h"

namespace splatray {
namespace {

/// Factor of the colour in front of spherical harmonics of degree 0.
constexpr double HARMONIC_0 = 0.28209479177387814;
constexpr std::string_view CHUNK_ELEMENT = "chunk";
constexpr std::uint64_t ROWS_OF_A_CHUNK = 256;

/// The columns of some properties in rows that are read whole.
template <std::size_t COUNT>
using Places = std::array<std::size_t, COUNT>;

constexpr std::array<std::string_view, 13> PLAIN{"x",      "y",      "z",     "scale_0", "scale_1",
                                                 "rot_0",  "rot_1",  "rot_2", "rot_3",   "opacity",
                                                 "f_dc_0", "f_dc_1", "f_dc_2"};
constexpr std::string_view THICKNESS = "scale_2";  // 2D Gaussians have none
constexpr std::array<std::string_view, 4> PACKED{"packed_position", "packed_rotation", "packed_scale",
                                                 "packed_color"};
constexpr std::array<std::string_view, 12> CHUNK{"min_x",       "min_y",       "min_z",       "max_x",
                                                 "max_y",       "max_z",       "min_scale_x", "min_scale_y",
                                                 "min_scale_z", "max_scale_x", "max_scale_y", "max_scale_z"};
constexpr std::array<std::string_view, 6> CHUNK_COLORS{"min_r", "min_g", "min_b", "max_r", "max_g", "max_b"};

bool has(const PlyElement& element, std::string_view name) { return element.find(std::string(name)) >= 0; }

bool is_packed(const PlyElement& element) { return has(element, PACKED[0]); }

template <std::size_t COUNT>
Places<COUNT> places_of(const PlyBody& in, const PlyElement& element,
                        const std::array<std::string_view, COUNT>& names) {
  Places<COUNT> places{};
  for (std::size_t i = 0; i < COUNT; ++i) {
    const int at = element.find(std::string(names[i]));
    if (at < 0 || element.properties[static_cast<std::size_t>(at)].is_list)
      in.fail("found a capture of 3D Gaussians whose element '" + element.name + "' has no property '" +
              std::string(names[i]) + "', expected one, of numbers");
    places[i] = static_cast<std::size_t>(at);
  }
  return places;
}

/// Calls take(row) for each row that there is, with the values of all its properties; those of lists are 0. How many there are.
template <class Take>
std::uint64_t read_values(PlyBody& in, const PlyElement& element, const Take& take) {
  std::vector<double> row(element.properties.size());
  bool filled = false;  // what was read last is taken once it is known that the file did not end within it
  const std::uint64_t count = in.read_rows(element, [&] {
    if (filled) take(row);
    for (std::size_t i = 0; i < row.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (property.is_list)
        in.skip(property);
      else
        row[i] = in.number(property.type);
    }
    filled = true;
  });
  if (count == element.count && filled) take(row);
  return count;
}

template <std::size_t COUNT>
glm::dvec3 triple(const std::vector<double>& row, const Places<COUNT>& places, std::size_t first) {
  return {row[places[first]], row[places[first + 1]], row[places[first + 2]]};
}

glm::dvec3 exp_of(const glm::dvec3& v) { return {std::exp(v.x), std::exp(v.y), std::exp(v.z)}; }

/// As training stores it: logarithms of deviations, the logit of opacity, a quaternion with w first, harmonics. `thickness`: the column
/// of the third deviation, none of flat ones.
Gaussian plain_gaussian(const std::vector<double>& row, const Places<13>& at,
                        std::optional<std::size_t> thickness) {
  const double third = thickness ? std::exp(row[*thickness]) : 0.0;
  return {triple(row, at, 0),
          {std::exp(row[at[3]]), std::exp(row[at[4]]), third},
          glm::dquat(row[at[5]], row[at[6]], row[at[7]], row[at[8]]),
          1.0 / (1.0 + std::exp(-row[at[9]])),
          0.5 + HARMONIC_0 * triple(row, at, 10)};
}

/// A field of `bits` from bit `low` on, 0..1.
double part_of(std::uint32_t word, int low, int bits) {
  const std::uint32_t most = (1U << bits) - 1U;
  return static_cast<double>(word >> low & most) / static_cast<double>(most);
}

glm::dvec3 unpack_11_10_11(std::uint32_t word) {
  return {part_of(word, 21, 11), part_of(word, 11, 10), part_of(word, 0, 11)};
}

/// The three lesser components of a unit quaternion w, x, y, z in their order, each of -1/sqrt(2) to 1/sqrt(2), below the number of the
/// greatest, which is above 0.
glm::dquat unpack_quaternion(std::uint32_t word) {
  const std::uint32_t greatest = word >> 30;
  std::array<double, 4> values{};
  double left = 1.0;
  int low = 20;
  for (std::uint32_t i = 0; i < 4; ++i) {
    if (i == greatest) continue;
    values[i] = (part_of(word, low, 10) - 0.5) * std::sqrt(2.0);
    left -= values[i] * values[i];
    low -= 10;
  }
  values[greatest] = std::sqrt(std::max(left, 0.0));
  return {values[0], values[1], values[2], values[3]};
}

GaussianChunk chunk_of(const std::vector<double>& row, const Places<12>& at, const Places<6>* colors) {
  GaussianChunk chunk{triple(row, at, 0), triple(row, at, 3), triple(row, at, 6), triple(row, at, 9)};
  if (colors != nullptr)
    chunk.least_color = triple(row, *colors, 0), chunk.most_color = triple(row, *colors, 3);
  return chunk;
}

std::uint64_t read_chunks(PlyBody& in, const PlyElement& element, std::vector<GaussianChunk>& chunks) {
  const Places<12> at = places_of(in, element, CHUNK);
  const bool colored = has(element, CHUNK_COLORS[0]);
  const Places<6> colors = colored ? places_of(in, element, CHUNK_COLORS) : Places<6>{};
  chunks.reserve(in.most_rows(element));
  return read_values(in, element, [&](const std::vector<double>& row) {
    chunks.push_back(chunk_of(row, at, colored ? &colors : nullptr));
  });
}

Gaussian packed_gaussian(const std::vector<double>& row, const Places<4>& at, const GaussianChunk& chunk) {
  const auto word = [&](std::size_t i) { return static_cast<std::uint32_t>(row[at[i]]); };
  const std::uint32_t color = word(3);
  const glm::dvec3 shown{part_of(color, 24, 8), part_of(color, 16, 8), part_of(color, 8, 8)};
  return {glm::mix(chunk.least_place, chunk.most_place, unpack_11_10_11(word(0))),
          exp_of(glm::mix(chunk.least_scale, chunk.most_scale, unpack_11_10_11(word(2)))),
          unpack_quaternion(word(1)), part_of(color, 0, 8),
          glm::mix(chunk.least_color, chunk.most_color, shown)};
}

std::uint64_t read_packed(PlyBody& in, const PlyElement& element, const std::vector<GaussianChunk>& chunks,
                          GaussianSurface& surface) {
  const Places<4> at = places_of(in, element, PACKED);
  for (const std::size_t property : at)
    if (element.properties[property].type != PlyType::uint32)
      in.fail("property '" + element.properties[property].name +
              "' of a capture of 3D Gaussians is not of type uint");
  const std::uint64_t wanted = (element.count + ROWS_OF_A_CHUNK - 1) / ROWS_OF_A_CHUNK;
  if (chunks.size() < wanted)
    in.fail("found " + std::to_string(chunks.size()) + " chunks before " + std::to_string(element.count) +
            " packed Gaussians, expected " + std::to_string(wanted));
  std::uint64_t row_number = 0;
  return read_values(in, element, [&](const std::vector<double>& row) {
    surface.add(packed_gaussian(row, at, chunks[row_number++ / ROWS_OF_A_CHUNK]));
  });
}

std::uint64_t read_plain(PlyBody& in, const PlyElement& element, GaussianSurface& surface) {
  const Places<13> at = places_of(in, element, PLAIN);
  std::optional<std::size_t> thickness;
  if (has(element, THICKNESS)) thickness = places_of(in, element, std::array{THICKNESS})[0];
  return read_values(
      in, element, [&](const std::vector<double>& row) { surface.add(plain_gaussian(row, at, thickness)); });
}

}  // namespace

bool PlyGaussians::takes(const PlyElement& element) {
  return element.name == CHUNK_ELEMENT || element.name == "vertex";
}

bool PlyGaussians::are_in(const PlyElement& element) {
  return has(element, "f_dc_0") || has(element, "rot_0") || is_packed(element);
}

std::uint64_t PlyGaussians::read(PlyBody& in, const PlyElement& element) {
  if (element.name == CHUNK_ELEMENT) return read_chunks(in, element, chunks_);
  surface_.reserve(in.most_rows(element));
  return is_packed(element) ? read_packed(in, element, chunks_, surface_) : read_plain(in, element, surface_);
}

Points PlyGaussians::take(const PlyBody& in, const Progress& progress, std::string& note) {
  Points points = surface_.take({"surface of Gaussians", progress});
  note = surface_.note();
  if (points.size() == 0) throw_unreadable(in.path(), note + "; expected at least one point");
  return points;
}

}  // namespace splatray
