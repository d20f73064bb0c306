/// A drawing to scale: from where, how large, how fine. What it comes to for a scene is in app/library/shot/sheet.h.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/library/request/paper.h"

namespace splatray {

enum class SheetKind {
  plan,       ///< from above, below a level cut where there is one
  section,    ///< cut along a line, looking to the line's left
  elevation,  ///< level, from one side
  ortho,      ///< along any direction
  atlas,      ///< a plan of each floor, a page each
};

/// The smallest scale and the most dots that --sheet takes.
inline constexpr double MOST_SHEET_SCALE = 1e7, MOST_SHEET_DPI = 2400.0;

struct SheetRequest {
  SheetKind kind = SheetKind::plan;
  /// A section has X0,Y0,X1,Y1, an elevation the degrees of where one stands, clockwise from north (the plan's top), an ortho
  /// the direction DX,DY,DZ that one looks in; in the file's coordinates.
  std::vector<double> place;
  std::optional<double> height;  ///< of a plan's cut, along the up axis, world units
  std::optional<double> above;   ///< of an atlas' cuts above their floors, world units; unset = 1.2 m
  /// How far behind the cut, or what is nearest, something is shown, world units; unset = all.
  std::optional<double> depth;
  double scale = 50.0;                ///< 1 : scale
  double dpi = 300.0;                 ///< pixels an inch of paper
  double weight_mm = 0.35;            ///< width of the lines of what is cut, on paper; 0 = none
  double hatch_mm = 1.5;              ///< between the lines that hatch what is cut, on paper; 0 = none
  std::optional<double> contours;     ///< of a plan: heights between contour lines, world units, > 0
  std::optional<double> level;        ///< height that is +0.00 in level marks, world units; unset: no marks
  std::optional<double> unit_metres;  ///< length of a world unit; unset = as the file says, else a metre
  std::string paper;  ///< of a page: a name of PAPER_SIZES; empty = the smallest that holds it
  PaperTurn turn = PaperTurn::chosen;
  /// Further views on the page, which have the scale, the styles, unit, level and paper of this one; of an atlas none.
  std::vector<SheetRequest> others{};

  /// Whether it is several sheets in one file.
  [[nodiscard]] bool is_set() const { return kind == SheetKind::atlas || !others.empty(); }
  bool operator==(const SheetRequest&) const = default;
};

/// Metres of the unit that a text names: m, cm, mm, ft, us-ft, or a number of metres above 0. Throws Expected.
[[nodiscard]] double read_unit(const std::string& text);

/// What --sheet takes: KIND[:VALUE,...], such as plan:z=1.2,depth=1.4,scale=50,dpi=300, and behind ; further views on the page. Throws
/// Expected.
[[nodiscard]] SheetRequest read_sheet(const std::string& text);
/// The text that read_sheet makes the same of.
[[nodiscard]] std::string sheet_text(const SheetRequest& sheet);

}  // namespace splatray
