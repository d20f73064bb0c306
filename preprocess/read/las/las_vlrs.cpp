#include "preprocess/read/las/las_vlrs.h"

#include <algorithm>
#include <cstring>
#include <string_view>

#include "engine/base/utf8.h"
#include "preprocess/base/little_endian.h"

namespace splatray {
namespace {

constexpr std::size_t USER_BYTES = 16;
constexpr std::size_t VLR_HEAD_BYTES = 54;       ///< of a record between header and points
constexpr std::size_t HEAD_BYTES_EXTENDED = 60;  ///< of one behind the points, with a 64-bit length
constexpr std::uint64_t MOST_CONTENT_BYTES = ByteReader::BLOCK_BYTES;  ///< of records that are of use

struct Head {
  std::string user;
  unsigned id = 0;
  std::uint64_t bytes = 0;
};

Head load_head(const unsigned char* bytes, bool is_extended) {
  const std::string_view user(reinterpret_cast<const char*>(bytes + 2), USER_BYTES);
  return {std::string(user.substr(0, user.find('\0'))), load<std::uint16_t>(bytes + 18),
          is_extended ? load<std::uint64_t>(bytes + 20) : load<std::uint16_t>(bytes + 20)};
}

void keep(LasVlrs& vlrs, const Head& head, const unsigned char* content) {
  constexpr unsigned LASZIP = 22204;
  constexpr unsigned GEO_KEYS = 34735;
  constexpr unsigned WKT = 2112;
  constexpr unsigned EXTRA_BYTES = 4;
  constexpr unsigned COPC_INFO = 1;
  const unsigned char* const end = content + head.bytes;
  if (head.user == "laszip encoded" && head.id == LASZIP) {
    vlrs.laszip.assign(content, end);
  } else if (head.user == "copc" && head.id == COPC_INFO) {
    vlrs.copc_info.assign(content, end);
  } else if (head.user == "LASF_Projection" && head.id == GEO_KEYS) {
    vlrs.geo_keys.assign(content, end);
  } else if (head.user == "LASF_Projection" && head.id == WKT) {
    vlrs.wkt = to_utf8({reinterpret_cast<const char*>(content),
                        static_cast<std::size_t>(std::find(content, end, '\0') - content)});
  } else if (head.user == "LASF_Spec" && head.id == EXTRA_BYTES &&
             vlrs.extra_bytes.size() + head.bytes <= MOST_CONTENT_BYTES) {
    vlrs.extra_bytes.insert(vlrs.extra_bytes.end(), content, end);
  }
}

/// Reads `count` records from where the file stands, none of them beyond `end`.
void read_records(ByteReader& in, std::uint32_t count, bool is_extended, std::uint64_t end, LasVlrs& vlrs) {
  const std::size_t head_bytes = is_extended ? HEAD_BYTES_EXTENDED : VLR_HEAD_BYTES;
  for (std::uint32_t i = 0; i < count && in.offset() + head_bytes <= end; ++i) {
    const unsigned char* bytes = in.take(head_bytes);
    if (bytes == nullptr) return;
    const Head head = load_head(bytes, is_extended);
    if (head.bytes > end - in.offset()) return;
    if (head.bytes > MOST_CONTENT_BYTES) {
      in.seek(in.offset() + head.bytes);
      continue;
    }
    const unsigned char* content = in.take(static_cast<std::size_t>(head.bytes));
    if (content == nullptr) return;
    keep(vlrs, head, content);
  }
}

}  // namespace

LasVlrs read_las_vlrs(ByteReader& in, const LasHeader& header) {
  LasVlrs vlrs;
  in.seek(0);
  const std::uint64_t size = in.remaining();
  if (header.header_bytes <= size) {
    in.seek(header.header_bytes);
    read_records(in, header.vlr_count, false, header.points_offset, vlrs);
  }
  if (header.evlr_offset != 0 && header.evlr_offset <= size) {
    in.seek(header.evlr_offset);
    read_records(in, header.evlr_count, true, size, vlrs);
  }
  return vlrs;
}

}  // namespace splatray
