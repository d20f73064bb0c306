/// The arrays of Points, a row each: what joins or thins points walks them, so that none is forgotten.
#pragma once
#include <tuple>
#include <variant>
#include <vector>

#include "preprocess/points.h"

namespace splatray {

/// One array beside the positions.
template <typename Value>
struct PointArray {
  std::vector<Value> Points::*values;
  Value absent;  ///< of points without it, where others have it
};

inline const std::tuple POINT_ARRAYS{PointArray<glm::dvec3>{&Points::position, {}},
                                     PointArray<glm::vec3>{&Points::normal, glm::vec3(0.0F)},
                                     PointArray<glm::vec3>{&Points::shading, glm::vec3(0.0F)},
                                     PointArray<glm::vec3>{&Points::color, glm::vec3(1.0F)},
                                     PointArray<float>{&Points::radius, 0.0F},
                                     PointArray<PointClip>{&Points::clip, {}},
                                     PointArray<PointEllipse>{&Points::ellipse, {}},
                                     PointArray<glm::u16vec3>{&Points::stored_color, glm::u16vec3(0xFFFF)},
                                     PointArray<std::uint16_t>{&Points::station, 0},
                                     PointArray<std::uint32_t>{&Points::grid_cell, NO_CELL},
                                     PointArray<std::uint32_t>{&Points::mean_of, 0},
                                     PointArray<std::uint32_t>{&Points::field_words, FIELD_FLAT},
                                     PointArray<std::uint32_t>{&Points::clip_words, CLIP_NONE}};

/// Calls visit(values) for each array and each column's values.
template <typename Visit>
void for_each_array(Points& points, const Visit& visit) {
  std::apply([&](const auto&... arrays) { (visit(points.*arrays.values), ...); }, POINT_ARRAYS);
  for (Column& column : points.columns) edit_values(column, visit);
}

/// Appends arrays and columns; what only one side has is filled with what is absent there. Stations and all else that is not of each
/// point stay as they are.
void append_points(Points& to, Points&& more);

}  // namespace splatray
