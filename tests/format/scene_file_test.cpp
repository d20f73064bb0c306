#include "engine/file/scene_file.h"

#include <bit>
#include <cstring>
#include <limits>

#include "engine/scene/wide/wide_tree.h"
#include "tests/format/same_scene.h"
#include "tests/format/scene_file_fixture.h"
#include "tests/format/scene_of_version.h"

namespace splatray {
namespace {

namespace fs = std::filesystem;

/// The file of a scene with all that a file can hold.
class FullFile : public SceneFile {
 protected:
  void SetUp() override { bytes = written(scene); }

  Scene scene = scene_of_version(14);
};

TEST_F(FullFile, GoldenBytes) {
  const Bytes golden = golden_bytes(15);
  ASSERT_EQ(bytes.size(), golden.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) ASSERT_EQ(bytes[i], golden[i]) << "at byte " << i;
}

TEST_F(FullFile, HeaderAndSectionsAreWhereTheTableSays) {
  EXPECT_EQ(bytes.substr(0, 4), "SOCT");
  EXPECT_EQ(get<std::uint32_t>(bytes, 4), 15U);
  EXPECT_EQ(get<std::uint32_t>(bytes, 12), 48 + 64 * get<std::uint32_t>(bytes, 32));
  EXPECT_EQ(get<std::uint64_t>(bytes, 16), bytes.size());
  EXPECT_EQ(bytes.substr(bytes.size() - 8), "SOCT.END");
  for (std::size_t entry = NAMED.begin; entry < head_bytes(bytes); entry += NAMED.entry)
    EXPECT_EQ(get<std::uint64_t>(bytes, entry + NAMED.place) % 16, 0U) << bytes.data() + entry;
  const auto double_at = [&](const char* section, std::size_t offset) {
    return get<double>(bytes, section_offset(bytes, section) + offset);
  };
  EXPECT_EQ(double_at("root", 16), 30.0);
  EXPECT_EQ(double_at("root", 24), 0.5);
  EXPECT_EQ(double_at("build", 16), 1.25);
  EXPECT_EQ(double_at("world", 16), 1.0);
  EXPECT_EQ(double_at("world", 72), 12.5);
  EXPECT_EQ(double_at("lights", 48), 0.25);
  EXPECT_EQ(double_at("lights", 144), 8.0);
  EXPECT_EQ(double_at("lights", 2 * 152 + 72), 4.0);
  EXPECT_EQ(double_at("stations", 48), 1e-4);
  EXPECT_EQ(bytes.substr(section_offset(bytes, "object_names"), 7), Bytes("glass\0\0", 7));
  EXPECT_EQ(bytes.substr(section_offset(bytes, "environment"), 8), Bytes("sky.hdr\0", 8));
  EXPECT_EQ(get<std::uint32_t>(bytes, entry_of(bytes, "data_pool") + 24), 6U);
  EXPECT_EQ(get<std::uint32_t>(bytes, entry_of(bytes, "column.1") + 24), 1U);
}

TEST_F(FullFile, RoundTrip) {
  const Scene copy = read(bytes);
  expect_same_scene(copy, scene);
  EXPECT_EQ(written(copy), bytes);
}

TEST_F(SceneFile, RoundTrip) {
  const Scene copy = read(bytes);
  expect_same_scene(copy, tiny_scene());
  EXPECT_EQ(written(copy), bytes);
}

TEST_F(SceneFile, OptionalPartsMayBeAbsent) {
  Scene scene = tiny_scene();
  scene.color_pool.edit().clear();
  scene.field_pool.edit().clear();
  scene.clip_pool.edit().clear();
  scene.columns.clear();
  scene.stations.clear();
  scene.camera.reset();
  scene.lights.clear();
  scene.environment_path.clear();
  scene.build.normal_fields = false;
  const Bytes least = written(scene);
  expect_same_scene(read(least), scene);
  EXPECT_EQ(get<std::uint32_t>(least, 32), 10U) << "and takes no sections";
}

TEST_F(SceneFile, EmptyColumnsAreKept) {
  Scene scene = tiny_scene();
  for_each_pool([&](const auto& row) { scene.*row.pool = {}; });
  scene.node_pool = {NODE_EMPTY << NODE_TAG_SHIFT};
  scene.begin_end = {0};
  scene.columns = {{"intensity", std::vector<float>{}}};
  scene.build.normal_fields = false;
  expect_same_scene(read(written(scene)), scene);
}

TEST_F(SceneFile, KeepsAWideTree) {
  Scene scene = tiny_scene();
  add_wide_tree(scene);
  const Bytes with_tree = written(scene);
  const Scene copy = read(with_tree);
  expect_same_scene(copy, scene);
  ASSERT_EQ(copy.wide_nodes.size(), 1U);
  EXPECT_EQ(std::memcmp(copy.wide_nodes.data(), scene.wide_nodes.data(), sizeof(WideNode)), 0);
  EXPECT_EQ(written(copy), with_tree);
  Bytes other = with_tree;
  other[section_offset(with_tree, "wide_nodes") + 100] ^= 1;
  expect_refusal(other, "section 'wide_nodes' with another checksum");
  other = with_tree;
  put<std::uint32_t>(other, entry_of(with_tree, "wide_nodes") + 28, sizeof(WideNode) / 2);
  reseal(other);
  expect_refusal(other, "section 'wide_nodes' with elements of 192 bytes, expected 384");
  scene.wide_nodes = std::vector<WideNode>(3);
  expect_refusal(written(scene), "a wide tree of 3 nodes for 4 splats, expected 1");
}

TEST_F(FullFile, EveryTruncationIsRefused) {
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_NE(refusal(bytes.substr(0, length)), "") << length;
}

TEST_F(FullFile, AFlippedBitInEveryByteIsRefused) {
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    Bytes flipped = bytes;
    flipped[i] = static_cast<char>(flipped[i] ^ (1 << i % 8));
    EXPECT_NE(refusal(flipped), "") << i;
  }
}

TEST_F(SceneFile, SaysWhatIsWrong) {
  expect_refusal(bytes + "x", "(extra bytes)");
  for (const std::size_t length : {std::size_t{31}, head_bytes(bytes) - 1, bytes.size() - 1})
    expect_refusal(bytes.substr(0, length), "(file truncated)");
  expect_refusal("", "found 0 bytes");
  expect_refusal("ply\nformat ascii 1.0\n", "another file type");
  for (const std::uint32_t version : {2U, 9U, 16U}) {
    Bytes other = bytes;
    put(other, 4, version);
    reseal(other);
    expect_refusal(other,
                   ("found version " + std::to_string(version) + ", expected version 10 to 15").c_str());
  }
  Bytes other = bytes;
  put<std::uint32_t>(other, 8, 0x04030201);
  expect_refusal(other, "a foreign byte order");
  other = bytes;
  other[section_offset(bytes, "reference_pool")] ^= 1;
  expect_refusal(other, "section 'reference_pool' with another checksum");
}

TEST_F(SceneFile, ForgedContentIsRefused) {
  const auto says = [&](const char* section, std::size_t offset, std::uint32_t value, const char* words) {
    Bytes forged = bytes;
    put(forged, section_offset(bytes, section) + offset, value);
    reseal(forged);
    expect_refusal(forged, words);
  };
  says("node_pool", 0, 2, "node 0 with children at 2");
  says("node_pool", 4, 0x40000002, "leaf 1");
  says("begin_end", 4, 5, "Begin-End entry 2");
  says("begin_end", 8, 6, "a Begin-End from 0 to 6");
  says("reference_pool", 8, 4, "a reference to splat 4");
  says("data_pool", 12, 0xFFFF0000, "splat 0 with a radius");
  says("data_pool", 28, 0x20000002, "splat 1 of object 2");
  says("lights", 0, 7, "light 0");
  says("node_pool", 8, 0x40000000, "node 2 that shares filled leaf 0");
  says("node_pool", 8, 0x80000001, "empty leaf 2 whose box reaches over a filled leaf");
  says("node_pool", 32, 0x80000000, "1 filled leaves that are not in the tree");
  says("slab_pool", 4, 0x20F803E0, "slab 1 whose halves leave out 1");
  says("materials", 96 + 28, std::bit_cast<std::uint32_t>(-1e30F),
       "material 0 with a shininess out of range, expected 1 or more");
  says("materials", 96 + 32, std::bit_cast<std::uint32_t>(1e30F),
       "material 0 with a mirror out of range, expected 0 to 1");
  says("materials", 28, std::bit_cast<std::uint32_t>(1.5F),
       "material 0 with a roughness out of range, expected 0 to 1");
  says("materials", 84, 32, "material 0 with a mask bit");
  says("lights", 32, std::bit_cast<std::uint32_t>(-1.0F), "light 0 with a power");
  says("stations", 24, 2, "a station's flag above 1");
  says("stations", 4, 0x7FF00000, "a station whose place is not finite");
  says("object_names", 0, 0, "section 'object_names' of 6 names, expected 2");
  says("station_names", 0, 0, "section 'station_names' of 6 names, expected 2");
  says("build", 0, 0, "build parameters out of range");
}

TEST_F(FullFile, ForgedLightsAndStationsAreRefused) {
  const auto says = [&](const char* section, std::size_t offset, double value, const char* words) {
    Bytes forged = bytes;
    put(forged, section_offset(bytes, section) + offset, value);
    reseal(forged);
    expect_refusal(forged, words);
  };
  says("lights", 48, -0.25, "light 0 with a size");
  says("lights", 152 + 48, 2.0, "light 1 with a size");
  says("lights", 2 * 152 + 80, std::numeric_limits<double>::quiet_NaN(), "light 2 with edges");
  says("lights", 128, 0.75, "light 0 with a spot's cone");
  says("stations", 40, -0.25, "a station's noise");
  says("stations", 48, std::numeric_limits<double>::infinity(), "a station's noise");
  says("root", 24, 0.0, "a root transform");
  says("world", 0, std::numeric_limits<double>::infinity(), "an up direction");
}

TEST_F(SceneFile, PathsThatAreNoFilesAreRefused) {
  EXPECT_THROW((void)read_scene(folder), Error);
  EXPECT_THROW((void)read_scene(folder / "missing.soct"), Error);
}

TEST_F(SceneFile, FailedWriteLeavesNothing) {
  EXPECT_THROW(write_scene(tiny_scene(), folder / "missing" / "a.soct"), Error);
  EXPECT_THROW(write_scene(tiny_scene(), folder), Error);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
  EXPECT_EQ(load(), bytes);
}

}  // namespace
}  // namespace splatray
