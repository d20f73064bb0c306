/// The nearest places of every point of a cloud, looked for once.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "preprocess/surface/neighbours.h"

namespace splatray {

/// A search among a cloud's positions, and the first of what it finds for each point.
class NearPlaces {
 public:
  static constexpr std::size_t LISTED = 12;  ///< nearest places kept of each point

  /// The cloud must be in canonical order; the lists are still to be filled.
  explicit NearPlaces(const Cloud& cloud);

  [[nodiscard]] const NeighbourSearch& search() const { return search_; }

  /// LISTED of each point, the nearest first; the point itself where there are fewer.
  [[nodiscard]] std::span<const std::uint32_t> around(std::size_t point) const {
    return std::span(listed_[point / CHUNK]).subspan(point % CHUNK * LISTED, LISTED);
  }
  /// Takes a point's nearest places, the nearest first.
  void list(std::uint32_t point, std::span<const Neighbour> nearest);

  /// What search().find() gives for LISTED places of a point of the cloud; `nearest` holds them.
  [[nodiscard]] std::span<const Neighbour> find(const Cloud& cloud, std::uint32_t point,
                                                std::array<Neighbour, LISTED>& nearest) const;

  /// Leaves the points `kept` (ascending) of a cloud that has no others any more, whose numbers are then `number`; what is no
  /// more stands in lists as the point itself.
  void keep(const Cloud& cloud, const std::vector<std::uint32_t>& kept,
            const std::vector<std::uint32_t>& number);

 private:
  static constexpr std::size_t CHUNK = 1U << 15;  // points whose lists are in one array

  NeighbourSearch search_;
  /// In many small arrays, which find room where a large one does not.
  std::vector<std::vector<std::uint32_t>> listed_;
};

}  // namespace splatray
