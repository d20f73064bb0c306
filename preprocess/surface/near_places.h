/// The nearest places of every point of a cloud, looked for once.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "preprocess/surface/neighbours.h"
#include "preprocess/surface/number_lists.h"

namespace splatray {

/// A search among a cloud's positions, and the first of what it finds for each point.
class NearPlaces {
 public:
  static constexpr std::size_t LISTED = 12;  ///< nearest places kept of each point
  using List = NumberLists<LISTED>::List;

  /// The cloud must be in canonical order; the lists are still to be filled.
  explicit NearPlaces(const Cloud& cloud) : search_(cloud, Sites::positions), lists_(cloud.size()) {}

  [[nodiscard]] const NeighbourSearch& search() const { return search_; }

  /// LISTED of each point, the nearest first; the point itself where there are fewer.
  [[nodiscard]] List around(std::size_t point) const { return lists_[point]; }
  /// The k-th of them.
  [[nodiscard]] std::uint32_t around(std::size_t point, std::size_t k) const { return lists_.at(point, k); }
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
  NeighbourSearch search_;
  NumberLists<LISTED> lists_;
};

}  // namespace splatray
