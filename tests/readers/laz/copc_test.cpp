/// COPC files: what is read of their nodes beside the whole file, and damaged directories.
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <iterator>

#include "preprocess/read/las/copc.h"
#include "preprocess/read/las/las_header.h"
#include "preprocess/read/las/las_vlrs.h"
#include "preprocess/read/las/laz/laz_layout.h"
#include "preprocess/read/las/read_las.h"
#include "tests/readers/laz/copc_file.h"
#include "tests/temp_folder.h"

namespace splatray {
namespace {

constexpr double EDGE = 64.0;

class Copc : public ::testing::Test {
 protected:
  Copc() {
    const std::filesystem::path source = std::filesystem::path(CORPUS) / "las" / "pf8_items_v3.laz";
    std::ifstream stream(source, std::ios::binary);
    laz = {std::istreambuf_iterator<char>(stream), {}};
    ByteReader in(source);
    const LasHeader header = read_las_header(in);
    const LazLayout layout = read_laz_layout(read_las_vlrs(in, header).laszip, header, source);
    chunks = find_laz_chunks(in, header, layout).value();
  }

  /// The chunk as a node of this key.
  [[nodiscard]] CopcEntry node(std::array<std::int32_t, 4> key, std::size_t chunk) const {
    return {key, chunks[chunk].offset + COPC_INFO_BYTES, static_cast<std::int32_t>(chunks[chunk].bytes),
            static_cast<std::int32_t>(chunks[chunk].points)};
  }

  /// The root, a child, and its child beside a node without points.
  [[nodiscard]] std::vector<CopcEntry> entries() const {
    return {node({2, 0, 3, 2}, 2), node({0, 0, 0, 0}, 0), {{1, 1, 1, 1}, 0, 0, 0}, node({1, 0, 1, 1}, 1)};
  }

  std::filesystem::path write(const std::vector<CopcEntry>& entries) {
    return folder.write("a.copc.laz", copc_of(laz, -1.0, EDGE, entries));
  }

  static ScanFile read(const std::filesystem::path& path, const ChosenNodes& nodes = {},
                       std::size_t notes_expected = 0) {
    ReadOptions options;
    options.scans.keep_withheld = true;
    options.nodes = nodes;
    std::vector<std::string> notes;
    ScanFile file = read_las(path, options, {notes, options.progress});
    EXPECT_EQ(notes.size(), notes_expected) << path;
    return file;
  }

  /// The sentence that reading the directory ends in.
  static std::string refusal(const std::filesystem::path& path) {
    try {
      static_cast<void>(copc_levels(path));
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::input_unreadable);
      return error.what();
    }
    return "";
  }

  const TempFolder folder;
  std::string laz;
  std::vector<LazChunk> chunks;
};

TEST_F(Copc, TheDirectoryIsAnOctree) {
  const Levels levels = copc_levels(write(entries()));
  ASSERT_EQ(levels.nodes.size(), 4U);
  EXPECT_EQ(levels.points(), 40U);
  EXPECT_EQ(levels.depth(), 3U);
  EXPECT_EQ(levels.low, glm::dvec3(-1.0));
  EXPECT_EQ(levels.edge, EDGE);
  EXPECT_EQ(levels.nodes[0].parent, LevelNode::NO_PARENT);
  EXPECT_EQ(levels.nodes[1].cell, glm::uvec3(0, 1, 1));
  EXPECT_EQ(levels.nodes[2].points, 0U);
  EXPECT_EQ(levels.nodes[3].parent, 1U);
  EXPECT_EQ(first_levels(levels, 20), std::vector<std::uint32_t>{0});
  EXPECT_EQ(first_levels(levels, 21), (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_TRUE(copc_levels(folder.write("plain.laz", laz)).nodes.empty());
}

TEST_F(Copc, NodesAreTheirPartOfTheFile) {
  const std::filesystem::path path = write(entries());
  const Points whole = read(path).points;
  ASSERT_EQ(whole.size(), 40U);
  EXPECT_EQ(read(path, {{path, {0, 1, 2, 3}}}).points.position, whole.position);
  const ScanFile some = read(path, {{path, {0, 3}}});
  EXPECT_EQ(some.counts.stored, 39U);
  EXPECT_EQ(some.counts.missing, 0U);
  std::vector<glm::dvec3> expected(whole.position.begin(), whole.position.begin() + 20);
  expected.insert(expected.end(), whole.position.begin() + 21, whole.position.end());
  EXPECT_EQ(some.points.position, expected);
}

/// A file may be replaced between the look at its directory and the reading.
TEST_F(Copc, NodesThatAreNoLongerThereAreASentence) {
  const std::filesystem::path path = write(entries());
  ReadOptions options;
  options.nodes = {{path, {0, 4}}};
  std::vector<std::string> notes;
  try {
    static_cast<void>(read_las(path, options, {notes, options.progress}));
    FAIL() << "a node beyond the directory was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::input_unreadable);
    EXPECT_NE(std::string(error.what()).find("found 4 nodes in its directory"), std::string::npos)
        << error.what();
  }
}

TEST_F(Copc, PagesMayLieInPages) {
  std::string file = copc_of(laz, 0.0, EDGE, {node({0, 0, 0, 0}, 0), {{1, 0, 0, 0}, 0, 64, -1}});
  const std::string more = copc_of(laz, 0.0, EDGE, {node({1, 0, 0, 0}, 1), node({2, 1, 0, 1}, 2)});
  put_number(file, file.size() - 16, std::uint64_t{file.size()});
  file += more.substr(more.size() - 64);
  EXPECT_EQ(copc_levels(folder.write("a.copc.laz", file)).points(), 40U);
}

TEST_F(Copc, DamagedDirectoriesAreASentence) {
  const auto changed = [&](std::size_t i, const std::function<void(CopcEntry&)>& change) {
    std::vector<CopcEntry> all = entries();
    change(all[i]);
    return all;
  };
  std::vector<CopcEntry> twice = entries(), circle = entries();
  twice.push_back(twice.front());
  const std::uint64_t page = copc_of(laz, 0.0, EDGE, {}).size();
  circle.push_back({{3, 0, 0, 0}, page, 32 * 5, -1});
  const std::pair<std::vector<CopcEntry>, const char*> cases[] = {
      {changed(0, [](CopcEntry& entry) { entry.points = -2; }), "a count below 0"},
      {changed(0, [](CopcEntry& entry) { entry.bytes = -1; }), "a count below 0"},
      {changed(0, [](CopcEntry& entry) { entry.points = 21; }), "more points than the 40"},
      {changed(0, [](CopcEntry& entry) { entry.offset = ~std::uint64_t{0}; }), "points at 1844674407"},
      {changed(0, [](CopcEntry& entry) { entry.bytes = 1 << 30; }), "points at "},
      {changed(0, [](CopcEntry& entry) { entry.key[1] = 4; }), "a cube beside the octree: level 2"},
      {changed(0, [](CopcEntry& entry) { entry.key[0] = -1; }), "a cube beside the octree"},
      {changed(3,
               [](CopcEntry& entry) {
                 entry.key = {1, 1, 0, 1};
               }),
       "a node without its parent"},
      {changed(2, [](CopcEntry& entry) { entry.points = -1; }), "a page of 0 bytes at 0"},
      {changed(2,
               [](CopcEntry& entry) {
                 entry = {{3, 0, 0, 0}, ~std::uint64_t{0} - 8, 32, -1};
               }),
       "a page of 32 bytes"},
      {changed(2,
               [&](CopcEntry& entry) {
                 entry = {{3, 0, 0, 0}, 1000, 33, -1};
               }),
       "a page of 33 bytes"},
      {twice, "a node twice"},
      {circle, "the page at "}};
  for (const auto& [entries, found] : cases) {
    const std::filesystem::path path = write(entries);
    const std::string sentence = refusal(path);
    EXPECT_NE(sentence.find(found), std::string::npos) << found << ": " << sentence;
    EXPECT_EQ(read(path, {}, 1).points.size(), 40U)
        << "what the directory says does not matter to all points";
  }
}

TEST_F(Copc, AnOctreeHasASize) {
  for (const double edge :
       {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    const std::filesystem::path path = folder.write("a.copc.laz", copc_of(laz, 0.0, edge, entries()));
    const std::string sentence = refusal(path);
    EXPECT_NE(sentence.find("octree without a size"), std::string::npos) << edge << ": " << sentence;
  }
}

}  // namespace
}  // namespace splatray
