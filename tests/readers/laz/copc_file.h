/// Makes a COPC file of a LAZ file: its chunks become the nodes of an octree.
#pragma once
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "preprocess/read/las/laz/laz_chunks.h"

namespace splatray {

/// An entry of COPC's directory: level and place of a cube, where its points or more of the directory are, bytes, points (-1: a page).
struct CopcEntry {
  std::array<std::int32_t, 4> key{};
  std::uint64_t offset = 0;
  std::int32_t bytes = 0, points = 0;
};

/// Bytes that the info record adds before the points.
inline constexpr std::uint64_t COPC_INFO_BYTES = 54 + 160;

template <class T>
void put_number(std::string& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}
template <class T>
T number_at(const std::string& bytes, std::size_t at) {
  T value{};
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

/// The file with an octree from `low` on of this edge, whose directory's first page at the file's end has these entries, which name
/// places in the file made. LAS 1.4.
inline std::string copc_of(const std::string& laz, double low, double edge,
                           const std::vector<CopcEntry>& entries) {
  constexpr std::size_t HEADER_BYTES_AT = 94, POINTS_AT = 96, VLR_COUNT_AT = 100, EVLR_AT = 235;
  const auto header = number_at<std::uint16_t>(laz, HEADER_BYTES_AT);
  std::string info(COPC_INFO_BYTES, '\0');
  std::memcpy(info.data() + 2, "copc", 4);
  put_number(info, 18, std::uint16_t{1});
  put_number(info, 20, std::uint16_t{160});
  for (std::size_t i = 0; i < 3; ++i) put_number(info, 54 + 8 * i, low + 0.5 * edge);
  put_number(info, 54 + 24, 0.5 * edge);
  std::string file = laz.substr(0, header) + info + laz.substr(header);
  put_number(file, 54 + header + 40, std::uint64_t{file.size()});
  put_number(file, 54 + header + 48, std::uint64_t{32 * entries.size()});
  const auto points = static_cast<std::uint32_t>(number_at<std::uint32_t>(laz, POINTS_AT) + COPC_INFO_BYTES);
  put_number(file, POINTS_AT, points);
  put_number(file, VLR_COUNT_AT, number_at<std::uint32_t>(laz, VLR_COUNT_AT) + 1);
  if (const auto records = number_at<std::uint64_t>(laz, EVLR_AT); records != 0)
    put_number(file, EVLR_AT, records + COPC_INFO_BYTES);
  put_number(file, points, number_at<std::uint64_t>(file, points) + COPC_INFO_BYTES);  // of the chunk table
  for (const CopcEntry& entry : entries) {
    std::string bytes(32, '\0');
    std::memcpy(bytes.data(), entry.key.data(), 16);
    put_number(bytes, 16, entry.offset);
    put_number(bytes, 24, entry.bytes);
    put_number(bytes, 28, entry.points);
    file += bytes;
  }
  return file;
}

}  // namespace splatray
