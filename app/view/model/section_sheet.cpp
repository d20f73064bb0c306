#include "app/view/model/section_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "app/view/model/region_edit.h"

namespace splatray {
namespace {

/// Cosine and sine of 45 degrees: what is nearer to one direction than to the one across it.
constexpr double NEARER = 0.5 * std::numbers::sqrt2;
/// Sine of the angle within which a face is level or upright: that of rounding.
constexpr double EXACT = 1e-6;

/// How far something reaches along a direction, world units.
struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

Range range_of(const TurnedBox& box, const glm::dvec3& up, const glm::dvec3& along) {
  Range range;
  for (const glm::dvec3& corner : corners_of(box, up)) {
    range.low = std::min(range.low, glm::dot(corner, along));
    range.high = std::max(range.high, glm::dot(corner, along));
  }
  return range;
}

/// The planes of the region that cut the scene; unit normals into what is kept.
std::vector<HalfSpace> cutting_faces(const Document& document) {
  std::vector<HalfSpace> faces = document.request.view.region.cuts;
  if (document.request.view.region.keep_box)
    for (const HalfSpace& face : half_spaces(*document.request.view.region.keep_box, up_of(document)))
      faces.push_back(face);
  for (HalfSpace& face : faces) face.normal = glm::normalize(face.normal);
  const TurnedBox all{document.bounds_min_world, document.bounds_max_world};
  std::erase_if(faces, [&](const HalfSpace& face) {
    const Range range = range_of(all, up_of(document), face.normal);
    const double place = glm::dot(face.point, face.normal);
    return !(range.low < place && place < range.high);
  });
  return faces;
}

/// The height of the lowest cut whose upper side is open.
std::optional<double> cut_height(const Document& document, const glm::dvec3& up) {
  std::optional<double> lowest;
  for (const HalfSpace& face : cutting_faces(document)) {
    const double height = glm::dot(face.point, up);
    if (glm::length(face.normal + up) < EXACT) lowest = std::min(lowest.value_or(height), height);
  }
  return lowest;
}

/// The upright cut that one who looks in a level direction sees best, of parallel ones the last.
std::optional<HalfSpace> seen_cut(const Document& document, const glm::dvec3& up, const glm::dvec3& level) {
  std::optional<HalfSpace> seen;
  const auto along = [&](const HalfSpace& face) { return glm::dot(face.normal, level); };
  for (const HalfSpace& face : cutting_faces(document)) {
    if (std::abs(glm::dot(face.normal, up)) > EXACT || along(face) < NEARER) continue;
    const double more = seen ? along(face) - along(*seen) : 1.0;
    if (more > EXACT || (more > -EXACT && glm::dot(face.point - seen->point, face.normal) > 0.0)) seen = face;
  }
  return seen;
}

/// The line in plan along which a cut is drawn: of all there is, or that a box keeps.
std::vector<double> line_along(const Document& document, const glm::dmat3& axes, const HalfSpace& cut) {
  const glm::dvec3 right = glm::cross(cut.normal, axes[1]);
  Range range = range_of(box_of_all(document), up_of(document), right);
  if (document.request.view.region.keep_box) {
    const Range kept = range_of(*document.request.view.region.keep_box, up_of(document), right);
    range = {std::max(range.low, kept.low), std::min(range.high, kept.high)};
  }
  std::vector<double> line;
  for (const double end : {range.low, range.high}) {
    const glm::dvec3 place = cut.point + (end - glm::dot(cut.point, right)) * right;
    line.push_back(glm::dot(place, axes[0]));
    line.push_back(-glm::dot(place, axes[2]));
  }
  return line;
}

/// Where one stands who looks in a level direction: the nearest side's degrees clockwise from north.
double nearest_side(const glm::dmat3& axes, const glm::dvec3& level) {
  const double quarters =
      std::atan2(-glm::dot(level, axes[0]), glm::dot(level, axes[2])) / (0.5 * std::numbers::pi);
  return 90.0 * std::fmod(std::round(quarters) + 4.0, 4.0);
}

/// Enough digits for the coordinates of a survey, in millimetres.
std::string digits(double value) {
  std::array<char, 40> text{};
  (void)std::snprintf(text.data(), text.size(), "%.10g", value);
  return text.data();
}

std::string place_text(const std::vector<double>& place, std::size_t first, std::size_t count) {
  std::string text;
  for (std::size_t i = first; i < first + count; ++i) text += (i > first ? ", " : "") + digits(place[i]);
  return text;
}

std::string side_text(double degrees) {
  constexpr std::array SIDES = {"north", "east", "south", "west"};
  const double quarter = degrees / 90.0;
  if (quarter == std::floor(quarter) && quarter >= 0.0 && quarter < 4.0)
    return std::string("the ") + SIDES[static_cast<std::size_t>(quarter)];
  return digits(degrees) + "\u00B0 clockwise from north";
}

}  // namespace

SheetRequest section_sheet(const Document& document, const SheetRequest& like) {
  const glm::dmat3 axes = upright_axes(up_of(document));
  const glm::dvec3 ahead = glm::normalize(document.camera.target - document.camera.eye);
  const double rise = glm::dot(ahead, axes[1]);
  const glm::dvec3 level = glm::normalize(ahead - rise * axes[1]);
  SheetRequest sheet = like;
  sheet.place.clear();
  sheet.height.reset();
  if (!(rise > -NEARER)) {
    sheet.kind = SheetKind::plan;
    sheet.height = cut_height(document, axes[1]);
  } else if (rise >= NEARER) {
    sheet.kind = SheetKind::ortho;
    sheet.place = {axes[1].x, axes[1].y, axes[1].z};
  } else if (const std::optional<HalfSpace> cut = seen_cut(document, axes[1], level)) {
    sheet.kind = SheetKind::section;
    sheet.place = line_along(document, axes, *cut);
  } else {
    sheet.kind = SheetKind::elevation;
    sheet.place = {nearest_side(axes, level)};
  }
  return sheet;
}

std::string sheet_sentence(const SheetRequest& sheet) {
  switch (sheet.kind) {
    case SheetKind::plan:
      return sheet.height ? "A plan, cut at the height " + digits(*sheet.height) + "."
                          : "A plan of all that is shown, from above.";
    case SheetKind::section:
      return "A section along the line from " + place_text(sheet.place, 0, 2) + " to " +
             place_text(sheet.place, 2, 2) + ", looking to its left.";
    case SheetKind::elevation:
      return "An elevation, seen from " + side_text(sheet.place.front()) + ".";
    case SheetKind::atlas:
      return "A plan of each floor.";
    case SheetKind::ortho:
      break;
  }
  return "What one sees who looks in the direction " + place_text(sheet.place, 0, 3) + ".";
}

}  // namespace splatray
