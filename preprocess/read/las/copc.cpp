#include "preprocess/read/las/copc.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "preprocess/base/little_endian.h"
#include "preprocess/read/las/las_units.h"

namespace splatray {
namespace {

constexpr std::size_t NODE_ENTRY_BYTES = 32;
constexpr std::int32_t IS_PAGE = -1;  ///< instead of a count: more of the directory lies there

struct Page {
  std::uint64_t offset = 0, bytes = 0;
};

/// The content of COPC's info record.
struct Info {
  glm::dvec3 center{0.0};
  double half_edge = 0.0;
  Page root;
};

Info info_of(const std::vector<unsigned char>& record) {
  const auto number = [&](std::size_t at) { return load<double>(record.data() + 8 * at); };
  return {{number(0), number(1), number(2)},
          number(3),
          {load<std::uint64_t>(record.data() + 40), load<std::uint64_t>(record.data() + 48)}};
}

class DirectoryReader {
 public:
  DirectoryReader(ByteReader& in, const LasHeader& header) : in_(in), header_(header) {
    in_.seek(0);
    size_ = in_.remaining();
  }

  std::vector<LevelNode> read(const Page& root) {
    pages_ = {root};
    while (!pages_.empty()) {
      const Page page = pages_.back();
      pages_.pop_back();
      read_page(page);
    }
    link();
    return std::move(nodes_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw_unreadable(in_.path(), "found in its COPC directory " + what + " (--lod 0 does without it)");
  }

  [[nodiscard]] bool lies_in_file(std::uint64_t offset, std::uint64_t bytes) const {
    return offset >= header_.header_bytes && offset <= size_ && bytes <= size_ - offset;
  }

  void read_page(const Page& page) {
    if (!lies_in_file(page.offset, page.bytes) || page.bytes % NODE_ENTRY_BYTES != 0)
      refuse("a page of " + std::to_string(page.bytes) + " bytes at " + std::to_string(page.offset) +
             ", expected whole entries within the file's " + std::to_string(size_) + " bytes");
    if (!seen_.insert(page.offset).second)
      refuse("the page at " + std::to_string(page.offset) + " twice, expected each once");
    in_.seek(page.offset);
    for (std::uint64_t left = page.bytes; left > 0; left -= NODE_ENTRY_BYTES) {
      const unsigned char* entry = in_.take(NODE_ENTRY_BYTES);
      if (entry == nullptr) throw_unreadable(in_.path(), "it could not be read to its end");
      add_entry(entry);
    }
  }

  void add_entry(const unsigned char* entry) {
    const auto offset = load<std::uint64_t>(entry + 16);
    const auto bytes = load<std::int32_t>(entry + 24), points = load<std::int32_t>(entry + 28);
    if (bytes < 0 || points < IS_PAGE) refuse("a count below 0");
    if (points == IS_PAGE) return pages_.push_back({offset, static_cast<std::uint64_t>(bytes)});
    const auto key = [&](std::size_t i) { return load<std::uint32_t>(entry + 4 * i); };
    const LevelNode node{
        key(0), {key(1), key(2), key(3)},         LevelNode::NO_PARENT, static_cast<std::uint64_t>(points),
        offset, static_cast<std::uint64_t>(bytes)};
    if (!node.lies_in_octree())
      refuse("a cube beside the octree: level " + std::to_string(node.level) + ", place " +
             std::to_string(node.cell.x) + "," + std::to_string(node.cell.y) + "," +
             std::to_string(node.cell.z));
    if (points > 0 && !lies_in_file(offset, static_cast<std::uint64_t>(bytes)))
      refuse("points at " + std::to_string(offset) + ", expected them within the file's " +
             std::to_string(size_) + " bytes");
    nodes_.push_back(node);
  }

  void link() {
    if (const auto fault = link_levels(nodes_)) refuse(*fault);
    std::uint64_t points = 0;
    for (const LevelNode& node : nodes_) points += node.points;
    if (points > header_.point_count)
      refuse("more points than the " + std::to_string(header_.point_count) + " that the header counts");
  }

  ByteReader& in_;
  const LasHeader& header_;
  std::uint64_t size_ = 0;
  std::vector<Page> pages_;
  std::set<std::uint64_t> seen_;
  std::vector<LevelNode> nodes_;
};

}  // namespace

Levels read_copc(ByteReader& in, const LasHeader& header, const LasVlrs& vlrs) {
  constexpr std::size_t INFO_BYTES = 160;
  if (vlrs.copc_info.size() < INFO_BYTES || !header.is_compressed) return {};
  const Info info = info_of(vlrs.copc_info);
  if (!(info.half_edge > 0.0) || !std::isfinite(info.half_edge + glm::dot(info.center, glm::dvec3(1.0))))
    throw_unreadable(in.path(), "found a COPC octree without a size, expected a positive one");
  return {info.center - info.half_edge, 2.0 * info.half_edge, DirectoryReader(in, header).read(info.root)};
}

Levels copc_levels(const std::filesystem::path& path) {
  ByteReader in(path);
  const LasHeader header = read_las_header(in);
  const LasVlrs vlrs = read_las_vlrs(in, header);
  // Degrees become metres when the points are there.
  return las_in_degrees(vlrs).value_or(false) ? Levels{} : read_copc(in, header, vlrs);
}

std::vector<LazChunk> chunks_of(const Levels& levels, const std::vector<std::uint32_t>& nodes) {
  std::vector<LazChunk> chunks;
  for (const std::uint32_t i : nodes) {
    const LevelNode& node = levels.nodes[i];
    if (node.points > 0) chunks.push_back({node.offset, node.bytes, node.points, false});
  }
  std::sort(chunks.begin(), chunks.end(),
            [](const LazChunk& a, const LazChunk& b) { return a.offset < b.offset; });
  return chunks;
}

}  // namespace splatray
