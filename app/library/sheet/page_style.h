/// What all parts of a page look alike by, millimetres.
#pragma once

namespace splatray {

inline constexpr double TEXT_SIZE_MM = 2.8, LABEL_SIZE_MM = 2.2;   ///< of letters
inline constexpr double CELL_LINE_MM = 0.25, FINE_LINE_MM = 0.13;  ///< widths of lines
inline constexpr double SEEN_LINE_MM = 0.18;                       ///< of what is seen behind the cut
inline constexpr double DASH_MM = 2.0, DASH_GAP_MM = 1.0;          ///< of what is hidden

}  // namespace splatray
