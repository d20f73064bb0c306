/// The scale of E57's colours: as the file says it, unless the values speak against that.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "preprocess/points.h"
#include "preprocess/read/scan/stored_colors.h"

namespace splatray {

/// What is black and what is full colour, by channel.
struct ColorScale {
  std::array<double, 3> low{};
  std::array<double, 3> high{};
  bool is_stated = false;  ///< by the file; else 0 to 255 is a guess
  bool is_float = false;   ///< the values are stored as such
  bool is_judged = false;  ///< other values than those of 8 bits: these can be none but 0 to 255

  bool operator==(const ColorScale&) const = default;
};

/// Judges the scales of a file's scans, and brings colours to 8 bits anew where a scale does not fit its values. Scans of one
/// scale are judged together, since a dark room is no reason to take its photographs for others.
class ScanColors {
 public:
  /// Begins with a scan's colours, whose scale is to be judged; its first point is `first`.
  void begin(std::size_t first, const ColorScale& scale);
  /// A point's colour as stored; NaN has none.
  void add(const glm::dvec3& stored);
  /// The colours of all points so far, for points to be erased from.
  [[nodiscard]] std::vector<glm::vec3>& stored() { return stored_; }
  /// Replaces those of the points' colours whose scale does not fit, and says so. Where all are black, they are left to be
  /// judged with those of other files (`stored_color_most`).
  void finish(Points& points, std::vector<std::string>& notes);

 private:
  /// All scans of one scale.
  struct Group {
    ColorScale scale;
    ColorRange range;
    std::uint64_t count = 0;   ///< values above black
    std::uint64_t beyond = 0;  ///< values far above full
    std::uint64_t bright = 0;  ///< values that are more than black to the eye

    void add(const glm::dvec3& stored);
    [[nodiscard]] bool fits() const;
  };
  struct Scan {
    std::size_t first;
    std::size_t group;
  };

  void rescale(const Group& group, std::size_t first, std::size_t last, Points& points) const;

  std::vector<Group> groups_;
  std::vector<Scan> scans_;
  std::vector<glm::vec3> stored_;  ///< beside the points; NaN: none, or not to be judged
};

}  // namespace splatray
