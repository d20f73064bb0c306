#include "preprocess/surface/near_places.h"

#include <algorithm>

namespace splatray {

void NearPlaces::list(std::uint32_t point, std::span<const Neighbour> nearest) {
  List listed;
  for (std::size_t j = 0; j < LISTED; ++j) listed[j] = j < nearest.size() ? nearest[j].index() : point;
  lists_.set(point, listed);
}

std::span<const Neighbour> NearPlaces::find(const Cloud& cloud, std::uint32_t point,
                                            std::array<Neighbour, LISTED>& nearest) const {
  const List listed = around(point);
  const glm::vec3& place = cloud.coord[point];
  for (std::size_t j = 0; j < LISTED; ++j) {
    if (listed[j] == point) return std::span(nearest).first(search_.find(place, nearest));
    const glm::vec3 apart = cloud.coord[listed[j]] - place;
    nearest[j] = Neighbour(glm::dot(apart, apart), listed[j]);
  }
  return nearest;
}

void NearPlaces::keep(const Cloud& cloud, const std::vector<std::uint32_t>& kept,
                      const std::vector<std::uint32_t>& number) {
  if (search_.has_all()) {
    search_.keep(number);
  } else {
    search_ = NeighbourSearch(Cloud(), Sites::positions);  // frees that of before while the next is made
    search_ = NeighbourSearch(cloud, Sites::positions);
  }
  lists_.keep(kept, [&](std::uint32_t n, List list) {
    for (std::uint32_t& other : list) other = number[other] == NO_CELL ? n : number[other];
    return list;
  });
}

}  // namespace splatray
