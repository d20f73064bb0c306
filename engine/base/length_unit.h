/// Units of length by name.
#pragma once
#include <array>
#include <cmath>

namespace splatray {

struct LengthUnit {
  const char* symbol;  ///< "m", as options take it and drawings have it
  const char* name;    ///< "metres"
  double metres;
};

inline constexpr std::array LENGTH_UNITS = {
    LengthUnit{"m", "metres", 1.0}, LengthUnit{"cm", "centimetres", 0.01},
    LengthUnit{"mm", "millimetres", 0.001}, LengthUnit{"ft", "feet", 0.3048},
    LengthUnit{"us-ft", "US survey feet", 1200.0 / 3937.0}};

/// The unit of that many metres, to less than what the two feet differ by; null for others.
[[nodiscard]] inline const LengthUnit* find_length_unit(double metres) {
  for (const LengthUnit& unit : LENGTH_UNITS)
    if (std::abs(metres - unit.metres) < 1e-7 * unit.metres) return &unit;
  return nullptr;
}

}  // namespace splatray
