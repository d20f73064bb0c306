#include "preprocess/levels/level_means.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "preprocess/base/morton.h"
#include "preprocess/levels/level_nodes.h"
#include "preprocess/scan/plane_fit.h"

namespace splatray {
namespace {

/// A record by its cell.
struct InCell {
  std::uint64_t cell;
  bool is_left_out;
  std::uint32_t record;
  glm::uvec3 place;

  [[nodiscard]] bool is_with(const InCell& other) const {
    return cell == other.cell && is_left_out == other.is_left_out;
  }
  bool operator<(const InCell& other) const {
    return std::tie(cell, is_left_out, record) < std::tie(other.cell, other.is_left_out, other.record);
  }
};

/// Stored colours are encoded about as powers of light, whatever number stands for white (IEC 61966-2-1).
constexpr double ENCODING_POWER = 2.2;
/// A mean of unit normals that is shorter is none: the points are of surfaces that face different ways.
constexpr double LEAST_NORMAL = 0.5;

/// Points whose spread across their plane is less than this share of that along it lie on a surface, whose place their mean is. The mean
/// of leaves lies in the gaps between them: it would close these, and lose the shadows that they cast on each other.
constexpr double MOST_THICKNESS = 0.25;

/// Sums over the records of a cell.
struct Sums {
  double count = 0.0, intensity = 0.0;
  glm::dvec3 offset{0.0};   ///< from the first record's position
  glm::dmat3 squares{0.0};  ///< outer products of these
  glm::dvec3 light{0.0}, normal{0.0};
  std::map<double, double> classes;
};

class Averager {
 public:
  Averager(std::span<const unsigned char> records, const TileSchema& schema)
      : schema_(schema),
        means_schema_(schema.find(TILE_COUNT) != nullptr ? schema : tile_means_schema(schema)),
        records_(records) {}

  [[nodiscard]] std::vector<InCell> by_cell(const LevelLattice& lattice, unsigned level) const {
    std::vector<InCell> list;
    constexpr std::uint32_t KEY_CELLS = (1U << 21U) - 1;
    for (std::uint32_t i = 0; i < records_.size() / schema_.record_bytes; ++i) {
      const glm::uvec3 place = lattice.place(tile_values(place_, at(i)));
      const glm::uvec3 cell = LevelLattice::cell(place, level) & KEY_CELLS;
      list.push_back({morton_key(cell), is_left_out(at(i)), i, place});
    }
    std::sort(list.begin(), list.end());
    return list;
  }

  /// Appends the mean of some records.
  void append(std::span<const InCell> some, std::vector<unsigned char>& means) const {
    const Sums sums = sums_of(some);
    const glm::dvec3 mean = tile_values(place_, at(some.front().record)) + sums.offset / sums.count;
    const bool is_surface = lie_in_plane(some, sums);
    const unsigned char* const like = at(is_surface ? nearest(some, mean) : any_of(some));
    means.resize(means.size() + means_schema_.record_bytes);
    unsigned char* const record = means.data() + means.size() - means_schema_.record_bytes;
    std::copy_n(like, schema_.record_bytes, record);
    if (is_surface) store(place_, mean, record);
    store(colour_, glm::pow(sums.light / sums.count, glm::dvec3(1.0 / ENCODING_POWER)), record);
    const double length = glm::length(sums.normal / sums.count);
    store(normal_, length < LEAST_NORMAL ? glm::dvec3(0.0) : sums.normal / (length * sums.count), record);
    if (intensity_ != nullptr) intensity_->store(sums.intensity / sums.count, record);
    if (class_ != nullptr) class_->store(most_frequent(sums.classes), record);
    means_schema_.find(TILE_COUNT)->store(sums.count, record);
  }

 private:
  [[nodiscard]] const unsigned char* at(std::uint32_t i) const {
    return records_.data() + std::size_t{i} * schema_.record_bytes;
  }

  [[nodiscard]] bool is_left_out(const unsigned char* record) const {
    return (withheld_ != nullptr && withheld_->value(record) != 0.0) ||
           (class_ != nullptr && is_noise_class(class_->value(record)));
  }

  [[nodiscard]] Sums sums_of(std::span<const InCell> some) const {
    const glm::dvec3 first = tile_values(place_, at(some.front().record));
    Sums sums;
    for (const InCell& one : some) {
      const unsigned char* const record = at(one.record);
      const double count = count_ == nullptr ? 1.0 : count_->value(record);
      sums.count += count;
      const glm::dvec3 offset = tile_values(place_, record) - first;
      sums.offset += count * offset;
      sums.squares += count * glm::outerProduct(offset, offset);
      if (colour_[0] != nullptr)
        sums.light += count * glm::pow(tile_values(colour_, record), glm::dvec3(ENCODING_POWER));
      if (normal_[0] != nullptr) sums.normal += count * tile_values(normal_, record);
      if (intensity_ != nullptr) sums.intensity += count * intensity_->value(record);
      if (class_ != nullptr) sums.classes[class_->value(record)] += count;
    }
    return sums;
  }

  [[nodiscard]] std::uint32_t nearest(std::span<const InCell> some, const glm::dvec3& mean) const {
    const auto squared = [&](const InCell& one) {
      const glm::dvec3 offset = tile_values(place_, at(one.record)) - mean;
      return glm::dot(offset, offset);
    };
    return std::min_element(some.begin(), some.end(),
                            [&](const InCell& a, const InCell& b) { return squared(a) < squared(b); })
        ->record;
  }

  /// Whether some records may lie on a surface: three always do.
  static bool lie_in_plane(std::span<const InCell> some, const Sums& sums) {
    const glm::dvec3 mean = sums.offset / sums.count;
    const glm::dmat3 m = sums.squares / sums.count - glm::outerProduct(mean, mean);
    const glm::dvec3 spread = variances_of({m[0][0], m[1][1], m[2][2], m[0][1], m[0][2], m[1][2]});
    return some.size() <= 3 || spread.x < MOST_THICKNESS * MOST_THICKNESS * spread.z;
  }

  /// One by chance, each as often as it counts: the first of as many clocks that ring at random (exponential variates).
  [[nodiscard]] std::uint32_t any_of(std::span<const InCell> some) const {
    const auto rings = [&](const InCell& one) {
      const double count = count_ == nullptr ? 1.0 : count_->value(at(one.record));
      const double share = (static_cast<double>(chance_of(one.place) >> 11U) + 0.5) * 0x1p-53;
      return -std::log(share) / count;
    };
    return std::min_element(some.begin(), some.end(),
                            [&](const InCell& a, const InCell& b) { return rings(a) < rings(b); })
        ->record;
  }

  static double most_frequent(const std::map<double, double>& classes) {
    return std::max_element(classes.begin(), classes.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
  }

  static void store(const TileFields& fields, const glm::dvec3& values, unsigned char* record) {
    for (int i = 0; i < 3 && fields[0] != nullptr; ++i)
      fields[static_cast<std::size_t>(i)]->store(values[i], record);
  }

  const TileSchema& schema_;
  const TileSchema means_schema_;
  std::span<const unsigned char> records_;
  const TileFields place_ = tile_fields(schema_, TILE_PLACE), colour_ = tile_fields(schema_, TILE_COLOUR),
                   normal_ = tile_fields(schema_, TILE_NORMAL);
  const TileField* const intensity_ = schema_.find(TILE_INTENSITY);
  const TileField* const class_ = schema_.find(TILE_CLASS);
  const TileField* const withheld_ = schema_.find(TILE_WITHHELD);
  const TileField* const count_ = schema_.find(TILE_COUNT);
};

}  // namespace

void append_means(std::span<const unsigned char> records, const TileSchema& schema,
                  const LevelLattice& lattice, unsigned level, std::vector<unsigned char>& means) {
  const Averager averager(records, schema);
  const std::vector<InCell> list = averager.by_cell(lattice, level);
  for (auto begin = list.begin(); begin != list.end();) {
    const auto end = std::find_if(begin, list.end(), [&](const InCell& one) { return !one.is_with(*begin); });
    averager.append({begin, end}, means);
    begin = end;
  }
}

}  // namespace splatray
