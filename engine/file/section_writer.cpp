#include "engine/file/section_writer.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "engine/file/atomic_file.h"
#include "engine/file/checksum.h"

namespace splatray::scene_file {
namespace {

constexpr char ZEROS[ALIGNMENT] = {};

void write_section(AtomicFile& file, const SectionEntry& entry, const void* content, std::uint64_t file_bytes,
                   const Progress& progress) {
  for (std::uint64_t done = 0; done < entry.bytes; done += PIECE_BYTES) {
    report(progress, "writing", entry.offset + done, file_bytes);
    file.write(static_cast<const char*>(content) + done, std::min(entry.bytes - done, PIECE_BYTES));
  }
}

}  // namespace

void SectionWriter::keep_strings(const std::string& name, const std::vector<std::string>& strings) {
  std::vector<char> bytes;
  for (const std::string& text : strings)
    bytes.insert(bytes.end(), text.c_str(), text.c_str() + std::strlen(text.c_str()) + 1);
  keep(name, bytes);
}

void SectionWriter::add(const std::string& name, const Elements& elements, const void* content,
                        std::uint64_t bytes) {
  SectionEntry entry{
      {}, elements.type, elements.bytes, elements.flags, 0, 0, bytes, checksum_of(content, bytes)};
  assert(name.size() <= sizeof entry.name);
  name.copy(entry.name, sizeof entry.name);
  entries_.push_back(entry);
  contents_.push_back(content);
}

std::uint64_t SectionWriter::table_end() const {
  return sizeof(Header) + entries_.size() * sizeof(SectionEntry);
}

void SectionWriter::write(std::uint32_t version, const std::filesystem::path& path,
                          const Progress& progress) {
  std::uint64_t end = table_end();
  for (SectionEntry& entry : entries_) {
    entry.offset = align(end);
    end = entry.offset + entry.bytes;
  }
  const Header header = sealed_header(version, align(end) + sizeof END_MARKER);
  AtomicFile file(path);
  file.write(&header, sizeof header);
  file.write(entries_.data(), table_end() - sizeof header);
  end = table_end();
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    file.write(ZEROS, entries_[i].offset - end);
    write_section(file, entries_[i], contents_[i], header.start.file_bytes, progress);
    end = entries_[i].offset + entries_[i].bytes;
  }
  file.write(ZEROS, align(end) - end);
  file.write(END_MARKER, sizeof END_MARKER);
  file.commit();
}

Header SectionWriter::sealed_header(std::uint32_t version, std::uint64_t file_bytes) const {
  Header header{{{}, version, ENDIANNESS, static_cast<std::uint32_t>(table_end()), file_bytes, 0},
                static_cast<std::uint32_t>(entries_.size()),
                sizeof(SectionEntry),
                0};
  std::memcpy(header.start.magic, MAGIC, sizeof MAGIC);
  Checksum checksum;
  checksum.add(&header, sizeof header);
  checksum.add(entries_.data(), table_end() - sizeof header);
  header.start.checksum = checksum.value();
  return header;
}

}  // namespace splatray::scene_file
