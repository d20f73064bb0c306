/// The public header block of LAS files (ASPRS, LAS Specification 1.4 R15, section 2.4, and its forerunners from 1.0 on).
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <string>

#include "preprocess/read/bytes/byte_reader.h"

namespace splatray {

/// What of the header matters to points, and what it says of the file. Its box is for people only, and its counts by return are
/// never used: they are often wrong.
struct LasHeader {
  unsigned version_minor = 0;  ///< of version 1
  std::uint64_t header_bytes = 0;
  std::uint64_t points_offset = 0;  ///< of the first point, from the file's begin; anything may lie before it
  std::uint32_t vlr_count = 0;      ///< variable length records that are said to follow the header
  std::uint64_t evlr_offset = 0;    ///< of the extended ones behind the points; 0 = none
  std::uint32_t evlr_count = 0;
  unsigned point_format = 0;   ///< 0 to 10
  bool is_compressed = false;  ///< by LASzip
  std::size_t record_bytes = 0;
  std::uint64_t point_count = 0;  ///< as the header says
  glm::dvec3 scale{1.0};          ///< position = scale * stored integer + offset
  glm::dvec3 offset{0.0};
  std::string system, software;  ///< that made the points, and the file
  unsigned year = 0, day = 0;    ///< of its making, and of that year from 1 on; 0 = unknown
  glm::dvec3 box_low{0.0}, box_high{0.0};

  /// Formats 6 to 10 have records of their own, with 8 bits for the class and flags apart.
  [[nodiscard]] bool is_extended() const { return point_format >= 6; }
};

/// Where fields lie in a record of a format, in bytes; 0 = the format has no such field.
struct LasFields {
  std::size_t bytes;  ///< of the format; extra bytes follow
  std::size_t time;
  std::size_t color;
  std::size_t infrared;
};

/// Where the fields of a record of point format 0 to 10 lie.
[[nodiscard]] LasFields las_fields(unsigned point_format);

/// Reads the header at the file's begin. Throws Error (input_unreadable) where it is none, of an unknown version or point
/// format, or says what cannot be: records shorter than their format, a scale of zero.
[[nodiscard]] LasHeader read_las_header(ByteReader& in);

}  // namespace splatray
