#include "tests/fuzz/scene_form.h"

#include <algorithm>
#include <iterator>
#include <vector>

namespace splatray::testing {
namespace {

constexpr std::size_t ALIGNMENT = 16;
constexpr std::size_t OLD_HEAD = 1760, OLD_SECTIONS = (OLD_HEAD - OLD.begin) / OLD.entry;
constexpr std::size_t COLUMN_TYPES = 248;  ///< offset in the old header
constexpr std::size_t OLD_COLUMNS = 32, FIRST_COLUMN = OLD_SECTIONS - OLD_COLUMNS;
constexpr std::uint32_t COLUMN_BYTES[] = {0, 1, 2, 4, 8};  ///< by type

/// Cuts a count of the header to what the bytes have room for. Returns it.
template <typename T>
std::size_t cut_count(Bytes& bytes, std::size_t offset, std::size_t element) {
  const T count = get<T>(bytes, offset) % static_cast<T>(bytes.size() / element + 1);
  put(bytes, offset, count);
  return count;
}

/// Cuts a word of flags to `mask`. Returns it.
std::uint32_t cut_flags(Bytes& bytes, std::size_t offset, std::uint32_t mask) {
  put(bytes, offset, get<std::uint32_t>(bytes, offset) & mask);
  return get<std::uint32_t>(bytes, offset);
}

/// The elements of each old section, after the counts and flags have been cut.
std::vector<std::size_t> cut_counts(Bytes& bytes) {
  const std::size_t splats = cut_count<std::uint64_t>(bytes, 32, 16);
  const std::size_t references = cut_count<std::uint64_t>(bytes, 40, 4);
  const std::size_t nodes = cut_count<std::uint64_t>(bytes, 48, 4);
  const std::size_t leaves = cut_count<std::uint64_t>(bytes, 56, 4);
  const std::size_t objects = cut_count<std::uint32_t>(bytes, 64, 48);
  const std::size_t lights = cut_count<std::uint32_t>(bytes, 68, 48);
  const std::uint32_t attributes = cut_flags(bytes, 72, 7);
  const std::size_t cameras = cut_flags(bytes, 76, 1);
  const std::size_t strings = cut_count<std::uint64_t>(bytes, 80, 1);
  const std::size_t stations = cut_count<std::uint32_t>(bytes, 240, 40);
  const std::size_t surfaces = cut_count<std::uint32_t>(bytes, 244, 80);
  const std::size_t colors = (attributes & 1U) != 0 ? splats : 0;
  const std::size_t fields = (attributes & 2U) != 0 ? splats : 0;
  const std::size_t clips = (attributes & 4U) != 0 ? splats : 0;
  std::vector<std::size_t> counts{nodes, leaves + 1, leaves, references, splats,   colors,  fields,
                                  clips, objects,    lights, cameras,    stations, strings, surfaces};
  for (std::size_t i = 0; i < OLD_COLUMNS; ++i) {
    const auto type = get<std::uint8_t>(bytes, COLUMN_TYPES + i) % std::size(COLUMN_BYTES);
    put(bytes, COLUMN_TYPES + i, static_cast<std::uint8_t>(type));
    counts.push_back(type == 0 ? 0 : splats);
  }
  return counts;
}

/// Bytes that a section of version 15 is long: what its entry says, cut to what there is room for; what lies beside the splats, or
/// one for each leaf, is as long as the data pool or the pool of slabs asks for, or empty.
std::size_t cut_bytes(const Bytes& bytes, std::size_t entry) {
  const std::string name = bytes.data() + entry;
  const auto said = [&](std::size_t at) {
    const std::size_t element = get<std::uint32_t>(bytes, at + 28);
    return get<std::uint64_t>(bytes, at + NAMED.place + 8) % (bytes.size() + 1) / element;
  };
  const auto beside = [&](const char* pool) { return said(entry_of(bytes, pool)); };
  std::size_t count = said(entry);
  if (name == "begin_end") count = beside("slab_pool") + 1;
  if (name.starts_with("column.") || name == "color_pool" || name == "field_pool" || name == "clip_pool")
    count = count == 0 ? 0 : beside("data_pool");
  return count * get<std::uint32_t>(bytes, entry + 28);
}

/// Appends to a form: sections at aligned places, what lies there already being their content.
class Layout {
 public:
  Layout(Bytes& bytes, std::size_t end) : bytes_(bytes), end_(end) {}

  /// Where `size` bytes begin; the gap before is zero.
  std::size_t place(std::size_t size) {
    const std::size_t aligned = (end_ + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    bytes_.resize(std::max(bytes_.size(), aligned + size));
    bytes_.replace(end_, aligned - end_, aligned - end_, '\0');
    end_ = aligned + size;
    return aligned;
  }

  /// Places a section and writes that into its entry.
  void place(std::size_t size, std::size_t entry_place) {
    put<std::uint64_t>(bytes_, entry_place, place(size));
    put<std::uint64_t>(bytes_, entry_place + 8, size);
  }

  /// Ends the file as a good one ends.
  void end(const Bytes& good) {
    const Bytes marker = good.substr(good.size() - 8);
    bytes_.resize(place(marker.size()));
    bytes_ += marker;
    put<std::uint64_t>(bytes_, 16, bytes_.size());
  }

 private:
  Bytes& bytes_;
  std::size_t end_;
};

}  // namespace

Bytes with_form(Bytes bytes, const Bytes& good) {
  bytes.resize(std::max(bytes.size(), head_bytes(good)));
  bytes.replace(0, NAMED.begin, good, 0, NAMED.begin);
  for (std::size_t entry = NAMED.begin; entry < head_bytes(good); entry += NAMED.entry)
    bytes.replace(entry, NAMED.place, good, entry, NAMED.place);
  std::vector<std::size_t> sizes;
  for (std::size_t entry = NAMED.begin; entry < head_bytes(good); entry += NAMED.entry)
    sizes.push_back(cut_bytes(bytes, entry));
  Layout layout(bytes, head_bytes(good));
  for (std::size_t i = 0; i < sizes.size(); ++i)
    layout.place(sizes[i], NAMED.begin + i * NAMED.entry + NAMED.place);
  layout.end(good);
  reseal(bytes);
  return bytes;
}

Bytes with_old_form(Bytes bytes, const Bytes& good) {
  bytes.resize(std::max(bytes.size(), OLD_HEAD));
  bytes.replace(0, 16, good, 0, 16);
  bytes.replace(OLD.begin - 8, 8, good, OLD.begin - 8, 8);
  const std::vector<std::size_t> counts = cut_counts(bytes);
  Layout layout(bytes, OLD_HEAD);
  for (std::size_t i = 0; i < OLD_SECTIONS; ++i) {
    const std::size_t entry = OLD.begin + i * OLD.entry;
    bytes.replace(entry, 8, good, entry, 8);
    if (i >= FIRST_COLUMN)
      put(bytes, entry + 4, COLUMN_BYTES[get<std::uint8_t>(bytes, COLUMN_TYPES + i - FIRST_COLUMN)]);
    layout.place(counts.at(i) * get<std::uint32_t>(bytes, entry + 4), entry + OLD.place);
  }
  layout.end(good);
  reseal(bytes, OLD);
  return bytes;
}

}  // namespace splatray::testing
