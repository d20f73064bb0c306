#include "preprocess/surface/near_places.h"

#include <algorithm>
#include <utility>

namespace splatray {

NearPlaces::NearPlaces(const Cloud& cloud) : search_(cloud, Sites::positions) {
  for (std::size_t begin = 0; begin < cloud.size(); begin += CHUNK)
    listed_.emplace_back(std::min(CHUNK, cloud.size() - begin) * LISTED);
}

void NearPlaces::list(std::uint32_t point, std::span<const Neighbour> nearest) {
  std::uint32_t* const listed = &listed_[point / CHUNK][point % CHUNK * LISTED];
  for (std::size_t j = 0; j < LISTED; ++j) listed[j] = j < nearest.size() ? nearest[j].index() : point;
}

std::span<const Neighbour> NearPlaces::find(const Cloud& cloud, std::uint32_t point,
                                            std::array<Neighbour, LISTED>& nearest) const {
  const std::span<const std::uint32_t> listed = around(point);
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
  if (search_.has_all())
    search_.keep(number);
  else
    search_ = NeighbourSearch(cloud, Sites::positions);
  std::vector<std::vector<std::uint32_t>> before = std::exchange(listed_, {});
  for (std::size_t begin = 0, freed = 0; begin < kept.size(); begin += CHUNK) {
    const std::size_t end = std::min(begin + CHUNK, kept.size());
    std::vector<std::uint32_t>& to = listed_.emplace_back((end - begin) * LISTED);
    tbb::parallel_for(begin, end, [&](std::size_t n) {
      const std::uint32_t* from = before[kept[n] / CHUNK].data() + kept[n] % CHUNK * LISTED;
      for (std::size_t j = 0; j < LISTED; ++j) {
        const std::uint32_t other = number[from[j]];
        to[(n - begin) * LISTED + j] = other == NO_CELL ? static_cast<std::uint32_t>(n) : other;
      }
    });
    for (; freed < kept[end - 1] / CHUNK; ++freed) before[freed] = {};
  }
}

}  // namespace splatray
