#include "engine/file/scene_sections.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <iterator>
#include <span>

#include "engine/file/checksum.h"

namespace splatray::scene_file {
namespace {

void require_zeros(SceneInput& input, std::uint64_t begin, std::uint64_t end) {
  char gap[ALIGNMENT];
  input.read(begin, gap, end - begin);
  for (const char byte : std::span(gap, end - begin))
    if (byte != 0) input.refuse("a filled gap before byte " + std::to_string(end), "zeros (file damaged)");
}

/// Names may be part of sentences.
bool is_name(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return c < 128 && (std::isalnum(c) != 0 || std::strchr("_.-", c) != nullptr);
  });
}

std::string name_of(SceneInput& input, const SectionEntry& entry) {
  const char *begin = std::begin(entry.name), *end = std::end(entry.name);
  const std::string name(begin, std::find(begin, end, '\0'));
  if (!is_name(name) || std::any_of(begin + name.size(), end, [](char c) { return c != '\0'; }))
    input.refuse("a section without a proper name", "letters, digits and _ . - in its name, then zeros");
  return name;
}

Section section_of(SceneInput& input, const SectionEntry& entry, const std::string& name) {
  const std::string section = "section '" + name + "' ";
  const auto type = static_cast<std::uint32_t>(entry.type);
  if (type >= std::size(ELEMENT_BYTES))
    input.refuse(section + "of type " + std::to_string(type),
                 "0 to " + std::to_string(std::size(ELEMENT_BYTES) - 1));
  const std::uint32_t bytes = entry.type == ElementType::record ? entry.element_bytes : ELEMENT_BYTES[type];
  if (entry.element_bytes != bytes || bytes == 0)
    input.refuse(section + "with elements of " + std::to_string(entry.element_bytes) + " bytes",
                 bytes == 0 ? "1 or more" : std::to_string(bytes));
  if (entry.bytes % bytes != 0)
    input.refuse(section + "of " + std::to_string(entry.bytes) + " bytes",
                 "a multiple of its elements' " + std::to_string(bytes));
  if ((entry.flags & ~SECTION_OPTIONAL) != 0 || entry.zero != 0)
    input.refuse(section + "with unknown flags", "1, optional, or 0");
  return {entry.type,   entry.element_bytes, (entry.flags & SECTION_OPTIONAL) != 0,
          entry.offset, entry.bytes,         entry.checksum};
}

}  // namespace

void require_layout(SceneInput& input, std::uint64_t head_bytes, const std::vector<Span>& sections) {
  const auto contradicts = [&] {
    input.refuse("a section table that contradicts the file's size",
                 "sections one behind the other, from the header to the end marker");
  };
  const std::uint64_t marker = input.size() - sizeof END_MARKER;
  std::uint64_t end = head_bytes;
  for (const auto& [offset, bytes] : sections) {
    if (offset != align(end) || offset > marker || bytes > marker - offset) contradicts();
    require_zeros(input, end, offset);
    end = offset + bytes;
  }
  if (align(end) != marker) contradicts();
  require_zeros(input, end, marker);
  char found[sizeof END_MARKER];
  input.read(marker, found, sizeof found);
  if (std::memcmp(found, END_MARKER, sizeof found) != 0)
    input.refuse("another end", "the end marker SOCT.END");
}

SectionTable read_table(SceneInput& input, const std::vector<char>& head) {
  Header header{};
  std::memcpy(&header, head.data(), std::min(head.size(), sizeof header));
  const std::uint64_t expected = sizeof header + header.sections * std::uint64_t{sizeof(SectionEntry)};
  if (head.size() != expected || header.entry_bytes != sizeof(SectionEntry) || header.zero != 0)
    input.refuse("a header of " + std::to_string(head.size()) + " bytes for " +
                     std::to_string(header.sections) + " sections",
                 std::to_string(expected));
  SectionTable table;
  std::vector<Span> spans;
  for (std::size_t at = sizeof header; at < head.size(); at += sizeof(SectionEntry)) {
    SectionEntry entry;
    std::memcpy(&entry, head.data() + at, sizeof entry);
    const std::string name = name_of(input, entry);
    if (!table.emplace(name, section_of(input, entry, name)).second)
      input.refuse("two sections '" + name + "'", "one of each name");
    spans.push_back({entry.offset, entry.bytes});
  }
  require_layout(input, head.size(), spans);
  return table;
}

const Section& SectionReader::find(const std::string& name) const {
  const auto found = table_.find(name);
  if (found == table_.end()) input_.refuse("no section '" + name + "'", "one in each scene");
  return found->second;
}

std::vector<std::string> SectionReader::strings(const std::string& name, std::uint64_t count) {
  const std::vector<char> bytes = array<char>(name);
  const auto found = static_cast<std::uint64_t>(std::count(bytes.begin(), bytes.end(), '\0'));
  if (found != count || (!bytes.empty() && bytes.back() != '\0'))
    input_.refuse("section '" + name + "' of " + std::to_string(found) + " names",
                  std::to_string(count) + ", a zero byte after each");
  std::vector<std::string> strings;
  for (const char* next = bytes.data(); strings.size() < count; next += strings.back().size() + 1)
    strings.emplace_back(next);
  return strings;
}

void SectionReader::end() {
  for (const auto& [name, section] : table_) {
    if (!section.optional)
      input_.refuse("section '" + name + "'",
                    "none, as this version knows no such section and it is not optional");
    require_checksum(name, input_.checksum(section.offset, section.bytes), section.checksum);
  }
}

void SectionReader::require_type(const std::string& name, ElementType type) const {
  const ElementType found = find(name).type;
  if (found != type)
    input_.refuse("section '" + name + "' of type " + std::to_string(static_cast<std::uint32_t>(found)),
                  std::to_string(static_cast<std::uint32_t>(type)));
}

void SectionReader::require_record(const std::string& name, std::uint32_t least_bytes) const {
  const std::uint32_t found = find(name).element_bytes;
  if (found < least_bytes)
    input_.refuse("section '" + name + "' with records of " + std::to_string(found) + " bytes",
                  "at least " + std::to_string(least_bytes));
}

void SectionReader::take(const std::string& name, void* target) {
  const Section& section = find(name);
  input_.read(section.offset, target, section.bytes);
  require_checksum(name, checksum_of(target, section.bytes), section.checksum);
  table_.erase(name);
}

void SectionReader::take_records(const std::string& name, void* target, std::size_t record_bytes) {
  const Section section = find(name);
  std::vector<char> bytes(section.bytes);
  take(name, bytes.data());
  for (std::uint64_t at = 0; at < section.bytes; at += section.element_bytes) {
    std::memcpy(target, bytes.data() + at, std::min<std::size_t>(section.element_bytes, record_bytes));
    target = static_cast<char*>(target) + record_bytes;
  }
}

void SectionReader::require_checksum(const std::string& name, std::uint64_t found,
                                     std::uint64_t expected) const {
  if (found != expected)
    input_.refuse("section '" + name + "' with another checksum", "the one in the header (file damaged)");
}

}  // namespace splatray::scene_file
