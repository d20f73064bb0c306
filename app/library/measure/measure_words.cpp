#include "app/library/measure/measure_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "engine/base/crs.h"
#include "engine/base/error.h"
#include "engine/base/length_unit.h"
#include "engine/base/number_text.h"

namespace splatray {
namespace {

constexpr double FINEST_METRES = 1e-4, FINEST_DEG = 1e-3;  ///< that are told apart without an interval
/// The least interval that is written, metres, square or cubic metres, and degrees: what the finest scanners tell apart. Across a point's error its
/// place follows from rounded numbers alone.
constexpr double LEAST_WITHIN = 1e-5, LEAST_WITHIN_DEG = 1e-4;

/// Without zeros behind the last digit that counts.
std::string trimmed_number(std::string text) {
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

/// Decimals of what has no interval: one digit of the finest.
int finest_decimals(MeasureUnit unit, double unit_metres) {
  const double finest = unit == MeasureUnit::degrees ? FINEST_DEG : FINEST_METRES / unit_metres;
  return static_cast<int>(std::ceil(-std::log10(finest) - 1e-9));
}

/// The interval that is written.
double written_within(double within, MeasureUnit unit, double unit_metres) {
  const double power = unit == MeasureUnit::volume ? 3.0 : (unit == MeasureUnit::area ? 2.0 : 1.0);
  return std::max(
      within, unit == MeasureUnit::degrees ? LEAST_WITHIN_DEG : LEAST_WITHIN / std::pow(unit_metres, power));
}

/// A cell of comma-separated values.
std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? std::string("\"\"") : std::string(1, c);
  return cell + "\"";
}

/// A cell between tabs.
std::string tab_cell(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\t' || c == '\n' || c == '\r'; }, ' ');
  return text;
}

std::array<std::string, 7> cells_of(const MeasureRow& row) {
  return {std::to_string(row.id), row.name,         row.kind,      row.quantity,
          row.words.value,        row.words.within, row.words.unit};
}
constexpr const char* HEADER = "id,name,kind,quantity,value,within_95,unit";

/// A point's coordinates, with the digits of its measure of kind point.
std::vector<ValueWords> place_words(const SurfacePoint& point, const MeasureFrame& frame) {
  std::vector<ValueWords> words;
  for (const MeasureValue& value : values_of({MeasureKind::point, {point}}, frame.up))
    words.push_back(value_words(value, unit_metres(frame)));
  return words;
}

}  // namespace

double unit_metres(const MeasureFrame& frame) {
  if (frame.unit_metres > 0.0) return frame.unit_metres;
  const double of_file = describe_crs(frame.crs).horizontal_metres;
  return of_file > 0.0 ? of_file : 1.0;
}

double require_unit_metres(const std::string& crs, std::optional<double> said_metres) {
  if (said_metres) return *said_metres;
  const Crs said = describe_crs(crs);
  if (said.is_degrees)
    throw Error(ExitCode::usage, "the file's coordinates are degrees (" + said.name +
                                     "), in which nothing is to scale; expected a projected system, or the "
                                     "unit by --unit, of a sheet unit=");
  if (const std::string different = different_units(said); !different.empty())
    throw Error(ExitCode::usage, different + ", in which nothing is to scale; expected --z-scale " +
                                     number_text(said.vertical_metres / said.horizontal_metres) +
                                     ", or the unit of all three by --unit, of a sheet unit=");
  return unit_metres({{}, crs});
}

std::string length_symbol(double unit_metres) {
  const LengthUnit* unit = find_length_unit(unit_metres);
  return unit != nullptr ? unit->symbol : "units";
}

std::string unit_symbol(MeasureUnit unit, double unit_metres) {
  if (unit == MeasureUnit::degrees) return "\u00B0";
  const char* power = unit == MeasureUnit::volume ? "\u00B3" : (unit == MeasureUnit::area ? "\u00B2" : "");
  return length_symbol(unit_metres) + power;
}

int decimals_of(double within) {
  constexpr int LEAST = -300, MOST = 15;
  const double power = std::floor(std::log10(within));
  int decimals = 1 - static_cast<int>(power);
  // What rounds up to the next power of ten has a digit fewer: 0.00996 is 0.010.
  if (std::round(within * std::pow(10.0, decimals)) >= 100.0) --decimals;
  return std::clamp(decimals, LEAST, MOST);
}

std::string rounded_text(double value, int decimals) {
  if (decimals < 0) value = std::round(value * std::pow(10.0, decimals)) * std::pow(10.0, -decimals);
  const int digits = std::max(decimals, 0);
  if (std::abs(value) < 0.5 * std::pow(10.0, -digits)) value = 0.0;
  std::array<char, 400> text{};
  (void)std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return text.data();
}

ValueWords value_words(const MeasureValue& value, double unit_metres) {
  const std::string unit = unit_symbol(value.unit, unit_metres);
  if (value.within > 0.0) {
    const double within = written_within(value.within, value.unit, unit_metres);
    const int decimals = decimals_of(within);
    return {rounded_text(value.value, decimals), rounded_text(within, decimals), unit};
  }
  if (value.beside > 0.0)
    return {rounded_text(value.value, decimals_of(written_within(value.beside, value.unit, unit_metres))), "",
            unit};
  return {trimmed_number(rounded_text(value.value, finest_decimals(value.unit, unit_metres))), "", unit};
}

std::string value_text(const MeasureValue& value, double unit_metres) {
  const ValueWords words = value_words(value, unit_metres);
  const std::string blank = value.unit == MeasureUnit::degrees ? "" : " ";
  return words.value + (words.within.empty() ? "" : " \u00B1" + words.within) + blank + words.unit;
}

std::string short_text(const Measure& measure, const MeasureFrame& frame) {
  const std::vector<MeasureValue> values = values_of(measure, frame.up);
  const double metres = unit_metres(frame);
  if (values.empty()) return {};
  if (measure.kind == MeasureKind::point) {
    std::string text;
    for (const MeasureValue& value : values)
      text += (text.empty() ? "" : ", ") + value_words(value, metres).value;
    return text + " " + length_symbol(metres);
  }
  if (measure.kind == MeasureKind::volume)
    return "cut " + value_text(values[0], metres) + ", fill " + value_text(values[1], metres);
  const std::string sign = measure.kind == MeasureKind::area ? "A " : (measure.fit ? "R " : "");
  return sign + value_text(values.front(), metres);
}

std::string labelled_text(const Measure& measure, const MeasureFrame& frame) {
  const std::string text = short_text(measure, frame);
  return measure.name.empty() ? text : measure.name + (text.empty() ? "" : ": ") + text;
}

std::vector<MeasureRow> measure_rows(std::span<const Measure> measures, const MeasureFrame& frame) {
  std::vector<MeasureRow> rows;
  for (std::size_t i = 0; i < measures.size(); ++i)
    for (const MeasureValue& value : values_of(measures[i], frame.up))
      rows.push_back({i + 1, measures[i].name, measure_name(measures[i].kind), value.name,
                      value_words(value, unit_metres(frame))});
  return rows;
}

std::string table_of(std::span<const Measure> measures, const MeasureFrame& frame) {
  std::string text = HEADER;
  std::replace(text.begin(), text.end(), ',', '\t');
  for (const MeasureRow& row : measure_rows(measures, frame)) {
    char before = '\n';
    for (const std::string& cell : cells_of(row)) text += std::exchange(before, '\t') + tab_cell(cell);
  }
  text += "\n\nid\tplace\tx\ty\tz\tunit\n";
  for (std::size_t i = 0; i < measures.size(); ++i)
    for (std::size_t j = 0; j < measures[i].points.size(); ++j) {
      text += std::to_string(i + 1) + "\t" + std::to_string(j + 1);
      for (const ValueWords& words : place_words(measures[i].points[j], frame)) text += "\t" + words.value;
      text += "\t" + length_symbol(unit_metres(frame)) + "\n";
    }
  return text;
}

std::string csv_text(std::span<const Measure> measures, const MeasureFrame& frame) {
  std::string text = HEADER;
  for (const MeasureRow& row : measure_rows(measures, frame)) {
    char before = '\n';
    for (const std::string& cell : cells_of(row)) text += std::exchange(before, ',') + csv_cell(cell);
  }
  return text + "\n";
}

}  // namespace splatray
