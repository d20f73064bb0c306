#include "preprocess/levels/build_levels.h"

#include <algorithm>
#include <numeric>

#include "engine/base/error.h"
#include "preprocess/base/parallel.h"
#include "preprocess/levels/level_nodes.h"

namespace splatray {
namespace {

/// Records in memory, and where they lie.
struct Records {
  const LevelJob& job;
  std::vector<unsigned char> bytes;
  std::vector<glm::uvec3> places;

  void append(const std::vector<unsigned char>& more) {
    const std::size_t stride = job.schema.record_bytes;
    bytes.insert(bytes.end(), more.begin(), more.end());
    for (std::size_t at = places.size() * stride; at + stride <= bytes.size(); at += stride)
      places.push_back(job.plan.lattice.place(job.schema.position(bytes.data() + at)));
  }
  [[nodiscard]] std::vector<unsigned char> of(const RecordNumbers& numbers) const {
    const std::size_t stride = job.schema.record_bytes;
    std::vector<unsigned char> some;
    some.reserve(numbers.size() * stride);
    for (const std::uint32_t number : numbers) {
      const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(number * stride);
      some.insert(some.end(), begin, begin + static_cast<std::ptrdiff_t>(stride));
    }
    return some;
  }
};

/// A node above the parts or a part's top, with the records that it has until the node above it takes some.
struct Above {
  std::uint32_t level = 0;
  glm::uvec3 cell{0};
  std::vector<unsigned char> records;
};

class Joiner {
 public:
  Joiner(const LevelJob& job, const LevelFolder& folder, const Progress& progress)
      : job_(job), folder_(folder), progress_(progress) {
    for (std::size_t part = 0; part < job.plan.parts.size(); ++part) {
      const std::optional<NodeCounts> nodes = folder.nodes_of(part);
      if (!nodes)
        throw Error(ExitCode::usage, folder.ept_json().string() + ": found part " + std::to_string(part + 1) +
                                         " of " + std::to_string(job.plan.parts.size()) +
                                         " not built, expected all of them");
      counts_.insert(nodes->begin(), nodes->end());
    }
  }

  NodeCounts join() {
    std::vector<std::size_t> all(job_.plan.parts.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    write(make(0, glm::uvec3(0), all));
    return std::move(counts_);
  }

 private:
  /// The node that has these parts below it, or is the top of one.
  Above make(std::uint32_t level, const glm::uvec3& cell, std::span<const std::size_t> parts) {
    const LevelPart& first = job_.plan.parts[parts.front()];
    if (parts.size() == 1 && first.level == level) {
      Stage{"joining", progress_}.report(static_cast<double>(parts.front()) /
                                         static_cast<double>(job_.plan.parts.size()));
      return {level, cell, read_records(folder_.top(parts.front()))};
    }
    std::vector<Above> children;
    while (!parts.empty()) {
      const auto child_of = [&](std::size_t part) {
        const LevelPart& one = job_.plan.parts[part];
        return one.cell >> (one.level - level - 1);
      };
      const glm::uvec3 child = child_of(parts.front());
      const auto end =
          std::find_if(parts.begin(), parts.end(), [&](std::size_t part) { return child_of(part) != child; });
      const auto count = static_cast<std::size_t>(end - parts.begin());
      children.push_back(make(level + 1, child, parts.first(count)));
      parts = parts.subspan(count);
    }
    return thin(level, cell, children);
  }

  /// Takes the node's sample from its children, which are written.
  Above thin(std::uint32_t level, const glm::uvec3& cell, std::vector<Above>& children) {
    Records records{job_, {}, {}};
    std::vector<RecordNumbers> sets;
    for (const Above& child : children) {
      const auto begin = static_cast<std::uint32_t>(records.places.size());
      records.append(child.records);
      sets.emplace_back(records.places.size() - begin);
      std::iota(sets.back().begin(), sets.back().end(), begin);
    }
    const RecordNumbers own = take_sample(records.places, level, sets);
    for (std::size_t i = 0; i < sets.size(); ++i) {
      children[i].records = records.of(sets[i]);
      write(children[i]);
    }
    return {level, cell, records.of(own)};
  }

  void write(const Above& node) {
    const std::string name = node_name(node.level, node.cell);
    write_records(node.records, folder_.node(name));
    counts_[name] = node.records.size() / job_.schema.record_bytes;
  }

  const LevelJob& job_;
  const LevelFolder& folder_;
  const Progress& progress_;
  NodeCounts counts_;
};

}  // namespace

void build_part(const LevelJob& job, std::size_t part, const LevelFolder& folder) {
  if (folder.nodes_of(part)) return;
  Records records{job, {}, {}};
  records.append(read_records(folder.records(part)));
  const LevelPart& top = job.plan.parts[part];
  if (records.places.size() != top.points)
    throw Error(ExitCode::input_unreadable,
                folder.records(part).string() + ": found " + std::to_string(records.places.size()) +
                    " points, expected the " + std::to_string(top.points) + " that were counted");
  NodeCounts nodes;
  build_level_nodes(records.places, top, [&](const LevelPart& node, const RecordNumbers& own) {
    const bool is_top = node.level == top.level;
    const std::string name = node_name(node.level, node.cell);
    write_records(records.of(own), is_top ? folder.top(part) : folder.node(name));
    nodes[name] = node.points;
  });
  folder.keep(part, nodes);
  std::error_code error;
  std::filesystem::remove(folder.records(part), error);
}

NodeCounts join_parts(const LevelJob& job, const LevelFolder& folder, const Progress& progress) {
  return Joiner(job, folder, progress).join();
}

}  // namespace splatray
