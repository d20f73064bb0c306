/// Attributes of points that are kept beside them: intensity, class and the like.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/scene/pool/pool.h"

namespace splatray {

/// The names of attributes that readers of scans deliver, with what their values are.
inline constexpr std::string_view COLUMN_INTENSITY = "intensity";  ///< as stored, of any range
inline constexpr std::string_view COLUMN_CLASS = "class";          ///< ASPRS's codes (LAS 1.4 R15, table 17)
inline constexpr std::string_view COLUMN_RETURN = "return";        ///< of its pulse, 1 = first
inline constexpr std::string_view COLUMN_RETURNS = "returns";      ///< of its pulse
/// Point source id: by convention the flight line.
inline constexpr std::string_view COLUMN_SOURCE = "source";
inline constexpr std::string_view COLUMN_SCAN = "scan";  ///< the station's number, from 0
inline constexpr std::string_view COLUMN_TIME = "time";  ///< GPS time, seconds
/// What each point of a scan is part of (ScanKind); made by the build, and absent where all are of surfaces.
inline constexpr std::string_view COLUMN_KIND = "kind";
/// How far each point lies before (+) or behind (-) an earlier surface, world units; NaN = unknown. Made by add_change.
inline constexpr std::string_view COLUMN_CHANGE = "change";

/// What a point of a scan is part of, as its neighbourhood shows.
enum class ScanKind : std::uint8_t {
  surface,
  line,    ///< wires, poles: its neighbours spread in one direction
  scatter  ///< leaves, grass, clutter: they spread in three
};
inline constexpr std::size_t SCAN_KINDS = 3;

[[nodiscard]] constexpr std::string_view name_of(ScanKind kind) {
  return kind == ScanKind::surface ? "surface" : kind == ScanKind::line ? "line" : "scatter";
}

/// Most columns that a scene may have.
inline constexpr std::size_t COLUMNS_MOST = 32;

/// One attribute, a value for each point.
struct Column {
  std::string name;
  /// One of few types, so that a file takes no more bytes than the values need.
  using Values = std::variant<Pool<std::uint8_t>, Pool<std::uint16_t>, Pool<float>, Pool<double>>;
  Values values;

  [[nodiscard]] std::size_t size() const {
    return std::visit([](const auto& list) { return list.size(); }, values);
  }
  [[nodiscard]] double number(std::size_t i) const {
    return std::visit([i](const auto& list) { return static_cast<double>(list[i]); }, values);
  }
};

/// Calls change(values) with the values of a column as a vector that may be changed.
template <typename Change>
decltype(auto) edit_values(Column& column, const Change& change) {
  return std::visit([&change](auto& values) -> decltype(auto) { return change(values.edit()); },
                    column.values);
}

/// The column of this name; nullptr where there is none.
[[nodiscard]] inline const Column* find_column(const std::vector<Column>& columns, std::string_view name) {
  for (const Column& column : columns)
    if (column.name == name) return &column;
  return nullptr;
}

}  // namespace splatray
