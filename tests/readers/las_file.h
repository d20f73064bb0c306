/// LAS files as tests make them, without any library.
#pragma once
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "tests/readers/read_error.h"

namespace splatray {

/// One point as a record has it.
struct LasRecord {
  std::array<std::int32_t, 3> position{};
  std::uint16_t intensity = 0;
  unsigned return_number = 1;
  unsigned returns = 1;
  unsigned classification = 0;
  bool is_withheld = false;
  bool is_synthetic = false;
  std::uint16_t source = 0;
  double time = 0.0;
  std::array<std::uint16_t, 3> color{};
  std::string extra;  ///< bytes behind the format's own
};

/// What a file is made of; every field may say what is not so.
struct LasFile {
  unsigned version_minor = 2;
  unsigned format = 3;
  std::vector<LasRecord> records;
  std::size_t extra_bytes = 0;  ///< of each record
  std::array<double, 3> scale{0.001, 0.001, 0.001};
  std::array<double, 3> offset{};
  std::vector<std::string> vlrs;
  std::string padding;               ///< between the last of them and the points
  std::string behind;                ///< bytes after the points
  std::int64_t claimed_points = -1;  ///< else as many as there are
  std::int64_t claimed_vlrs = -1;
  std::int64_t claimed_legacy = -1;  ///< the older count of LAS 1.4
  double box = 0.0;                  ///< of the header, all six numbers

  [[nodiscard]] std::string bytes() const;

 private:
  [[nodiscard]] std::string record(const LasRecord& point) const;
};

/// A variable length record.
inline std::string las_vlr(const std::string& user, std::uint16_t id, const std::string& content) {
  std::string padded = user;
  padded.resize(16, '\0');
  return bytes_of<std::uint16_t>(0) + padded + bytes_of(id) +
         bytes_of(static_cast<std::uint16_t>(content.size())) + std::string(32, '\0') + content;
}

/// Where the points begin by a file's header.
inline std::size_t las_points_offset(const std::string& bytes) {
  std::uint32_t offset = 0;
  std::memcpy(&offset, bytes.data() + 96, sizeof offset);
  return offset;
}

/// A descriptor of extra bytes.
inline std::string las_descriptor(unsigned type, const std::string& name, unsigned options = 0,
                                  double scale = 0.0, double offset = 0.0) {
  std::string text = std::string(2, '\0') + static_cast<char>(type) + static_cast<char>(options) + name;
  text.resize(112, '\0');
  for (int i = 0; i < 3; ++i) text += bytes_of(scale);
  for (int i = 0; i < 3; ++i) text += bytes_of(offset);
  text.resize(192, '\0');
  return text;
}

inline std::string LasFile::record(const LasRecord& point) const {
  const bool is_extended = format >= 6;
  std::string text;
  for (const std::int32_t number : point.position) text += bytes_of(number);
  text += bytes_of(point.intensity);
  if (is_extended) {
    const unsigned flags = (point.is_synthetic ? 1U : 0U) | (point.is_withheld ? 4U : 0U);
    text += static_cast<char>(point.return_number | (point.returns << 4U));
    text += static_cast<char>(flags);
    text += static_cast<char>(point.classification);
    text += std::string(3, '\0') + bytes_of(point.source) + bytes_of(point.time);
  } else {
    const unsigned flags = (point.is_synthetic ? 32U : 0U) | (point.is_withheld ? 128U : 0U);
    text += static_cast<char>(point.return_number | (point.returns << 3U));
    text += static_cast<char>(point.classification | flags);
    text += std::string(2, '\0') + bytes_of(point.source);
    if (format == 1 || format == 3) text += bytes_of(point.time);
  }
  if (format == 2 || format == 3 || format == 7)
    for (const std::uint16_t channel : point.color) text += bytes_of(channel);
  return text + point.extra;
}

/// Formats 0 to 3, 6 and 7.
inline std::string LasFile::bytes() const {
  const bool is_1_4 = version_minor >= 4;
  const auto header_bytes = static_cast<std::uint16_t>(is_1_4 ? 375 : 227);
  std::string all_vlrs;
  for (const std::string& vlr : vlrs) all_vlrs += vlr;
  const std::size_t points_offset = header_bytes + all_vlrs.size() + padding.size();
  const auto count = static_cast<std::uint64_t>(claimed_points < 0 ? static_cast<std::int64_t>(records.size())
                                                                   : claimed_points);
  std::string text =
      "LASF" + std::string(20, '\0') + '\1' + static_cast<char>(version_minor) + std::string(68, '\0');
  text += bytes_of(header_bytes) + bytes_of(static_cast<std::uint32_t>(points_offset));
  text += bytes_of(
      static_cast<std::uint32_t>(claimed_vlrs < 0 ? static_cast<std::int64_t>(vlrs.size()) : claimed_vlrs));
  text += static_cast<char>(format);
  text += bytes_of(static_cast<std::uint16_t>(record({}).size() + extra_bytes));
  text += bytes_of(
      static_cast<std::uint32_t>(claimed_legacy < 0 ? static_cast<std::int64_t>(count) : claimed_legacy));
  text += std::string(20, '\0');
  for (const double number : scale) text += bytes_of(number);
  for (const double number : offset) text += bytes_of(number);
  for (int i = 0; i < 6; ++i) text += bytes_of(box);
  if (is_1_4) text += std::string(20, '\0') + bytes_of(count) + std::string(120, '\0');
  text += all_vlrs + padding;
  for (const LasRecord& point : records) text += record(point);
  return text + behind;
}

/// A point with a position in steps of the scale.
inline LasRecord las_point(std::int32_t x, std::int32_t y, std::int32_t z) {
  LasRecord point;
  point.position = {x, y, z};
  return point;
}

}  // namespace splatray
