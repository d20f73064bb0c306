/// Units of length by name.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "engine/base/number_text.h"

namespace splatray {

struct LengthUnit {
  const char* symbol;  ///< "m", as options take it and drawings have it
  const char* name;    ///< "metres"
  double metres;
  std::uint16_t epsg;  ///< EPSG's number; 0 = files do not name it so
};

inline constexpr std::array LENGTH_UNITS = {
    LengthUnit{"m", "metres", 1.0, 9001}, LengthUnit{"cm", "centimetres", 0.01, 0},
    LengthUnit{"mm", "millimetres", 0.001, 0}, LengthUnit{"ft", "feet", 0.3048, 9002},
    LengthUnit{"us-ft", "US survey feet", 1200.0 / 3937.0, 9003}};

/// The unit of that many metres, to less than what the two feet differ by; null for others.
[[nodiscard]] inline const LengthUnit* find_length_unit(double metres) {
  for (const LengthUnit& unit : LENGTH_UNITS)
    if (std::abs(metres - unit.metres) < 1e-7 * unit.metres) return &unit;
  return nullptr;
}

/// Whether two lengths of a unit are one unit's: they differ by less than a part in 100 000, as the two feet do, by 2e-6.
[[nodiscard]] inline bool is_same_unit(double metres, double other_metres) {
  return std::abs(metres / other_metres - 1.0) < 1e-5;
}

/// "feet", or "units of 0.2 m" of one without a name.
[[nodiscard]] inline std::string length_name(double metres) {
  const LengthUnit* unit = find_length_unit(metres);
  return unit != nullptr ? unit->name : "units of " + number_text(metres) + " m";
}

}  // namespace splatray
