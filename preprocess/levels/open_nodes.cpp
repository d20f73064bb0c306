#include "preprocess/levels/open_nodes.h"

#include <numeric>

#include "preprocess/levels/level_means.h"
#include "preprocess/read/bytes/byte_reader.h"

namespace splatray {

void Records::append(std::span<const unsigned char> more) {
  const std::size_t stride = job.schema.record_bytes;
  bytes.insert(bytes.end(), more.begin(), more.end());
  for (std::size_t at = places.size() * stride; at + stride <= bytes.size(); at += stride)
    places.push_back(job.plan.lattice.place(job.schema.position(bytes.data() + at)));
}

std::vector<unsigned char> Records::of(const RecordNumbers& numbers) const {
  const std::size_t stride = job.schema.record_bytes;
  std::vector<unsigned char> some;
  some.reserve(numbers.size() * stride);
  for (const std::uint32_t number : numbers) {
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(number * stride);
    some.insert(some.end(), begin, begin + static_cast<std::ptrdiff_t>(stride));
  }
  return some;
}

std::vector<unsigned char> NodeWriter::means_of(std::uint32_t level, std::span<const unsigned char> records,
                                                const TileSchema& schema) const {
  std::vector<unsigned char> means;
  if (level > 0) append_means(records, schema, job_.plan.lattice, level - 1 + LEVEL_SPAN_BITS, means);
  return means;
}

OpenNode NodeWriter::above(std::uint32_t level, const glm::uvec3& cell, std::vector<OpenNode>& children) {
  Records records{job_, {}, {}};
  std::vector<RecordNumbers> sets;
  std::vector<unsigned char> means;
  for (const OpenNode& child : children) {
    const auto begin = static_cast<std::uint32_t>(records.places.size());
    records.append(child.records);
    sets.emplace_back(records.places.size() - begin);
    std::iota(sets.back().begin(), sets.back().end(), begin);
    means.insert(means.end(), child.means.begin(), child.means.end());
  }
  const RecordNumbers own = take_sample(records.places, level, sets);
  for (std::size_t i = 0; i < sets.size(); ++i) {
    children[i].records = records.of(sets[i]);
    write(children[i]);
  }
  return {level, cell, records.of(own), means_of(level, means, tile_means_schema(job_.schema)), {}};
}

void NodeWriter::write(const OpenNode& node) {
  const std::string name = node_name(node.level, node.cell);
  const std::filesystem::path file = folder_.node(name);
  write_records(node.records, file);
  std::uint64_t bytes = node.records.size();
  if (!node.rest.empty()) {
    ByteReader in(node.rest);
    bytes += in.remaining();
    while (in.remaining() > 0) write_records(in.read(ByteReader::BLOCK_BYTES), file, /*append=*/true);
  }
  built.points[name] = bytes / job_.schema.record_bytes;
  write_means(node);
}

void NodeWriter::write_means(const OpenNode& node) {
  if (node.level == 0) return;
  const std::string name = node_name(node.level, node.cell);
  write_records(node.means, folder_.means(name));
  built.means[name] = node.means.size() / tile_means_schema(job_.schema).record_bytes;
}

}  // namespace splatray
