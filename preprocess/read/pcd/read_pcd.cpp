#include "preprocess/read/pcd/read_pcd.h"

#include <algorithm>
#include <cstring>

#include "preprocess/base/quoted_list.h"
#include "preprocess/read/float_precision.h"
#include "preprocess/read/pcd/lzf.h"
#include "preprocess/read/pcd/pcd_points.h"
#include "preprocess/read/scan/missing_points.h"
#include "preprocess/read/scan/sensor_place.h"
#include "preprocess/read/text/row_reader.h"

namespace splatray {
namespace {

/// How many points there are; the readers append them.
std::uint64_t read_ascii(ByteReader& in, const PcdHeader& header, PcdPoints& points,
                         const ReadListener& listener) {
  const TextPlace start{in.offset(), header.line_count};
  RowReader rows(in.path(), listener, find_cell_form(first_rows(in)), start);
  RowRun run;
  std::uint64_t read = 0;
  while (read < header.points && rows.next(run)) {
    if (run.width != header.row_cells)
      rows.fail(run.first_line, "found " + std::to_string(run.width) + " numbers, expected " +
                                    std::to_string(header.row_cells));
    const std::uint64_t count = std::min<std::uint64_t>(run.rows, header.points - read);
    if (run.open && read + 1 < header.points) break;  // it may have lost digits
    points.append({reinterpret_cast<const unsigned char*>(run.values), count});
    read += count;
    if (count < run.rows)
      listener.note(in.path(), "more lines follow the " + std::to_string(header.points) +
                                   " points that the header names; they were left out");
  }
  return read;
}

std::uint64_t read_binary(ByteReader& in, const PcdHeader& header, PcdPoints& points) {
  const std::uint64_t present = std::min(header.points, in.remaining() / header.row_bytes);
  const std::uint64_t block = ByteReader::BLOCK_BYTES / header.row_bytes;
  for (std::uint64_t read = 0; read < present;) {
    const std::uint64_t count = std::min(block, present - read);
    const unsigned char* bytes = in.take(static_cast<std::size_t>(count * header.row_bytes));
    if (bytes == nullptr) throw_unreadable(in.path(), "it could not be read to its end");
    points.append({bytes, count});
    read += count;
  }
  return present;
}

std::vector<unsigned char> take_all(ByteReader& in, std::uint64_t count) {
  std::vector<unsigned char> all;
  all.reserve(static_cast<std::size_t>(count));
  while (all.size() < count) {
    const std::size_t step =
        static_cast<std::size_t>(std::min<std::uint64_t>(count - all.size(), ByteReader::BLOCK_BYTES));
    const unsigned char* bytes = in.take(step);
    if (bytes == nullptr) throw_unreadable(in.path(), "it could not be read to its end");
    all.insert(all.end(), bytes, bytes + step);
  }
  return all;
}

std::uint64_t read_compressed(ByteReader& in, const PcdHeader& header, PcdPoints& points) {
  std::uint32_t sizes[2] = {0, 0};  // compressed, and not
  const unsigned char* bytes = in.take(sizeof sizes);
  if (bytes == nullptr) return 0;
  std::memcpy(sizes, bytes, sizeof sizes);
  if (header.points != sizes[1] / header.row_bytes || sizes[1] % header.row_bytes != 0)
    throw_unreadable(in.path(), "found " + std::to_string(sizes[1]) +
                                    " bytes of compressed points, expected " + std::to_string(header.points) +
                                    " points of " + std::to_string(header.row_bytes) + " bytes");
  const std::uint64_t present = std::min<std::uint64_t>(sizes[0], in.remaining());
  if (sizes[1] / LZF_MOST_GAIN > sizes[0])
    throw_unreadable(in.path(), "found " + std::to_string(sizes[1]) + " bytes compressed to " +
                                    std::to_string(sizes[0]) + ", expected at least an 88th of them");
  const std::vector<unsigned char> compressed = take_all(in, present);
  const std::uint64_t most = std::min<std::uint64_t>(sizes[1], present * LZF_MOST_GAIN);
  std::vector<unsigned char> decoded(static_cast<std::size_t>(most));
  const std::uint64_t count = points.whole_points(decompress_lzf(compressed, decoded));
  points.append({decoded.data(), count});
  return count;
}

std::uint64_t read_points(ByteReader& in, const PcdHeader& header, PcdPoints& points,
                          const ReadListener& listener) {
  switch (header.data) {
    case PcdData::ascii:
      return read_ascii(in, header, points, listener);
    case PcdData::binary:
      return read_binary(in, header, points);
    case PcdData::binary_compressed:
      break;
  }
  return read_compressed(in, header, points);
}

/// Whether a grid was seen by a camera in whose frame it is: z ahead, y down. Of turned viewpoints only the half turn about
/// x is such, which some drivers write beside points that are not turned.
bool is_camera_frame(const PcdHeader& header, const Points& points) {
  const auto ahead = std::count_if(points.position.begin(), points.position.end(),
                                   [](const glm::dvec3& p) { return p.z > 0.0; });
  const bool straight =
      header.rotation == glm::dvec4(1.0, 0.0, 0.0, 0.0) || header.rotation == glm::dvec4(0.0, 1.0, 0.0, 0.0);
  return header.height > 1 && header.viewpoint == glm::dvec3(0.0) && straight &&
         static_cast<std::size_t>(ahead) > points.size() / 2;
}

Station make_station(const PcdHeader& header, const Points& points) {
  Station station;
  if (header.height > 1) {
    station.rows = header.height;
    station.columns = header.width;
  }
  const bool stated = header.height > 1 || header.viewpoint != glm::dvec3(0.0) ||
                      header.rotation != glm::dvec4(1.0, 0.0, 0.0, 0.0);
  if (stated) station.sensor_world = credible_sensor(header.viewpoint, points.position);
  return station;
}

}  // namespace

ScanFile read_pcd(const std::filesystem::path& path, const ReadOptions& options,
                  const ReadListener& listener) {
  ByteReader in(path, &listener);
  PcdHeader header = read_pcd_header(in);
  const std::uint64_t cells = std::uint64_t{header.width} * header.height;
  if (header.height > 1 && (cells != header.points || cells >= NO_CELL)) {
    listener.note(path, "its " + std::to_string(header.width) + " x " + std::to_string(header.height) +
                            " cells are not its " + std::to_string(header.points) +
                            " points, which are read without a grid");
    header.height = 1;
  }
  PcdPoints collected(header, path, options.scans.attributes);
  ScanFile file;
  file.counts.stored = header.points;
  file.counts.missing = header.points - read_points(in, header, collected, listener);
  file.counts.no_return = collected.no_return();
  std::vector<std::string> said;
  file.points = collected.take(said);
  for (const std::string& sentence : said) listener.note(path, sentence);
  if (header.is_viewpoint_left_out)
    listener.note(path,
                  "its VIEWPOINT is no seven finite numbers with a rotation among them and was left out");
  if (is_camera_frame(header, file.points)) file.up = {0.0, -1.0, 0.0};
  file.points.stations = {make_station(header, file.points)};
  report_missing(path, file.counts, options.scans, listener);
  if (const std::vector<std::string> unused = collected.unused(); !unused.empty())
    listener.note(path, "skipped fields " + quoted_list(unused));
  if (header.data != PcdData::ascii && collected.has_float_positions())
    note_float_precision(file.points, path, listener);
  return file;
}

}  // namespace splatray
