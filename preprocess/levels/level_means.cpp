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

/// A record by its cell, and by the eighth of this that it lies in.
struct InCell {
  std::uint64_t cell;
  bool is_left_out;
  std::uint64_t part;
  std::uint32_t record;
  glm::uvec3 place;

  [[nodiscard]] bool is_with(const InCell& other) const {
    return cell == other.cell && is_left_out == other.is_left_out;
  }
  bool operator<(const InCell& other) const {
    return std::tie(cell, is_left_out, part, record) <
           std::tie(other.cell, other.is_left_out, other.part, other.record);
  }
};

using Some = std::span<const InCell>;

/// What the records of a cell show of a surface.
struct Cell {
  Some records;
  bool is_known = false;   ///< whether there are enough of them to show anything
  bool is_flat = false;    ///< they lie in a plane
  bool is_motley = false;  ///< their colours differ
};

/// Stored colours are encoded about as powers of light, whatever number stands for white (IEC 61966-2-1).
constexpr double ENCODING_POWER = 2.2;
/// A mean of unit normals that is shorter is none: the points are of surfaces that face different ways.
constexpr double LEAST_NORMAL = 0.5;

/// Points whose spread across their plane is less than this share of that along it lie on a surface, whose place their mean is. The mean
/// of leaves lies in the gaps between them: it would close these, and lose the shadows that they cast on each other.
constexpr double MOST_THICKNESS = 0.25;
/// Fewer points lie in a plane whatever they are of.
constexpr std::size_t FEWEST_SHOWN = 4;
/// Colours differ whose deviation, as stored, is more than this share of their mean.
constexpr double MOST_DEVIATION = 0.1;
/// Parts whose numbers are so far from each other have the same key.
constexpr std::uint32_t KEY_PARTS = 1U << 21U;

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
        means_schema_(schema.is_of_means ? schema : tile_means_schema(schema)),
        records_(records) {}

  [[nodiscard]] std::vector<InCell> by_cell(const LevelLattice& lattice, unsigned level) const {
    std::vector<InCell> list;
    for (std::uint32_t i = 0; i < records_.size() / schema_.record_bytes; ++i) {
      const glm::uvec3 place = lattice.place(tile_values(place_, at(i)));
      const std::uint64_t part = morton_key(LevelLattice::cell(place, level + 1) & (KEY_PARTS - 1));
      list.push_back({part >> 3U, is_left_out(at(i)), part & 7U, i, place});
    }
    std::sort(list.begin(), list.end());
    return list;
  }

  [[nodiscard]] Cell cell_of(Some records) const {
    const Sums sums = sums_of(records);
    return {records, records.size() >= FEWEST_SHOWN, is_thin(sums), differ(records, sums)};
  }

  /// Appends the mean of some records.
  void append(Some some, std::vector<unsigned char>& means) const {
    const Sums sums = sums_of(some);
    const glm::dvec3 mean = tile_values(place_, at(some.front().record)) + sums.offset / sums.count;
    const bool is_surface = some.size() < FEWEST_SHOWN || is_thin(sums);
    const unsigned char* const like = at(is_surface ? nearest(some, mean) : any_of(some));
    means.resize(means.size() + means_schema_.record_bytes);
    unsigned char* const record = means.data() + means.size() - means_schema_.record_bytes;
    std::copy_n(like, schema_.record_bytes, record);
    if (is_surface) store(place_, mean, record);
    store(colour_, mean_colour(sums), record);
    const double length = glm::length(sums.normal / sums.count);
    store(normal_, length < LEAST_NORMAL ? glm::dvec3(0.0) : sums.normal / (length * sums.count), record);
    if (intensity_ != nullptr) intensity_->store(sums.intensity / sums.count, record);
    if (class_ != nullptr) class_->store(most_frequent(sums.classes), record);
    means_schema_.count()->store(sums.count, record);
  }

 private:
  [[nodiscard]] const unsigned char* at(std::uint32_t i) const {
    return records_.data() + std::size_t{i} * schema_.record_bytes;
  }

  [[nodiscard]] bool is_left_out(const unsigned char* record) const {
    return (withheld_ != nullptr && withheld_->value(record) != 0.0) ||
           (class_ != nullptr && is_noise_class(class_->value(record)));
  }

  [[nodiscard]] Sums sums_of(Some some) const {
    const glm::dvec3 first = tile_values(place_, at(some.front().record));
    Sums sums;
    for (const InCell& one : some) {
      const unsigned char* const record = at(one.record);
      const double count = count_of(one);
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

  [[nodiscard]] std::uint32_t nearest(Some some, const glm::dvec3& mean) const {
    const auto squared = [&](const InCell& one) {
      const glm::dvec3 offset = tile_values(place_, at(one.record)) - mean;
      return glm::dot(offset, offset);
    };
    return std::min_element(some.begin(), some.end(),
                            [&](const InCell& a, const InCell& b) { return squared(a) < squared(b); })
        ->record;
  }

  /// Whether the spread across some records' plane is little of that along it.
  static bool is_thin(const Sums& sums) {
    const glm::dvec3 mean = sums.offset / sums.count;
    const glm::dmat3 m = sums.squares / sums.count - glm::outerProduct(mean, mean);
    const glm::dvec3 spread = variances_of({m[0][0], m[1][1], m[2][2], m[0][1], m[0][2], m[1][2]});
    return spread.x < MOST_THICKNESS * MOST_THICKNESS * spread.z;
  }

  /// Whether the colours of some records do.
  [[nodiscard]] bool differ(Some some, const Sums& sums) const {
    if (colour_[0] == nullptr) return false;
    const glm::dvec3 mean = mean_colour(sums);
    double squares = 0.0;
    for (const InCell& one : some) {
      const glm::dvec3 off = tile_values(colour_, at(one.record)) - mean;
      squares += count_of(one) * glm::dot(off, off);
    }
    return squares > MOST_DEVIATION * MOST_DEVIATION * sums.count * glm::dot(mean, mean);
  }

  /// As stored.
  static glm::dvec3 mean_colour(const Sums& sums) {
    return glm::pow(sums.light / sums.count, glm::dvec3(1.0 / ENCODING_POWER));
  }

  /// How many points a record is of.
  [[nodiscard]] double count_of(const InCell& one) const {
    return count_ == nullptr ? 1.0 : count_->value(at(one.record));
  }

  /// One by chance, each as often as it counts: the first of as many clocks that ring at random (exponential variates).
  [[nodiscard]] std::uint32_t any_of(Some some) const {
    const auto rings = [&](const InCell& one) {
      const double share = (static_cast<double>(chance_of(one.place) >> 11U) + 0.5) * 0x1p-53;
      return -std::log(share) / count_of(one);
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
  const TileField* const count_ = schema_.count();
};

/// Whether surfaces end, meet or change their colour in a cell, whose parts then have means of their own: it is not flat, or motley, and most
/// cells that it lies among are flat. Leaves lie among others that are not flat either.
bool is_divided(const std::vector<Cell>& cells, const Cell& cell) {
  if (!cell.is_known || (cell.is_flat && !cell.is_motley)) return false;
  const InCell& own = cell.records.front();
  const glm::ivec3 place(morton_point(own.cell));
  int known = 0, flat = 0;
  for (int i = 0; i < 27; ++i) {
    const glm::uvec3 near(place + glm::ivec3(i % 3, i / 3 % 3, i / 9) - 1);
    const auto key = std::tuple(morton_key(near & (KEY_PARTS / 2 - 1)), own.is_left_out);
    const auto of = [](const Cell& one) {
      return std::tuple(one.records.front().cell, one.records.front().is_left_out);
    };
    const auto found = std::lower_bound(cells.begin(), cells.end(), key,
                                        [&](const Cell& one, const auto& least) { return of(one) < least; });
    if (found == cells.end() || of(*found) != key || !found->is_known) continue;
    ++known;
    flat += found->is_flat ? 1 : 0;
  }
  return 2 * flat >= known;
}

}  // namespace

void append_means(std::span<const unsigned char> records, const TileSchema& schema,
                  const LevelLattice& lattice, unsigned level, std::vector<unsigned char>& means) {
  const Averager averager(records, schema);
  const std::vector<InCell> list = averager.by_cell(lattice, level);
  const auto next = [&](auto begin, auto last, const auto& is_with) {
    return std::find_if(begin, last, [&](const InCell& one) { return !is_with(one, *begin); });
  };
  std::vector<Cell> cells;
  for (auto begin = list.begin(); begin != list.end();) {
    const auto end = next(begin, list.end(), [](const InCell& a, const InCell& b) { return a.is_with(b); });
    cells.push_back(averager.cell_of({begin, end}));
    begin = end;
  }
  for (const Cell& cell : cells) {
    const bool divided = is_divided(cells, cell);
    for (auto begin = cell.records.begin(); begin != cell.records.end();) {
      const auto end = next(begin, cell.records.end(),
                            [&](const InCell& a, const InCell& b) { return !divided || a.part == b.part; });
      averager.append({begin, end}, means);
      begin = end;
    }
  }
}

}  // namespace splatray
