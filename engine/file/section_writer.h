/// Writes a scene file from its sections.
#pragma once
#include <deque>
#include <string>
#include <vector>

#include "engine/file/scene_sections.h"

namespace splatray::scene_file {

/// Sections in the order of the file.
class SectionWriter {
 public:
  /// Elements that stay where they are until the file is written. `flags`: SECTION_OPTIONAL or 0.
  template <typename Values>
  void add(const std::string& name, const Values& values, std::uint32_t flags = 0) {
    using Value = typename Values::value_type;
    static_assert(std::is_trivially_copyable_v<Value>);
    add(name, {element_type<Value>(), sizeof(Value), flags}, values.data(), values.size() * sizeof(Value));
  }
  /// As above, of values that are kept.
  template <typename Value>
  void keep(const std::string& name, const std::vector<Value>& values) {
    const char* bytes = reinterpret_cast<const char*>(values.data());
    const std::vector<char>& kept = kept_.emplace_back(bytes, bytes + values.size() * sizeof(Value));
    add(name, {element_type<Value>(), sizeof(Value), 0}, kept.data(), kept.size());
  }
  /// Strings up to a zero byte that they hold, each ended by one.
  void keep_strings(const std::string& name, const std::vector<std::string>& strings);

  /// Throws Error (failed) when it cannot, (interrupted) when `progress` says so; leaves nothing behind.
  void write(std::uint32_t version, const std::filesystem::path& path, const Progress& progress);

 private:
  /// What an entry says of its elements.
  struct Elements {
    ElementType type;
    std::uint32_t bytes, flags;
  };
  void add(const std::string& name, const Elements& elements, const void* content, std::uint64_t bytes);
  [[nodiscard]] Header sealed_header(std::uint32_t version, std::uint64_t file_bytes) const;
  [[nodiscard]] std::uint64_t table_end() const;  ///< bytes of header and table

  std::vector<SectionEntry> entries_;
  std::vector<const void*> contents_;  ///< beside entries_
  std::deque<std::vector<char>> kept_;
};

}  // namespace splatray::scene_file
