/// How measures are written: each number with as many digits as its interval has two significant ones of, and a unit.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/library/measure/measure.h"

namespace splatray {

/// What all measures of a file share.
struct MeasureFrame {
  glm::dvec3 up{0.0, 0.0, 1.0};
  std::string crs{};         ///< Scene::crs
  double unit_metres = 0.0;  ///< length of a world unit; 0 = as the system says, else a metre
};

/// Metres of a world unit.
[[nodiscard]] double unit_metres(const MeasureFrame& frame);
/// Metres of a world unit of a scene in that system (Scene::crs): as the user says, else as the system says, else 1. Throws where
/// the user says nothing and a world unit is no length, or another one along z than along x and y.
[[nodiscard]] double require_unit_metres(const std::string& crs, std::optional<double> said_metres);
/// "m", "ft" and so on; "units" for a length that has no name.
[[nodiscard]] std::string length_symbol(double unit_metres);
/// "m", "m²", "m³", "°".
[[nodiscard]] std::string unit_symbol(MeasureUnit unit, double unit_metres);

/// Decimals with which the half-width of an interval has two significant digits, -300 to 15; below 0 so many digits before the point
/// are zeros. `within` > 0.
[[nodiscard]] int decimals_of(double within);
/// The number rounded to so many decimals, never "-0".
[[nodiscard]] std::string rounded_text(double value, int decimals);

/// A value in words, without its unit. The least interval written is a hundredth of a millimetre or what corresponds to it. A value without an interval has the digits of the one it stands beside (MeasureValue::beside), else
/// of a tenth of a millimetre, the least that scanners tell apart, or a thousandth of a degree.
struct ValueWords {
  std::string value;
  std::string within;  ///< empty where it has no interval
  std::string unit;
};
[[nodiscard]] ValueWords value_words(const MeasureValue& value, double unit_metres);
/// "12.3457 ±0.0023 m".
[[nodiscard]] std::string value_text(const MeasureValue& value, double unit_metres);
/// What stands beside the marks in the picture: the value, with A before an area and R before a radius; a point's coordinates, a volume's cut and fill.
[[nodiscard]] std::string short_text(const Measure& measure, const MeasureFrame& frame);
/// The name before it, where the measure has one.
[[nodiscard]] std::string labelled_text(const Measure& measure, const MeasureFrame& frame);

/// A row of the table of measures: one for each value. Measures are numbered from 1.
struct MeasureRow {
  std::size_t id = 0;
  std::string name, kind;
  std::string quantity;  ///< MeasureValue::name
  ValueWords words;
};
[[nodiscard]] std::vector<MeasureRow> measure_rows(std::span<const Measure> measures,
                                                   const MeasureFrame& frame);
/// Two tables, of the values and of the places on the surface, each with a header and tabs between its columns.
[[nodiscard]] std::string table_of(std::span<const Measure> measures, const MeasureFrame& frame);
/// The table of the values, comma-separated (RFC 4180), UTF-8.
[[nodiscard]] std::string csv_text(std::span<const Measure> measures, const MeasureFrame& frame);

}  // namespace splatray
