/// The named sections of a scene file: the bytes of header and table that scene_file.h draws, and what reads the sections.
#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/file/scene_input.h"
#include "engine/scene/pool/pool.h"
#include "shaders/layout.h"

namespace splatray::scene_file {

inline constexpr char MAGIC[] = {'S', 'O', 'C', 'T'};
inline constexpr char END_MARKER[] = {'S', 'O', 'C', 'T', '.', 'E', 'N', 'D'};
inline constexpr std::uint32_t ENDIANNESS = 0x01020304;
inline constexpr std::uint64_t ALIGNMENT = 16;

/// What all versions begin with.
struct HeaderStart {
  char magic[4];
  std::uint32_t version, endianness, head_bytes;
  std::uint64_t file_bytes, checksum;
};

struct Header {
  HeaderStart start;
  std::uint32_t sections, entry_bytes;
  std::uint64_t zero;
};

enum class ElementType : std::uint32_t { record, uint8, uint16, float32, float64, uint32, uvec4, text };

/// Bytes of an element of each type; a record's are the table's to say.
inline constexpr std::uint32_t ELEMENT_BYTES[] = {0, 1, 2, 4, 8, 4, 16, 1};

struct SectionEntry {
  char name[24];
  ElementType type;
  std::uint32_t element_bytes, flags, zero;
  std::uint64_t offset, bytes, checksum;
};
static_assert(sizeof(HeaderStart) == 32 && sizeof(Header) == 48 && sizeof(SectionEntry) == 64);

/// Flag of a section that readers which do not know it pass over.
inline constexpr std::uint32_t SECTION_OPTIONAL = 1;

/// The type whose elements are such values; all that has no type of its own is a record.
template <typename Value>
[[nodiscard]] constexpr ElementType element_type() {
  if (std::is_same_v<Value, std::uint8_t>) return ElementType::uint8;
  if (std::is_same_v<Value, std::uint16_t>) return ElementType::uint16;
  if (std::is_same_v<Value, float>) return ElementType::float32;
  if (std::is_same_v<Value, double>) return ElementType::float64;
  if (std::is_same_v<Value, std::uint32_t>) return ElementType::uint32;
  if (std::is_same_v<Value, uvec4>) return ElementType::uvec4;
  return std::is_same_v<Value, char> ? ElementType::text : ElementType::record;
}

/// One section of a file.
struct Section {
  ElementType type;
  std::uint32_t element_bytes;  ///< > 0
  bool optional;                ///< passed over where it is not known
  std::uint64_t offset, bytes, checksum;

  [[nodiscard]] std::uint64_t count() const { return bytes / element_bytes; }
};

using SectionTable = std::map<std::string, Section>;

/// Where something behind `end` begins.
[[nodiscard]] inline std::uint64_t align(std::uint64_t end) {
  return (end + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
}

/// Bytes from one offset of a file on.
struct Span {
  std::uint64_t offset, bytes;
};

/// Refuses a file whose sections do not lie behind the head of `head_bytes` in this order, each at the next multiple of ALIGNMENT,
/// and then the end marker; or whose gaps are not zero.
void require_layout(SceneInput& input, std::uint64_t head_bytes, const std::vector<Span>& sections);

/// The table of a file of version 15 whose head, header and table, these bytes are. Refuses what contradicts itself.
[[nodiscard]] SectionTable read_table(SceneInput& input, const std::vector<char>& head);

/// Sections by their names. Each is taken once, and refused where its checksum is another.
class SectionReader {
 public:
  SectionReader(SceneInput& input, SectionTable table) : input_(input), table_(std::move(table)) {}

  [[nodiscard]] bool has(const std::string& name) const { return table_.count(name) != 0; }
  /// Refuses a file without the section.
  [[nodiscard]] const Section& find(const std::string& name) const;

  /// An array in memory. Refuses a file without it, elements of another type, and records of another size.
  template <typename Value>
  [[nodiscard]] std::vector<Value> array(const std::string& name) {
    require_array<Value>(name);
    std::vector<Value> values(find(name).count());
    take(name, values.data());
    return values;
  }

  /// The same where it lies, if it is large and the file is mapped.
  template <typename Value>
  [[nodiscard]] Pool<Value> pool(const std::string& name) {
    require_array<Value>(name);
    const Section& section = find(name);
    if (!input_.mapping() || section.bytes < LEAST_MAPPED_BYTES) return array<Value>(name);
    const std::byte* const begin = input_.mapping()->bytes().data() + section.offset;
    const std::span<const Value> lent(reinterpret_cast<const Value*>(begin), section.count());
    require_checksum(name, input_.checksum(section.offset, section.bytes), section.checksum);
    table_.erase(name);
    return {lent, input_.mapping()};
  }

  /// Records, whatever is behind a Record's end left out; what they are too short for is zero. Refuses a file without them, and
  /// records of fewer than `least_bytes`.
  template <typename Record>
  [[nodiscard]] std::vector<Record> records(const std::string& name, std::uint32_t least_bytes) {
    static_assert(element_type<Record>() == ElementType::record && std::is_trivially_copyable_v<Record>);
    require_type(name, ElementType::record);
    require_record(name, least_bytes);
    std::vector<Record> records(find(name).count(), Record{});
    take_records(name, records.data(), sizeof(Record));
    return records;
  }

  /// As many strings. Refuses a file without the section, one with another number, and one without a zero byte at its end.
  [[nodiscard]] std::vector<std::string> strings(const std::string& name, std::uint64_t count);

  /// Passes over what was not taken. Refuses a section of these that is not optional, or damaged.
  void end();

 private:
  template <typename Value>
  void require_array(const std::string& name) const {
    static_assert(std::is_trivially_copyable_v<Value> && alignof(Value) <= ALIGNMENT);
    require_type(name, element_type<Value>());
    if (find(name).element_bytes != sizeof(Value))
      input_.refuse(
          "section '" + name + "' with elements of " + std::to_string(find(name).element_bytes) + " bytes",
          std::to_string(sizeof(Value)));
  }
  void require_type(const std::string& name, ElementType type) const;
  void require_record(const std::string& name, std::uint32_t least_bytes) const;
  void take(const std::string& name, void* target);
  void take_records(const std::string& name, void* target, std::size_t record_bytes);
  void require_checksum(const std::string& name, std::uint64_t found, std::uint64_t expected) const;

  SceneInput& input_;
  SectionTable table_;  ///< what has not been taken
};

}  // namespace splatray::scene_file
