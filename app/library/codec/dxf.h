/// Drawings as DXF of AutoCAD 2000 (AC1015; Autodesk's DXF Reference): what all CAD programs read.
#pragma once
#include <glm/glm.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace splatray {

struct DxfLayer {
  std::string name;
  int color = 7;      ///< AutoCAD's colour index, 7 = black on white
  double dash = 0.0;  ///< length of its lines' dashes, twice that of the gaps; 0 = they have none
};

/// A DXF in the making. Places and lengths are of the drawing's unit, z up. A text's letters beyond ASCII become \U+ escapes; those
/// that such an escape cannot name become question marks.
class DxfWriter {
 public:
  /// `unit_metres`: of a length of 1; named in the header ($INSUNITS) where DXF has a name for it. Entities lie on these layers.
  DxfWriter(double unit_metres, std::vector<DxfLayer> layers);

  /// At one height (LWPOLYLINE). Fewer than two points are nothing.
  void polyline(const std::string& layer, const std::vector<glm::dvec2>& points, bool closed,
                double height = 0.0);
  void line(const std::string& layer, const glm::dvec3& from, const glm::dvec3& to);
  void point(const std::string& layer, const glm::dvec3& at);
  /// `axis`: of any length; 0 = upwards.
  void circle(const std::string& layer, const glm::dvec3& center, double radius, const glm::dvec3& axis);
  void text(const std::string& layer, const glm::dvec3& at, double height, const std::string& letters);

  /// The whole file.
  [[nodiscard]] std::string str() const;

 private:
  void entity(const char* type, const std::string& layer, const char* subclass);
  void place(int code, const glm::dvec3& at);
  /// Keeps what the drawing reaches to.
  void include(const glm::dvec3& at);

  double unit_metres_;
  std::vector<DxfLayer> layers_;
  std::ostringstream entities_;
  unsigned handle_;
  std::optional<glm::dvec3> low_{}, high_{};
};

/// A world place in the coordinate system of an entity that has this axis (DXF Reference, arbitrary axis algorithm). `axis`: unit.
[[nodiscard]] glm::dvec3 in_object_system(const glm::dvec3& place, const glm::dvec3& axis);

}  // namespace splatray
