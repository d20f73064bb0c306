/// What of a point's surroundings smoothing looks at.
#pragma once
#include <algorithm>
#include <functional>
#include <span>

#include "preprocess/base/select.h"
#include "preprocess/scan/survey.h"

namespace splatray {

/// The places within 2.5 times the distance to the 8th place, the point's own or the median of all, whichever is more, or, where that
/// is less, within what about 64 are expected in.
class Surroundings {
 public:
  static constexpr std::size_t MOST = 96;  ///< places that are looked at
  static constexpr float ENOUGH = 64.0F;   ///< of them, that are looked for

  explicit Surroundings(const Survey& survey) : survey_(survey) {
    std::vector<float> ranked = survey.reach;
    usual_ = ranked.empty() ? 0.0F : median_of(std::span(ranked));
  }

  [[nodiscard]] NeighbourSearch::Query query(const Cloud& cloud, std::uint32_t i) const {
    constexpr float REACHES = 2.5F;  // of the distance to the 8th place: about 4 spacings
    const float limit = REACHES * std::max(survey_.reach[i], usual_);
    const float squared = std::min(limit * limit, survey_.expected_squared(i, ENOUGH));
    return {cloud.coord[i], squared, squared};
  }

 private:
  const Survey& survey_;
  float usual_;
};

}  // namespace splatray
