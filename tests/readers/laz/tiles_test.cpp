/// Scans of several files by what lists them: Entwine point tiles and virtual point clouds.
#include <gtest/gtest.h>
#include <zstd.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <random>

#include "preprocess/read/formats.h"
#include "preprocess/read/las/read_las.h"
#include "preprocess/read/scan/input_files.h"
#include "preprocess/read/tiles/ept.h"
#include "tests/readers/read_error.h"
#include "tests/temp_folder.h"

namespace splatray {
namespace {

constexpr const char* HEAD = R"({"bounds": [-1, -1, -1, 63, 63, 63], "boundsConforming": [0, 0, 0, 9, 9, 9],
  "dataType": "laszip", "hierarchyType": "json", "points": 80, "version": "1.0.0", "srs": {"wkt": ""}})";

class Tiles : public ::testing::Test {
 protected:
  Tiles() {
    const std::filesystem::path source = std::filesystem::path(CORPUS) / "las" / "pf8_items_v3.laz";
    std::ifstream stream(source, std::ios::binary);
    laz = {std::istreambuf_iterator<char>(stream), {}};
    whole = read(source).points;
    write("ept.json", HEAD);
    write("ept-hierarchy/0-0-0-0.json", R"({"0-0-0-0": 40, "1-0-1-1": -1})");
    write("ept-hierarchy/1-0-1-1.json", R"({"1-0-1-1": 0, "2-0-3-2": 40})");
    write("ept-data/0-0-0-0.laz", laz);
    write("ept-data/2-0-3-2.laz", laz);
  }

  std::filesystem::path write(const std::string& name, const std::string& bytes) {
    return folder.write(name, bytes);
  }
  [[nodiscard]] std::filesystem::path ept() const { return folder.path() / "ept.json"; }

  ScanFile read(const std::filesystem::path& path, const ReadOptions& asked = {}) {
    ReadOptions options = asked;
    options.scans.keep_withheld = true;
    notes.clear();
    return find_format(path)->read_scan(path, options, {notes, options.progress});
  }

  /// The sentence that reading the hierarchy ends in.
  [[nodiscard]] std::string refusal() const {
    try {
      static_cast<void>(levels_of(ept()));
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::input_unreadable);
      return error.what();
    }
    return "";
  }

  const TempFolder folder;
  std::string laz;
  Points whole;
  std::vector<std::string> notes;
};

TEST_F(Tiles, OfEntwineAreAnOctree) {
  const Levels levels = levels_of(ept());
  ASSERT_EQ(levels.nodes.size(), 3U);
  EXPECT_EQ(levels.points(), 80U);
  EXPECT_EQ(levels.low, glm::dvec3(-1.0));
  EXPECT_EQ(levels.edge, 64.0);
  EXPECT_EQ(levels.nodes[2].cell, glm::uvec3(0, 3, 2));
  EXPECT_EQ(levels.nodes[2].parent, 1U);
  ReadOptions heads;
  heads.heads_only = true;
  const ScanFile file = read(ept(), heads);
  EXPECT_EQ(file.counts.stored, 80U);
  EXPECT_EQ((*file.said_box)[1], glm::dvec3(9.0));
}

TEST_F(Tiles, OfEntwineAreTheUnionOfTheirFiles) {
  ASSERT_EQ(whole.size(), 40U);
  const ScanFile all = read(ept());
  std::vector<glm::dvec3> twice = whole.position;
  twice.insert(twice.end(), whole.position.begin(), whole.position.end());
  EXPECT_EQ(all.points.position, twice);
  EXPECT_EQ(all.points.stored_color.size(), whole.stored_color.empty() ? 0U : 80U);
  EXPECT_TRUE(notes.empty());
  ReadOptions root;
  root.nodes = {{ept(), {0}}};
  EXPECT_EQ(read(ept(), root).points.position, whole.position);
  root.nodes = {{ept(), {0, 3}}};
  EXPECT_NE(read_error(ept(), root).find("found 3 nodes in its hierarchy"), std::string::npos);
}

/// Records of X, Y and Z, each an int32.
std::string random_records(std::size_t count) {
  std::mt19937 random(7);
  std::vector<std::uint32_t> words(3 * count);
  for (std::uint32_t& word : words) word = random() >> 8U;
  std::string bytes(4 * words.size(), '\0');
  std::memcpy(bytes.data(), words.data(), bytes.size());
  return bytes;
}

std::string packed(const std::string& bytes) {
  std::string frame(ZSTD_compressBound(bytes.size()), '\0');
  frame.resize(ZSTD_compress(frame.data(), frame.size(), bytes.data(), bytes.size(), 3));
  return frame;
}

TEST_F(Tiles, OfRecordsMayBePackedByZstandard) {
  constexpr std::size_t STORED = 50000;
  const std::string records = random_records(STORED), whole_frame = packed(records);
  const auto head = [](const std::string& type) {
    std::string schema;
    for (const char* name : {"X", "Y", "Z"})
      schema += (schema.empty() ? "" : ",") +
                (R"({"type": "signed", "size": 4, "scale": 0.01, "name": ")" + std::string(name) + R"("})");
    return R"({"bounds": [0, 0, 0, 200000, 200000, 200000], "version": "1.0.0", "dataType": ")" + type +
           R"(", "schema": [)" + schema + "]}";
  };
  write("ept-hierarchy/0-0-0-0.json", R"({"0-0-0-0": )" + std::to_string(STORED) + "}");
  write("ept.json", head("binary"));
  write("ept-data/0-0-0-0.bin", records);
  const Points expected = read(ept()).points;
  ASSERT_EQ(expected.size(), STORED);
  write("ept.json", head("zstandard"));
  const std::filesystem::path tile = write("ept-data/0-0-0-0.zst", whole_frame);
  EXPECT_EQ(read(ept()).points.position, expected.position);
  EXPECT_TRUE(notes.empty());
  write("ept-data/0-0-0-0.zst", packed(records.substr(0, 1200)) + packed(records.substr(1200)));
  EXPECT_EQ(read(ept()).points.position, expected.position) << "two frames";

  std::string flipped = whole_frame;
  flipped[0] = 'x';
  const std::pair<std::string, const char*> cases[] = {
      {flipped, "a damaged Zstandard frame"},
      {whole_frame.substr(0, whole_frame.size() - 9), "a Zstandard frame that ends in its middle"},
      {packed(records + records), "more than 600000 bytes"},
      {packed(std::string(100'000'000, 'x')), "more than 600000 bytes"}};
  for (const auto& [bytes, sentence] : cases) {
    write("ept-data/0-0-0-0.zst", bytes);
    EXPECT_EQ(read(ept()).counts.missing, STORED) << sentence;
    ASSERT_EQ(notes.size(), 1U) << sentence;
    EXPECT_NE(notes[0].find(tile.string() + ": found " + sentence), std::string::npos) << notes[0];
  }
}

TEST_F(Tiles, FoldersStandForTheirEptJson) {
  write("beside.laz", laz);
  const std::vector<InputFile> files = input_files({folder.path()});
  ASSERT_EQ(files.size(), 1U);
  EXPECT_EQ(files[0].path, ept());
}

TEST_F(Tiles, ThatAreMissingAreANoteOrRefused) {
  std::filesystem::remove(folder.path() / "ept-data/2-0-3-2.laz");
  const ScanFile file = read(ept());
  EXPECT_EQ(file.points.position, whole.position);
  EXPECT_EQ(file.counts.stored, 80U);
  EXPECT_EQ(file.counts.missing, 40U);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("2-0-3-2.laz: no such file"), std::string::npos) << notes[0];
  ReadOptions strict;
  strict.scans.strict = true;
  try {
    static_cast<void>(read(ept(), strict));
    FAIL() << "a scan without one of its tiles was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::input_unreadable);
  }
}

TEST_F(Tiles, ThatAreAllDamagedAreNamed) {
  for (const char* name : {"ept-data/0-0-0-0.laz", "ept-data/2-0-3-2.laz"}) write(name, "damaged");
  const std::string error = read_error(ept());
  EXPECT_NE(error.find("80 missing or damaged"), std::string::npos) << error;
  EXPECT_NE(error.find("0-0-0-0.laz: "), std::string::npos) << error;
}

TEST_F(Tiles, OfCountsThatDifferAreANote) {
  write("ept-hierarchy/0-0-0-0.json", R"({"0-0-0-0": 41})");
  EXPECT_EQ(read(ept()).points.size(), 40U);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("found 40 points, expected the 41 that the hierarchy counts"), std::string::npos);
}

TEST_F(Tiles, DamagedHierarchiesAreASentence) {
  const std::pair<const char*, const char*> cases[] = {
      {R"({"0-0-0-0": 1, "1-0-0-2": 1})", "'1-0-0-2' with 1"},
      {R"({"0-0-0-0": 1, "1-0-0": 1})", "'1-0-0' with 1"},
      {R"({"0-0-0-0": 1, "1-0-0-0-": 1})", "'1-0-0-0-' with 1"},
      {R"({"0-0-0-0": 1, "../../a": 1})", "'../../a' with 1"},
      {R"({"0-0-0-0": -2})", "with -2"},
      {R"({"0-0-0-0": "1"})", "with \"1\""},
      {R"({"0-0-0-0": 1.5})", "with 1.5"},
      {R"({"0-0-0-0": -1})", "'0-0-0-0' twice"},
      {R"({"0-0-0-0": 1, "2-0-0-0": 1})", "a node without its parent"},
      {R"({"0-0-0-0": 1, "1-1-1-1": -1})", "1-1-1-1.json: no such file"},
      {R"([1])", "found no object"},
      {R"({"0-0-0-0": 1)", "JSON that ends in its middle"}};
  for (const auto& [page, sentence] : cases) {
    write("ept-hierarchy/0-0-0-0.json", page);
    EXPECT_NE(refusal().find(sentence), std::string::npos) << page << ": " << refusal();
  }
}

/// Two pages that name each other.
TEST_F(Tiles, PagesInARingAreASentence) {
  write("ept-hierarchy/0-0-0-0.json", R"({"0-0-0-0": 1, "1-0-0-0": -1})");
  write("ept-hierarchy/1-0-0-0.json", R"({"1-0-0-0": 1, "1-0-0-1": -1})");
  write("ept-hierarchy/1-0-0-1.json", R"({"1-0-0-1": 1, "1-0-0-0": -1})");
  EXPECT_NE(refusal().find("found the page '1-0-0-0' twice"), std::string::npos) << refusal();
}

TEST_F(Tiles, HeadsOfOtherKindsAreASentence) {
  const auto with = [](const char* from, const char* to) {
    std::string head = HEAD;
    return head.replace(head.find(from), std::string(from).size(), to);
  };
  const std::pair<std::string, const char*> cases[] = {
      {with("laszip", "brotli"), "found tiles of the type \"brotli\""},
      {with("[-1, -1, -1, 63, 63, 63]", "[1, 2]"), "found no bounds of six numbers"},
      {with("[-1, -1, -1, 63", "[63, -1, -1, -1"), "an octree without a size"},
      {"[]", "found no object"}};
  for (const auto& [head, sentence] : cases) {
    write("ept.json", head);
    EXPECT_NE(read_error(ept()).find(sentence), std::string::npos) << head;
  }
}

TEST_F(Tiles, OfVirtualPointCloudsStandInTheirPlace) {
  write("a/one.laz", laz);
  const std::filesystem::path two = write("two.laz", laz);
  const std::filesystem::path list = write("all.vpc", R"({"type": "FeatureCollection", "features": [
        {"assets": {"data": {"href": "./a/one.laz", "roles": ["data"]},
                    "overview": {"href": "./overview.laz", "roles": ["overview"]},
                    "picture": {"href": "a.png"}}},
        {"assets": {"data": {"href": ")" + two.string() + R"("}}},
        {"assets": {"data": {"href": "https://host/b.copc.laz?key=1"}}}]})");
  const std::vector<InputFile> files = input_files({list});
  ASSERT_EQ(files.size(), 3U);
  EXPECT_EQ(read(files[0].path).points.position, whole.position);
  EXPECT_EQ(files[1].path, two);
  EXPECT_EQ(files[2].path, "https://host/b.copc.laz?key=1");
}

TEST_F(Tiles, OfListsThatAreNoneAreASentence) {
  const std::pair<const char*, const char*> cases[] = {
      {"{}", "found no list of features"},
      {R"({"features": []})", "found no files of points"},
      {R"({"features": [{"assets": {"data": {"href": "a.png"}}}]})", "found the file 'a.png' in it"},
      {R"({"features": [{"assets": {"data": {"href": "all.vpc"}}}]})", "found the file 'all.vpc' in it"},
      {R"({"features": [{"assets": {"data": {"href": "no.laz"}}}]})", "no such file"}};
  for (const auto& [text, sentence] : cases) {
    const std::filesystem::path list = write("all.vpc", text);
    try {
      static_cast<void>(read_input({list}, {}));
      ADD_FAILURE() << "was read: " << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::input_unreadable);
      EXPECT_NE(std::string(error.what()).find(sentence), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace splatray
