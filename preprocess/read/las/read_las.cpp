#include "preprocess/read/las/read_las.h"

#include <algorithm>
#include <utility>

#include "engine/base/number_text.h"
#include "preprocess/base/level_facts.h"
#include "preprocess/base/quoted_list.h"
#include "preprocess/read/las/copc.h"
#include "preprocess/read/las/las_columns.h"
#include "preprocess/read/las/las_extra_bytes.h"
#include "preprocess/read/las/las_further_fields.h"
#include "preprocess/read/las/las_header.h"
#include "preprocess/read/las/las_units.h"
#include "preprocess/read/las/las_vlrs.h"
#include "preprocess/read/las/laz/laz_layout.h"
#include "preprocess/read/las/laz/read_laz.h"

namespace splatray {
namespace {

std::vector<LasExtraBytes> all_extra_bytes(const LasHeader& header, const LasVlrs& vlrs) {
  return las_extra_bytes(vlrs.extra_bytes, las_fields(header.point_format).bytes, header.record_bytes);
}

LasExtras chosen_extra_bytes(const LasHeader& header, const LasVlrs& vlrs, const ScanOptions& options) {
  return chosen_extra_bytes(header.point_format, all_extra_bytes(header, vlrs), options.attributes);
}

/// Says once of a file which attributes are rounded.
void note_rounded(const LasColumns& columns, const std::filesystem::path& path,
                  const ReadListener& listener) {
  const std::vector<std::string> names = columns.rounded();
  const std::string sentence = "found integers of 2^53 and more in " + quoted_list(names) +
                               ", expected less: of such numbers the first 53 bits are kept";
  const auto is_said = [&](const std::string& note) { return note == path.string() + ": " + sentence; };
  if (!names.empty() && std::none_of(listener.notes.begin(), listener.notes.end(), is_said))
    listener.note(path, sentence);
}

/// Points that are not compressed: `count` from the record `first` on, or as many as there are whole records.
std::uint64_t read_records(ByteReader& in, const LasHeader& header, std::uint64_t first, std::uint64_t count,
                           LasColumns& columns, ScanCounts& counts, const ReadListener& listener) {
  in.seek(0);
  const std::uint64_t begin = header.points_offset + first * header.record_bytes;
  if (begin > in.remaining()) return 0;
  in.seek(begin);
  count = std::min<std::uint64_t>(count, in.remaining() / header.record_bytes);
  columns.reserve(static_cast<std::size_t>(count));
  const std::size_t most = std::max<std::size_t>(1, ByteReader::BLOCK_BYTES / header.record_bytes);
  for (std::uint64_t done = 0; done < count;) {
    listener.report(static_cast<double>(first + done) / static_cast<double>(header.point_count));
    const auto step = static_cast<std::size_t>(std::min<std::uint64_t>(most, count - done));
    const unsigned char* records = in.take(step * header.record_bytes);
    if (records == nullptr) throw_unreadable(in.path(), "it could not be read to its end");
    const std::size_t at = columns.grow(step);
    const LasColumns::Filled filled = columns.fill(records, step, at);
    columns.cut(at + filled.kept);
    counts.withheld += filled.withheld;
    counts.noise += filled.noise;
    done += step;
    listener.show(columns.points());
  }
  return count;
}

/// A program that was stopped leaves a header that counts nothing before records that are there.
void count_points(ByteReader& in, LasHeader& header, const ReadListener& listener) {
  if (header.point_count != 0 || header.is_compressed) return;
  in.seek(header.points_offset);
  const std::uint64_t bytes = header.evlr_offset > header.points_offset
                                  ? std::min(in.remaining(), header.evlr_offset - header.points_offset)
                                  : in.remaining();
  header.point_count = bytes / header.record_bytes;
  if (header.point_count != 0)
    listener.note(in.path(), "the header counts no points; found " + std::to_string(header.point_count));
}

/// "a, b".
std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// What the header says.
std::vector<FileFact> facts_of(const LasHeader& header, const LasVlrs& vlrs) {
  std::vector<FileFact> facts = {{"version", "LAS 1." + std::to_string(header.version_minor)},
                                 {"point format", std::to_string(header.point_format) +
                                                      (header.is_compressed ? ", compressed by LASzip" : "")},
                                 {"scale", number_text(header.scale, ' ')},
                                 {"offset", number_text(header.offset, ' ')}};
  if (!header.system.empty()) facts.push_back({"system id", header.system});
  if (!header.software.empty()) facts.push_back({"software", header.software});
  if (header.year != 0)
    facts.push_back({"made", "day " + std::to_string(header.day) + " of " + std::to_string(header.year)});
  std::vector<std::string> extra;
  for (const LasExtraBytes& one : all_extra_bytes(header, vlrs)) extra.push_back(one.name);
  if (!extra.empty()) facts.push_back({"extra bytes", listed(extra)});
  facts.push_back({"more fields", listed(las_further_names(header.point_format))});
  return facts;
}

/// The chunks of the nodes that are chosen of the file; nothing: all.
std::optional<std::vector<LazChunk>> chosen_chunks(const std::filesystem::path& path, const Levels& levels,
                                                   const ChosenNodes& nodes) {
  const auto chosen = nodes.find(path);
  if (chosen == nodes.end()) return std::nullopt;
  if (!chosen->second.empty() && chosen->second.back() >= levels.nodes.size())
    throw_unreadable(path, "found " + std::to_string(levels.nodes.size()) +
                               " nodes in its directory, expected more: it has changed");
  return chunks_of(levels, chosen->second);
}

std::uint64_t points_in(const std::vector<LazChunk>& chunks) {
  std::uint64_t sum = 0;
  for (const LazChunk& chunk : chunks) sum += chunk.points;
  return sum;
}

}  // namespace

ScanFile read_las(const std::filesystem::path& path, const ReadOptions& options,
                  const ReadListener& listener) {
  ByteReader in(path);
  LasHeader header = read_las_header(in);
  const LasVlrs vlrs = read_las_vlrs(in, header);
  if (const auto sentence = differing_las_units(vlrs)) listener.note(path, *sentence);
  count_points(in, header, listener);
  LasColumns columns(header, chosen_extra_bytes(header, vlrs, options.scans), options.scans);
  ScanFile file;
  file.in_degrees = las_in_degrees(vlrs);
  file.counts.stored = header.point_count;
  file.facts = facts_of(header, vlrs);
  file.said_box = {header.box_low, header.box_high};
  Levels levels;
  try {
    levels = read_copc(in, header, vlrs);
    add_level_facts(levels, "COPC", file.facts);
  } catch (const Error& error) {
    listener.notes.emplace_back(error.what());
  }
  if (options.heads_only) {
    file.points.crs = las_crs(vlrs);
    return file;
  }
  const auto chosen = chosen_chunks(path, levels, options.nodes);
  if (chosen) file.counts.stored = points_in(*chosen);
  const std::uint64_t found =
      header.is_compressed ? read_laz_points(in, header, vlrs.laszip, chosen, columns, file.counts, listener)
                           : read_records(in, header, 0, header.point_count, columns, file.counts, listener);
  file.counts.missing = file.counts.stored - found;
  if (file.counts.missing != 0) {
    const std::string sentence = "found " + std::to_string(found) + " whole points, expected the " +
                                 std::to_string(file.counts.stored) + " that the " +
                                 (chosen ? "directory" : "header") + " counts";
    if (options.scans.strict) throw_unreadable(path, sentence);
    listener.note(path, sentence);
  }
  note_rounded(columns, path, listener);
  file.points = columns.take();
  file.points.crs = las_crs(vlrs);
  return file;
}

LasBatches::LasBatches(const std::filesystem::path& path, const ReadOptions& options,
                       const ReadListener& listener)
    : in_(path), header_(read_las_header(in_)), vlrs_(read_las_vlrs(in_, header_)), options_(options) {
  count_points(in_, header_, listener);
  if (!header_.is_compressed) {
    for (std::uint64_t first = 0; first < header_.point_count; first += MOST_POINTS)
      batches_.push_back({first, std::min(MOST_POINTS, header_.point_count - first), {}});
    return;
  }
  const LazLayout layout = read_laz_layout(vlrs_.laszip, header_, path);
  const std::optional<std::vector<LazChunk>> chunks = find_laz_chunks(in_, header_, layout);
  if (!chunks)
    throw_unreadable(
        path, "found compressed points without a table of their chunks, expected it: the file is cut off");
  for (const LazChunk& chunk : *chunks) {
    if (batches_.empty() || batches_.back().count + chunk.points > MOST_POINTS)
      batches_.push_back({0, 0, {}});
    batches_.back().count += chunk.points;
    batches_.back().chunks.push_back(chunk);
  }
}

std::string LasBatches::crs() const { return las_crs(vlrs_); }
std::optional<bool> LasBatches::in_degrees() const { return las_in_degrees(vlrs_); }

Points LasBatches::read(std::size_t i, ScanCounts& counts, const ReadListener& listener) {
  const Batch& batch = batches_[i];
  LasColumns columns(header_, chosen_extra_bytes(header_, vlrs_, options_.scans), options_.scans);
  const std::uint64_t found =
      header_.is_compressed
          ? read_laz_points(in_, header_, vlrs_.laszip, batch.chunks, columns, counts, listener)
          : read_records(in_, header_, batch.first, batch.count, columns, counts, listener);
  counts.stored += batch.count;
  counts.missing += batch.count - std::min(batch.count, found);
  note_rounded(columns, in_.path(), listener);
  return columns.take();
}

}  // namespace splatray
