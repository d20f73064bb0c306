/// The header of a PCD file (Point Cloud Library, "The PCD file format", version .7).
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "preprocess/read/bytes/byte_reader.h"

namespace splatray {

enum class PcdData { ascii, binary, binary_compressed };
enum class PcdType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

struct PcdField {
  std::string name;
  PcdType type = PcdType::float32;
  std::uint32_t size = 4;    ///< bytes of a value
  std::uint32_t count = 1;   ///< values of a point
  std::uint64_t offset = 0;  ///< bytes of a point's row before it
  std::uint64_t cell = 0;    ///< values of a point's row before it

  [[nodiscard]] std::uint64_t bytes() const { return std::uint64_t{size} * count; }
};

struct PcdHeader {
  std::vector<PcdField> fields;
  std::uint64_t row_bytes = 0;  ///< of a point; at most ByteReader::BLOCK_BYTES
  std::uint64_t row_cells = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 1;  ///< above 1: a grid of rows
  std::uint64_t points = 0;  ///< as declared: not to be trusted before it is checked against the file
  glm::dvec3 viewpoint{0.0};
  glm::dvec4 rotation{1.0, 0.0, 0.0, 0.0};  ///< w x y z
  bool is_viewpoint_left_out = false;  ///< the file's is no seven finite numbers with a rotation among them
  PcdData data = PcdData::ascii;
  std::uint64_t line_count = 0;  ///< of the header, DATA included

  /// The field of one value and this name, in any case; nullptr where there is none.
  [[nodiscard]] const PcdField* find(std::string_view name) const;
};

/// Reads the header, whose words may be in any case; `in` then stands on the first byte behind it. Lines may be missing: COUNT is 1, HEIGHT 1, VIEWPOINT
/// the origin, as it is where it makes no sense, and POINTS the cells of the grid. A single column is no grid: HEIGHT is 1 then. Throws Error (input_unreadable) with the line.
[[nodiscard]] PcdHeader read_pcd_header(ByteReader& in);

}  // namespace splatray
