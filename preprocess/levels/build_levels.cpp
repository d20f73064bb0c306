#include "preprocess/levels/build_levels.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include "engine/base/error.h"
#include "preprocess/base/morton.h"
#include "preprocess/base/parallel.h"
#include "preprocess/levels/open_nodes.h"
#include "preprocess/read/bytes/byte_reader.h"

namespace splatray {
namespace {

/// The means of nodes that are built in memory, from those below on.
class MeansBelow {
 public:
  explicit MeansBelow(const NodeWriter& writer, const TileSchema& schema)
      : writer_(writer), schema_(schema), means_schema_(tile_means_schema(schema)) {}

  /// A node that is not divided, by all that lies in it.
  void add(const LevelPart& node, std::span<const unsigned char> records) {
    of_whole_[node_name(node.level, node.cell)] = writer_.means_of(node.level, records, schema_);
  }

  /// Those of a node, once each below it has been asked for.
  std::vector<unsigned char> take(const LevelPart& node) {
    const std::string name = node_name(node.level, node.cell);
    std::vector<unsigned char> means;
    if (const auto whole = of_whole_.extract(name))
      means = std::move(whole.mapped());
    else
      means = writer_.means_of(node.level, below_.extract(name).mapped(), means_schema_);
    if (node.level > 0) {
      std::vector<unsigned char>& above = below_[node_name(node.level - 1, node.cell >> 1U)];
      above.insert(above.end(), means.begin(), means.end());
    }
    return means;
  }

 private:
  const NodeWriter& writer_;
  const TileSchema& schema_;
  const TileSchema means_schema_;
  std::map<std::string, std::vector<unsigned char>> of_whole_, below_;
};

/// Builds the nodes of a part from the file of its records.
class PartBuilder {
 public:
  PartBuilder(const LevelJob& job, std::size_t part, std::uint64_t most_points, const LevelFolder& folder)
      : job_(job), part_(part), most_points_(most_points), folder_(folder), writer_(job, folder) {}

  void build() {
    const std::filesystem::path file = folder_.records(part_);
    const LevelPart& top = job_.plan.parts[part_];
    const std::uint64_t points = std::filesystem::file_size(file) / job_.schema.record_bytes;
    if (points != top.points)
      throw Error(ExitCode::input_unreadable, file.string() + ": found " + std::to_string(points) +
                                                  " points, expected the " + std::to_string(top.points) +
                                                  " that were counted");
    const OpenNode node = build(top, file);
    write_records(node.records, folder_.top(part_));
    if (!node.rest.empty()) std::filesystem::rename(node.rest, folder_.rest(part_));
    writer_.write_means(node);
    folder_.keep(part_, writer_.built);
    std::error_code error;
    std::filesystem::remove(file, error);
  }

 private:
  /// Builds what is below a node, all of whose records are in a file.
  OpenNode build(const LevelPart& top, const std::filesystem::path& file) {
    if (top.points <= most_points_) return build_in_memory(top, file);
    if (top.level == MOST_LEVEL) return build_undivided(top, file);
    std::vector<OpenNode> children;
    for (const LevelPart& child : divide(top, file)) {
      const std::filesystem::path records = records_of(child);
      children.push_back(build(child, records));
      std::filesystem::remove(records);
    }
    return writer_.above(top.level, top.cell, children);
  }

  OpenNode build_in_memory(const LevelPart& top, const std::filesystem::path& file) {
    Records records{job_, {}, {}};
    records.append(read_records(file));
    MeansBelow means(writer_, job_.schema);
    OpenNode made;
    const auto whole = [&](const LevelPart& node, const RecordNumbers& all) {
      means.add(node, records.of(all));
    };
    const auto built = [&](const LevelPart& node, const RecordNumbers& own) {
      OpenNode open{node.level, node.cell, records.of(own), means.take(node), {}};
      if (node.level == top.level)
        made = std::move(open);
      else
        writer_.write(open);
    };
    build_level_nodes(records.places, top, {whole, built});
    return made;
  }

  /// A node that has room for no smaller ones, and more points than are built at once: what is more stays in a file.
  OpenNode build_undivided(const LevelPart& top, const std::filesystem::path& file) {
    ByteReader in(file);
    const std::vector<unsigned char> first = in.read(most_points_ * job_.schema.record_bytes);
    OpenNode node{top.level, top.cell, first, writer_.means_of(top.level, first, job_.schema),
                  folder_.records(part_, "rest-" + node_name(top.level, top.cell))};
    write_records({}, node.rest);
    while (in.remaining() > 0) write_records(in.read(ByteReader::BLOCK_BYTES), node.rest, /*append=*/true);
    return node;
  }

  [[nodiscard]] std::filesystem::path records_of(const LevelPart& node) const {
    return folder_.records(part_, node_name(node.level, node.cell));
  }

  /// Divides a file of records among the octants of its node that have some, whose files are made anew.
  [[nodiscard]] std::vector<LevelPart> divide(const LevelPart& top, const std::filesystem::path& file) const {
    const std::size_t stride = job_.schema.record_bytes;
    std::array<LevelPart, 8> octants;
    for (std::uint32_t i = 0; i < octants.size(); ++i)
      octants[i] = {top.level + 1, (top.cell << 1U) + morton_point(i), 0};
    ByteReader in(file);
    while (in.remaining() > 0) {
      const std::vector<unsigned char> some = in.read(ByteReader::BLOCK_BYTES / stride * stride);
      std::array<std::vector<unsigned char>, 8> parts;
      for (auto record = some.begin(); record != some.end(); record += static_cast<std::ptrdiff_t>(stride)) {
        const glm::uvec3 place = job_.plan.lattice.place(job_.schema.position(&*record));
        std::vector<unsigned char>& part = parts[morton_key(LevelLattice::cell(place, top.level + 1) & 1U)];
        part.insert(part.end(), record, record + static_cast<std::ptrdiff_t>(stride));
      }
      for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i].empty()) continue;
        write_records(parts[i], records_of(octants[i]), /*append=*/octants[i].points > 0);
        octants[i].points += parts[i].size() / stride;
      }
    }
    std::vector<LevelPart> filled;
    std::copy_if(octants.begin(), octants.end(), std::back_inserter(filled),
                 [](const LevelPart& octant) { return octant.points > 0; });
    return filled;
  }

  const LevelJob& job_;
  const std::size_t part_;
  const std::uint64_t most_points_;
  const LevelFolder& folder_;
  NodeWriter writer_;
};

class Joiner {
 public:
  Joiner(const LevelJob& job, const LevelFolder& folder, const Progress& progress)
      : job_(job), folder_(folder), progress_(progress), writer_(job, folder) {
    for (std::size_t part = 0; part < job.plan.parts.size(); ++part) {
      const std::optional<BuiltNodes> nodes = folder.nodes_of(part);
      if (!nodes)
        throw Error(ExitCode::usage, folder.ept_json().string() + ": found part " + std::to_string(part + 1) +
                                         " of " + std::to_string(job.plan.parts.size()) +
                                         " not built, expected all of them");
      writer_.built.add(*nodes);
    }
  }

  BuiltNodes join() {
    std::vector<std::size_t> all(job_.plan.parts.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    writer_.write(make(0, glm::uvec3(0), all));
    return std::move(writer_.built);
  }

 private:
  /// The node that has these parts below it, or is the top of one.
  OpenNode make(std::uint32_t level, const glm::uvec3& cell, std::span<const std::size_t> parts) {
    const LevelPart& first = job_.plan.parts[parts.front()];
    if (parts.size() == 1 && first.level == level) {
      Stage{"joining", progress_}.report(static_cast<double>(parts.front()) /
                                         static_cast<double>(job_.plan.parts.size()));
      return top_of(parts.front());
    }
    std::vector<OpenNode> children;
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
    return writer_.above(level, cell, children);
  }

  [[nodiscard]] OpenNode top_of(std::size_t part) const {
    const LevelPart& top = job_.plan.parts[part];
    OpenNode node{top.level, top.cell, read_records(folder_.top(part)), {}, {}};
    if (top.level > 0) node.means = read_records(folder_.means(node_name(top.level, top.cell)));
    if (std::filesystem::exists(folder_.rest(part))) node.rest = folder_.rest(part);
    return node;
  }

  const LevelJob& job_;
  const LevelFolder& folder_;
  const Progress& progress_;
  NodeWriter writer_;
};

}  // namespace

void build_part(const LevelJob& job, std::size_t part, std::uint64_t most_points, const LevelFolder& folder) {
  if (!folder.nodes_of(part)) PartBuilder(job, part, most_points, folder).build();
}

BuiltNodes join_parts(const LevelJob& job, const LevelFolder& folder, const Progress& progress) {
  return Joiner(job, folder, progress).join();
}

}  // namespace splatray
