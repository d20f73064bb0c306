#include "preprocess/read/e57/read_e57.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "preprocess/read/e57/description.h"
#include "preprocess/read/e57/packet_reader.h"
#include "preprocess/read/e57/scan_decoder.h"

namespace splatray {
namespace {

constexpr std::uint64_t LEAST_RECORD_BITS = 64;  ///< for which memory is reserved; smaller ones make it grow

std::uint64_t size_of(const E57Section& section) {
  return section.end - std::min(section.begin, section.end);
}

/// The section of each scan, empty where it has no records. None reaches into the next one's, so that no byte makes points
/// of several scans.
std::vector<E57Section> find_sections(PagedFile& file, const std::vector<E57Scan>& scans) {
  std::vector<E57Section> sections(scans.size());
  std::vector<std::uint64_t> headers;
  std::vector<std::uint64_t> begins;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (scans[i].records == 0) continue;
    headers.push_back(file.content_offset(scans[i].physical_offset, "points"));
    sections[i] = read_section_header(file, headers.back());
    if (size_of(sections[i]) > 0) begins.push_back(sections[i].begin);
  }
  std::sort(headers.begin(), headers.end());
  std::sort(begins.begin(), begins.end());
  if (std::adjacent_find(begins.begin(), begins.end()) != begins.end())
    throw_unreadable(file.path(), "found two scans with the same points, expected each to have its own");
  for (E57Section& section : sections)
    for (const std::vector<std::uint64_t>& starts : {std::cref(headers), std::cref(begins)}) {
      const auto next = std::upper_bound(starts.begin(), starts.end(), section.begin);
      if (next != starts.end()) section.end = std::min(section.end, *next);
    }
  return sections;
}

/// Records that the section's bytes suffice for, by a modest guess: what to reserve, and the scan's part of all reading.
std::uint64_t likely_records(const E57Scan& scan, const E57Section& section) {
  std::uint64_t bits = 0;
  for (const E57Field& field : scan.fields) bits += field.bits;
  return std::min(scan.records, 8 * size_of(section) / std::max(bits, LEAST_RECORD_BITS));
}

void note_once(std::vector<std::string> sentences, const std::filesystem::path& path,
               const ReadListener& listener) {
  std::sort(sentences.begin(), sentences.end());
  sentences.erase(std::unique(sentences.begin(), sentences.end()), sentences.end());
  for (const std::string& sentence : sentences) listener.note(path, sentence);
}

/// Says what the file lacks, or refuses it.
void judge(const PagedFile& pages, const ScanCounts& counts, bool strict, const ReadListener& listener) {
  if (counts.missing > 0) {
    const std::string found = "found " + std::to_string(counts.stored - counts.missing) + " of the " +
                              std::to_string(counts.stored) + " records that it names";
    if (strict) throw_unreadable(pages.path(), found + ", expected all");
    listener.note(pages.path(), found + (pages.is_cut_off() ? "; the file is cut off" : ""));
  }
  if (pages.first_bad_page())
    listener.note(pages.path(),
                  "page " + std::to_string(*pages.first_bad_page()) +
                      " and maybe more do not match their checksums; they are read as they are");
}

/// The file as its XML section alone describes it.
ScanFile for_heads(const std::vector<E57Scan>& scans, ScanFile file) {
  for (const E57Scan& scan : scans) {
    file.counts.stored += scan.records;
    Station& station = file.points.stations.emplace_back();
    station.name = scan.name;
  }
  return file;
}

}  // namespace

ScanFile read_e57(const std::filesystem::path& path, const ReadOptions& options,
                  const ReadListener& listener) {
  PagedFile pages(path, options.scans.ignore_checksums);
  const auto [scans, crs, library] = read_e57_description(pages);
  const std::vector<E57Section> sections = find_sections(pages, scans);
  std::uint64_t likely = 0;
  for (std::size_t i = 0; i < scans.size(); ++i) likely += likely_records(scans[i], sections[i]);
  ScanFile file;
  file.points.crs = crs;
  file.facts = {{"version", "E57 1.0"}};
  if (!library.empty()) file.facts.push_back({"software", library});
  if (options.heads_only) return for_heads(scans, std::move(file));
  file.points.position.reserve(likely);
  std::vector<std::string> notes;
  ScanColors colors;
  std::vector<std::size_t> last_of_scan;
  const auto share_of = [likely](std::uint64_t records) {
    return static_cast<double>(records) / static_cast<double>(std::max<std::uint64_t>(likely, 1));
  };
  std::uint64_t done = 0;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const std::uint64_t from = done;
    done += likely_records(scans[i], sections[i]);
    const ScanLayout layout = find_layout(scans[i], options.scans.attributes, path, notes);
    ScanDecoder decoder(scans[i], layout, colors, file);
    decoder.decode(pages, sections[i], listener.part(share_of(from), share_of(done)));
    decoder.finish(notes);
    last_of_scan.push_back(file.points.size());
    listener.show(file.points);
  }
  finish_scans(file.points, last_of_scan);
  colors.finish(file.points, notes);
  note_once(std::move(notes), path, listener);
  judge(pages, file.counts, options.scans.strict, listener);
  return file;
}

}  // namespace splatray
