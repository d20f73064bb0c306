/// Coordinate reference systems as files name them: well-known text (OGC 01-009, ISO 19162), or EPSG's numbers.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace splatray {

/// What the text of a system says; what it does not say is empty, 0 or false.
struct Crs {
  std::string name;
  unsigned epsg = 0;           ///< of the system as a whole, or of x and y alone
  unsigned vertical_epsg = 0;  ///< of heights beside it
  bool is_degrees = false;
  bool is_projected = false;
  double horizontal_metres = 0.0;  ///< of a unit of x and y where they are lengths
  double vertical_metres = 0.0;    ///< of a unit of z
};

/// The text of a system that a file names by EPSG's numbers alone: "EPSG:25832", "EPSG:25832+7837" with one of heights; behind
/// it, where the file says so, ";deg" or ";xy=0.3048" and ";z=1", metres of a unit. `vertical` and what `units` lacks are 0.
[[nodiscard]] std::string epsg_text(unsigned horizontal, unsigned vertical, const Crs& units);

/// Reads either kind of text. What is neither has no name.
[[nodiscard]] Crs describe_crs(std::string_view text);

/// The system of x and y alone, for heights that are no longer in its unit. A text that is of neither kind stays.
[[nodiscard]] std::string horizontal_crs(const std::string& text);

/// "z is in feet while x and y are in metres"; empty where the units of length are one or not said. Of the two feet, which differ
/// by 2e-6, no account is taken.
[[nodiscard]] std::string different_units(const Crs& crs);

/// Whether two texts mean one system, as far as they say: they are equal, or their numbers or names are.
[[nodiscard]] bool is_same_crs(std::string_view a, std::string_view b);

/// Metres of a unit of length by EPSG's number; 0 = another.
[[nodiscard]] double epsg_unit_metres(unsigned code);
/// Metres of a unit of a projected or vertical system by EPSG's number, where that unit is a foot, the international or the United
/// States'; 0 = of another, or no such system.
[[nodiscard]] double epsg_system_metres(unsigned code);
/// EPSG's number of the unit of that many metres; 0 = another.
[[nodiscard]] std::uint16_t epsg_unit(double metres);

}  // namespace splatray
