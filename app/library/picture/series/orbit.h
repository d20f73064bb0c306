/// An orbit of pictures in one page.
#pragma once
#include "app/library/picture/make_picture.h"
#include "app/library/picture/series/make.h"

namespace splatray {

/// The cameras of an orbit about `still`'s target, as far away: `columns` all around at each of `rows` heights, one: `still`'s own,
/// several: from ORBIT_LOWEST_DEG to ORBIT_HIGHEST_DEG above the horizon. Row by row from the lowest.
inline constexpr double ORBIT_LOWEST_DEG = 10.0, ORBIT_HIGHEST_DEG = 65.0;
[[nodiscard]] std::vector<Camera> orbit_cameras(const Camera& still, const glm::dvec3& up,
                                                std::uint32_t columns, std::uint32_t rows);

/// Makes the pictures of --orbit and writes the page (app/library/codec/orbit_page.h). Throws Error as make() does.
[[nodiscard]] SequenceRecord make_orbit(const Shot& shot, SceneOnDevice& shown,
                                        const SequenceListener& listener);

}  // namespace splatray
