/// What an E57 file's XML section says of its scans (ASTM E2807-11, section 8).
#pragma once
#include <array>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/read/e57/paged_file.h"

namespace splatray {

/// One field of a record. An integer's value is (bits + minimum) * scale + offset, where a plain integer has scale 1.
struct E57Field {
  enum class Kind : std::uint8_t { float32, float64, integer, text };
  /// Without the prefix of the standard's namespace; with "nor:" before those of the normals extension, whatever its prefix
  /// is in the file.
  std::string name;
  Kind kind = Kind::float64;
  std::int64_t minimum = 0;  ///< of integers
  unsigned bits = 64;        ///< of a value; 0 = all are the minimum; not of text
  double scale = 1.0;
  double offset = 0.0;
  std::optional<double> largest;  ///< a value's, where the file says it
  std::string defect;             ///< why its values cannot be decoded; empty = they can
};

/// One channel of colour: the values that are black and full.
struct E57Limits {
  std::optional<double> minimum;
  std::optional<double> maximum;
};

/// One scan: a child of data3D.
struct E57Scan {
  std::string name;  ///< UTF-8 without blanks around it; may be empty
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
  glm::dvec3 translation{0.0};
  bool is_shifted_alone = false;  ///< another scan of the file has another translation
  std::vector<E57Field> fields;   ///< in the order of their streams
  std::uint64_t physical_offset = 0;
  std::uint64_t records = 0;
  std::array<E57Limits, 3> color_limits;
  std::uint64_t row_maximum = 0;  ///< of indexBounds; 0 = not given
  std::uint64_t column_maximum = 0;
};

/// What the section says of the whole file.
struct E57Description {
  std::vector<E57Scan> scans;
  std::string crs;      ///< coordinateMetadata: the coordinate system as text; may be empty
  std::string library;  ///< that wrote the file; may be empty
};

/// Most scans of a file: Points numbers stations with 16 bits.
inline constexpr std::size_t E57_MOST_SCANS = 65535;

/// Reads the XML section as a stream; what is no scan (images, descriptions) is not kept. Throws Error (input_unreadable) for
/// XML that is not well-formed, nests more than 64 deep or has a document type (so no entities), and for numbers and types
/// that are none.
[[nodiscard]] E57Description read_e57_description(PagedFile& file);

}  // namespace splatray
