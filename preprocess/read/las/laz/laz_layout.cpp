#include "preprocess/read/las/laz/laz_layout.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "preprocess/base/little_endian.h"

namespace splatray {
namespace {

using Kind = LazItem::Kind;

struct KnownItem {
  Kind kind;
  std::size_t size;  ///< 0 = any
  unsigned first_version;
  unsigned last_version;
  bool is_layered;
};

/// Version 2 of layered items is an early 3, that of wave packets what laz-rs calls 1.
constexpr KnownItem KNOWN[] = {
    {Kind::point10, 20, 1, 2, false},     {Kind::gps_time11, 8, 1, 2, false},
    {Kind::rgb12, 6, 1, 2, false},        {Kind::wavepacket13, 29, 1, 2, false},
    {Kind::bytes, 0, 1, 2, false},        {Kind::point14, 30, 2, 4, true},
    {Kind::rgb14, 6, 2, 4, true},         {Kind::rgbnir14, 8, 2, 4, true},
    {Kind::wavepacket14, 29, 3, 4, true}, {Kind::bytes14, 0, 2, 4, true},
};

bool is_known(const LazItem& item, bool is_layered) {
  return std::any_of(std::begin(KNOWN), std::end(KNOWN), [&](const KnownItem& known) {
    return known.kind == item.kind && known.is_layered == is_layered && item.size > 0 &&
           (known.size == 0 || known.size == item.size) && item.version >= known.first_version &&
           item.version <= known.last_version;
  });
}

/// Reads the items and checks that they make up a record, with the position first.
void read_items(std::span<const unsigned char> record, LazLayout& layout, const std::filesystem::path& path) {
  constexpr std::size_t ITEMS_AT = 34;
  constexpr std::size_t ITEM_BYTES = 6;
  const std::size_t count = load<std::uint16_t>(record.data() + ITEMS_AT - 2);
  if (count == 0 || record.size() < ITEMS_AT + ITEM_BYTES * count)
    throw_unreadable(path, "found " + std::to_string(count) + " items in " + std::to_string(record.size()) +
                               " bytes of LASzip's record");
  std::size_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const unsigned char* bytes = record.data() + ITEMS_AT + ITEM_BYTES * i;
    const LazItem item{Kind{load<std::uint16_t>(bytes)}, load<std::uint16_t>(bytes + 2),
                       load<std::uint16_t>(bytes + 4), at};
    if (!is_known(item, layout.is_layered) ||
        (i == 0) != (item.kind == Kind::point10 || item.kind == Kind::point14))
      throw_unreadable(path, "found LASzip item " + std::to_string(load<std::uint16_t>(bytes)) + " of " +
                                 std::to_string(item.size) + " bytes and version " +
                                 std::to_string(item.version) + " in place " + std::to_string(i) +
                                 ", expected one of LASzip 1.0 to 3.5");
    layout.items.push_back(item);
    at += item.size;
  }
  if (at != layout.record_bytes)
    throw_unreadable(path, "found LASzip items of " + std::to_string(at) + " bytes, expected the records' " +
                               std::to_string(layout.record_bytes));
}

}  // namespace

LazLayout read_laz_layout(std::span<const unsigned char> record, const LasHeader& header,
                          const std::filesystem::path& path) {
  constexpr std::size_t FIXED_BYTES = 34;
  constexpr unsigned POINTWISE = 1;
  constexpr unsigned LAYERED_CHUNKED = 3;
  constexpr std::uint32_t CHUNKS_OF_ANY_SIZE = 0xFFFFFFFF;
  if (record.size() < FIXED_BYTES)
    throw_unreadable(path, "found compressed points without LASzip's record, expected one before the points");
  const unsigned compressor = load<std::uint16_t>(record.data());
  const unsigned coder = load<std::uint16_t>(record.data() + 2);
  if (compressor < POINTWISE || compressor > LAYERED_CHUNKED || coder != 0)
    throw_unreadable(path, "found LASzip compressor " + std::to_string(compressor) + " and coder " +
                               std::to_string(coder) + ", expected 1 to 3 and 0");
  LazLayout layout;
  layout.is_layered = compressor == LAYERED_CHUNKED;
  layout.is_chunked = compressor != POINTWISE;
  layout.chunk_points = load<std::uint32_t>(record.data() + 12);
  layout.has_equal_chunks = layout.chunk_points != CHUNKS_OF_ANY_SIZE;
  layout.record_bytes = header.record_bytes;
  if (layout.is_chunked && layout.chunk_points == 0) throw_unreadable(path, "found chunks of 0 points");
  read_items(record, layout, path);
  return layout;
}

}  // namespace splatray
