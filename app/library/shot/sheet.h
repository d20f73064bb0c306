/// A sheet of a scene: which rectangle of which plane it shows, in pixels that are exactly so large.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/library/attributes.h"
#include "app/library/cut/contours.h"
#include "app/library/request/request.h"
#include "engine/scene/scene.h"

namespace splatray {

struct Sheet {
  SheetRequest asked;
  /// Unit vectors of the paper in the world: to the right, to its top, out of it. A place p of the world lies on the paper at
  /// (p.right, p.top), p.toward above it.
  glm::dvec3 right{1.0, 0.0, 0.0}, top{0.0, 1.0, 0.0}, toward{0.0, 0.0, 1.0};
  /// What the paper's coordinates are counted from: the place (0, 0); of sections the line's beginning, else the world's origin.
  glm::dvec2 origin{0.0};
  /// The outer corner of the top left pixel, along right and top; a whole number of pixels from the origin.
  glm::dvec2 corner{0.0};
  double near = 0.0;  ///< along toward: the cut, or just before all that is there
  double far = 0.0;   ///< along toward: what is behind is not shown
  bool cuts = false;  ///< whether `near` is a cut
  double pixel_world = 1.0;
  std::uint32_t width = 1, height = 1;  ///< pixels
  double unit_metres = 1.0;             ///< length of a world unit
  bool unit_known = false;              ///< the file or the request says so
  bool north_up = false;                ///< right, top are the file's x, y: coordinates are the file's
  glm::dvec3 up{0.0, 0.0, 1.0};         ///< of the scene
  std::string crs;                      ///< Scene::crs
  std::vector<CutCurve> cut_curves;     ///< what is cut
  double disc_world = 0.0;              ///< radius of the discs that are shown, on the median
  /// Lines where what is seen behind the cut ends or turns, and where what is above a plan's cut does; along right and top. They are
  /// known when the sheet is traced (seen_lines.h).
  std::vector<CutCurve> beyond, overhead;
  std::vector<std::array<glm::dvec2, 2>> hatch;  ///< lines between the backs of these, along right and top
  double thickest_world = 0.0;                   ///< of a wall (HatchStyle::thickest)
  std::vector<Contour> contours;                 ///< along right and top
  std::vector<double> levels;     ///< heights of level marks, ascending, world units along `up`
  ColorLegend legend;             ///< of the colours shown; without a title, nothing is to be said of them
  std::optional<double> floor{};  ///< of an atlas' page: height of its floor along `up`, world units

  /// Orthographic, of the whole sheet.
  [[nodiscard]] Camera camera() const;
  /// What the sheet adds to the region.
  [[nodiscard]] std::vector<HalfSpace> planes() const;
  /// World length of a millimetre of paper.
  [[nodiscard]] double mm_world() const { return pixel_world / pixel_mm(); }
  /// Millimetres of paper that a pixel takes.
  [[nodiscard]] double pixel_mm() const { return 25.4 / asked.dpi; }
  /// A place of the world along right and top.
  [[nodiscard]] glm::dvec2 on_paper(const glm::dvec3& place) const {
    return {glm::dot(place, right), glm::dot(place, top)};
  }
  /// The pixel position, from the top left corner of the sheet, of a place along right and top.
  [[nodiscard]] glm::dvec2 pixel_of(const glm::dvec2& place) const {
    return (place - corner) / pixel_world * glm::dvec2(1.0, -1.0);
  }
  /// Where pixel position (x, y), from the top left corner of the sheet, lies in the paper's coordinates.
  [[nodiscard]] glm::dvec2 at(double x, double y) const {
    return corner - origin + glm::dvec2(x, -y) * pixel_world;
  }
};

/// Several sheets in one file, of one scale: views on a page, or an atlas, a page for each floor with the same rectangle of the ground.
struct SheetSet {
  std::vector<Sheet> sheets;  ///< in the order asked for, floors from the lowest
  bool is_atlas = false;
};

}  // namespace splatray
