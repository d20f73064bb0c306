/// Points that are on no surface.
#pragma once
#include <cstdint>
#include <vector>

#include "preprocess/surface/cloud.h"
#include "preprocess/surface/survey.h"

namespace splatray {

/// Why a point is not drawn.
enum class Stray : std::uint8_t {
  no,
  isolated,  ///< far from its neighbours, or one of a few that are far from all others
  mixed      ///< between two surfaces that one beam met
};

/// Finds a scan's strays.
[[nodiscard]] std::vector<Stray> find_strays(const Cloud& cloud, const Survey& survey);

}  // namespace splatray
