#include "engine/file/scene_file.h"

#include <gtest/gtest.h>

#include <bit>
#include <fstream>
#include <limits>

#include "engine/base/error.h"
#include "engine/scene/clip.h"
#include "engine/scene/splat.h"
#include "tests/format/scene_bytes.h"
#include "tests/format/tiny_scene.h"
#include "tests/temp_folder.h"

namespace splatray {
namespace {

namespace fs = std::filesystem;

std::size_t section_offset(const Bytes& bytes, std::size_t id) {
  return get<std::uint64_t>(bytes, TABLE + (id - 1) * ENTRY + 8);
}

Bytes read_hex(const char* path) {
  std::ifstream file(path);
  Bytes bytes;
  for (std::string pair; file >> pair;) bytes += static_cast<char>(std::stoi(pair, nullptr, 16));
  return bytes;
}

class SceneFile : public ::testing::Test {
 protected:
  void SetUp() override {
    path = folder / "tiny.soct";
    write_scene(tiny_scene(), path);
    bytes = load();
  }

  [[nodiscard]] Bytes load() const {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  void store(const Bytes& content) const { std::ofstream(path, std::ios::binary) << content; }

  /// The refusal of a file of these bytes; empty when it is read.
  std::string refusal(const Bytes& content) const {
    store(content);
    try {
      (void)read_scene(path);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::input_unreadable);
      const std::string sentence = error.what();
      EXPECT_NE(sentence.find(path.string()), std::string::npos);
      EXPECT_NE(sentence.find("expected"), std::string::npos);
      EXPECT_EQ(sentence.find('\n'), std::string::npos);
      return sentence;
    }
    return "";
  }

  const TempFolder own;
  const fs::path& folder = own.path();
  fs::path path;
  Bytes bytes;
};

TEST_F(SceneFile, GoldenBytes) {
  const Bytes golden = read_hex(GOLDEN_FILE);
  ASSERT_EQ(bytes.size(), golden.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) ASSERT_EQ(bytes[i], golden[i]) << "at byte " << i;
}

TEST_F(SceneFile, HeaderIsWhereTheTableSays) {
  EXPECT_EQ(bytes.substr(0, 4), "SOCT");
  EXPECT_EQ(get<std::uint32_t>(bytes, 4), PLAIN_SCENE_FILE_VERSION);
  EXPECT_EQ(get<std::uint32_t>(bytes, 12), HEADER);
  EXPECT_EQ(get<std::uint64_t>(bytes, 16), bytes.size());
  EXPECT_EQ(get<std::uint64_t>(bytes, 32), 4U);
  EXPECT_EQ(get<std::uint64_t>(bytes, 40), 5U);
  EXPECT_EQ(get<double>(bytes, 104), 30.0);
  EXPECT_EQ(get<double>(bytes, 112), 0.5);
  EXPECT_EQ(get<double>(bytes, 136), 1.25);
  EXPECT_EQ(get<double>(bytes, 176), 1.0);
  EXPECT_EQ(get<double>(bytes, 232), 12.5);
  EXPECT_EQ(bytes.substr(section_offset(bytes, 13), 21), Bytes("glass\0\0sky.hdr\0door\0\0", 21));
  EXPECT_EQ(bytes.substr(bytes.size() - 8), "SOCT.END");
  for (std::size_t id = 1; id <= 46; ++id) EXPECT_EQ(section_offset(bytes, id) % 16, 0U);
}

TEST_F(SceneFile, RoundTrip) {
  const Scene scene = tiny_scene(), copy = read_scene(path);
  EXPECT_EQ(copy.node_pool, scene.node_pool);
  EXPECT_EQ(copy.begin_end, scene.begin_end);
  EXPECT_EQ(copy.slab_pool, scene.slab_pool);
  EXPECT_EQ(copy.reference_pool, scene.reference_pool);
  EXPECT_EQ(copy.data_pool, scene.data_pool);
  EXPECT_EQ(copy.color_pool, scene.color_pool);
  EXPECT_EQ(copy.field_pool, scene.field_pool);
  EXPECT_EQ(copy.clip_pool, scene.clip_pool);
  ASSERT_EQ(copy.columns.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(copy.columns[i].name, scene.columns[i].name);
    EXPECT_EQ(copy.columns[i].values, scene.columns[i].values);
  }
  ASSERT_EQ(copy.stations.size(), 2U);
  EXPECT_EQ(copy.stations[0].name, "door");
  EXPECT_EQ(copy.stations[0].sensor_world, scene.stations[0].sensor_world);
  EXPECT_EQ(copy.stations[0].columns, 3U);
  EXPECT_FALSE(copy.stations[1].sensor_world.has_value());
  EXPECT_EQ(copy.object_names, scene.object_names);
  EXPECT_EQ(copy.environment_path, scene.environment_path);
  EXPECT_EQ(copy.materials[0].ior, 1.5F);
  EXPECT_EQ(copy.materials[1].diffuse, scene.materials[1].diffuse);
  ASSERT_EQ(copy.surfaces.size(), 2U);
  EXPECT_EQ(copy.surfaces[1].emission, scene.surfaces[1].emission);
  EXPECT_EQ(copy.lights.at(0).position, scene.lights[0].position);
  EXPECT_EQ(copy.camera.value().fov_y_deg, 35.0);
  EXPECT_EQ(copy.build.insertion, Insertion::probe);
  EXPECT_EQ(copy.build.seed, 11U);
  EXPECT_EQ(copy.bounds_max_world, scene.bounds_max_world);
  write_scene(copy, path);
  EXPECT_EQ(load(), bytes);
}

/// A file of version 11: lights of all kinds.
class SizedLights : public SceneFile {
 protected:
  void SetUp() override {
    scene.lights = {
        {LIGHT_POINT, {1.0, 2.0, 3.0}, vec3(4.0F, 5.0F, 6.0F), 0.25},
        {LIGHT_DIRECTIONAL, {0.0, 1.0, 0.0}, vec3(1.0F)},
        {LIGHT_RECTANGLE, {0.0, 5.0, 0.0}, vec3(2.0F, 3.0F, 4.0F), 0.0, {3.0, 0.0, 4.0}, {0.0, 0.5, 0.0}}};
    path = folder / "lights.soct";
    write_scene(scene, path);
    bytes = load();
  }

  Scene scene = tiny_scene();
};

TEST_F(SizedLights, AreKeptAsTheyAre) {
  EXPECT_EQ(get<std::uint32_t>(bytes, 4), SIZED_SCENE_FILE_VERSION);
  EXPECT_EQ(get<std::uint32_t>(bytes, TABLE + 9 * ENTRY + 4), 104U);
  const std::size_t lights = section_offset(bytes, 10);
  EXPECT_EQ(get<double>(bytes, lights + 48), 0.25);
  EXPECT_EQ(get<std::uint32_t>(bytes, lights + 2 * 104), LIGHT_RECTANGLE);
  EXPECT_EQ(get<double>(bytes, lights + 2 * 104 + 72), 4.0);
  EXPECT_EQ(get<double>(bytes, lights + 2 * 104 + 88), 0.5);
  const Scene copy = read_scene(path);
  EXPECT_EQ(copy.lights, scene.lights);
  EXPECT_EQ(copy.surfaces[1].emission, scene.surfaces[1].emission);
  write_scene(copy, path);
  EXPECT_EQ(load(), bytes);
}

TEST_F(SizedLights, SpotsAndRangesAreKeptAsTheyAre) {
  scene.lights.front().spot_axis = {0.0, -2.0, 0.0};
  scene.lights.front().spot_inner = 0.25;
  scene.lights.front().spot_outer = 0.5;
  scene.lights.front().range = 8.0;
  write_scene(scene, path);
  bytes = load();
  EXPECT_EQ(get<std::uint32_t>(bytes, 4), TEXTURED_SCENE_FILE_VERSION);
  const std::size_t lights = section_offset(bytes, 10);
  EXPECT_EQ(get<double>(bytes, lights + 104 + 8), -2.0);
  EXPECT_EQ(get<double>(bytes, lights + 104 + 24), 0.25);
  EXPECT_EQ(get<double>(bytes, lights + 104 + 40), 8.0);
  const Scene copy = read_scene(path);
  EXPECT_EQ(copy.lights, scene.lights);
  write_scene(copy, path);
  EXPECT_EQ(load(), bytes);
  put(bytes, lights + 104 + 24, 0.75);
  reseal(bytes);
  EXPECT_NE(refusal(bytes).find("light 0 with a spot's cone"), std::string::npos);
}

TEST_F(SceneFile, OfTextureFactorsIsOfTheirVersion) {
  Scene scene = tiny_scene();
  scene.columns = {{"texture-emission-g", std::vector<std::uint8_t>(scene.data_pool.size(), 17)}};
  write_scene(scene, path);
  EXPECT_EQ(get<std::uint32_t>(load(), 4), TEXTURED_SCENE_FILE_VERSION);
  EXPECT_EQ(read_scene(path).columns[0].number(0), 17.0);
  scene.columns[0].name = "emission-g";
  write_scene(scene, path);
  EXPECT_EQ(get<std::uint32_t>(load(), 4), PLAIN_SCENE_FILE_VERSION) << "any attribute of points";
  scene.columns = {{"texture-emission-g", std::vector<float>(scene.data_pool.size(), 1.0F)}};
  write_scene(scene, path);
  EXPECT_EQ(get<std::uint32_t>(load(), 4), PLAIN_SCENE_FILE_VERSION) << "of a type that factors are not of";
}

TEST_F(SceneFile, OfConstantTermsIsOfTheirVersion) {
  Scene scene = tiny_scene();
  scene.field_pool[1] = pack_lean({0.25, 0.0, 0.0}, unpack_splat(scene.data_pool[1]).normal);
  write_scene(scene, path);
  EXPECT_EQ(get<std::uint32_t>(load(), 4), LEANING_SCENE_FILE_VERSION);
  EXPECT_EQ(read_scene(path).field_pool, scene.field_pool);
}

TEST_F(SceneFile, SystemAndQualityOfScansAreOptional) {
  EXPECT_EQ(read_scene(path).crs, "");
  EXPECT_EQ(read_scene(path).stations[0].noise_world, 0.0);
  Scene scene = tiny_scene();
  scene.crs = "PROJCS[\"ETRS89 / UTM zone 32N\",UNIT[\"metre\",1]]";
  scene.stations[1].noise_world = 0.003;
  scene.stations[0].step_world = 1e-4;
  write_scene(scene, path);
  const Bytes whole = load();
  EXPECT_EQ(get<std::uint32_t>(whole, 4), SCENE_FILE_VERSION);
  const Scene copy = read_scene(path);
  EXPECT_EQ(copy.crs, scene.crs);
  EXPECT_EQ(copy.stations[1].noise_world, 0.003);
  EXPECT_EQ(copy.stations[0].step_world, 1e-4);
  EXPECT_EQ(copy.stations[0].sensor_world, scene.stations[0].sensor_world);
  EXPECT_EQ(copy.columns[3].name, "time");
  for (std::size_t length = 0; length < whole.size(); length += 3)
    EXPECT_NE(refusal(whole.substr(0, length)), "") << length;
  Bytes forged = whole;
  put(forged, section_offset(whole, 12) + 40, -0.25);
  reseal(forged);
  EXPECT_NE(refusal(forged).find("a station's noise"), std::string::npos);
  forged = whole;
  put<std::uint32_t>(forged, 4, LEANING_SCENE_FILE_VERSION);
  reseal(forged);
  EXPECT_NE(refusal(forged), "") << "no bytes that the version does not know";
  scene.stations = tiny_scene().stations;
  write_scene(scene, path);
  EXPECT_EQ(read_scene(path).crs, scene.crs) << "alone";
}

TEST_F(SizedLights, TruncatedOrDamagedAreRefused) {
  for (std::size_t length = 0; length < bytes.size(); length += 3)
    EXPECT_NE(refusal(bytes.substr(0, length)), "") << length;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    Bytes flipped = bytes;
    flipped[i] = static_cast<char>(flipped[i] ^ (1 << i % 8));
    EXPECT_NE(refusal(flipped), "") << i;
  }
}

TEST_F(SizedLights, ForgedOnesAreRefused) {
  const auto says = [&](Bytes forged, const char* words) {
    reseal(forged);
    const std::string sentence = refusal(forged);
    EXPECT_NE(sentence.find(words), std::string::npos) << sentence;
  };
  for (const std::uint32_t version : {9U, 15U}) {
    Bytes forged = bytes;
    put<std::uint32_t>(forged, 4, version);
    says(forged, "expected version 10 to 14");
  }
  Bytes forged = bytes;
  put<std::uint32_t>(forged, 4, PLAIN_SCENE_FILE_VERSION);
  says(forged, "a section table that contradicts the counts");
  const std::size_t lights = section_offset(bytes, 10);
  forged = bytes;
  put(forged, lights + 48, -0.25);
  says(forged, "light 0 with a size");
  forged = bytes;
  put(forged, lights + 2 * 104 + 80, std::numeric_limits<double>::quiet_NaN());
  says(forged, "light 2 with edges");
}

TEST_F(SceneFile, EllipsesAreFlaggedInTheHeader) {
  EXPECT_EQ(get<std::uint32_t>(bytes, 72), 7U) << "without ellipses as before";
  Scene scene = tiny_scene();
  scene.clip_pool[1] = pack_ellipse(scene.data_pool[1], {1.0, 0.0, 0.0}, 5.0);
  write_scene(scene, path);
  Bytes with = load();
  EXPECT_EQ(get<std::uint32_t>(with, 72), 263U);
  EXPECT_EQ(read_scene(path).clip_pool, scene.clip_pool);
  put<std::uint32_t>(with, 72, 7);
  reseal(with);
  EXPECT_NE(refusal(with).find("found attributes 7, expected 263"), std::string::npos);
}

TEST_F(SceneFile, OptionalPartsMayBeAbsent) {
  Scene scene = tiny_scene();
  scene.color_pool.clear();
  scene.field_pool.clear();
  scene.clip_pool.clear();
  scene.columns.clear();
  scene.stations.clear();
  scene.camera.reset();
  scene.lights.clear();
  scene.surfaces.clear();
  scene.environment_path.clear();
  write_scene(scene, path);
  const Scene copy = read_scene(path);
  EXPECT_TRUE(copy.color_pool.empty());
  EXPECT_TRUE(copy.field_pool.empty());
  EXPECT_TRUE(copy.clip_pool.empty());
  EXPECT_TRUE(copy.columns.empty());
  EXPECT_TRUE(copy.stations.empty());
  EXPECT_FALSE(copy.camera.has_value());
  EXPECT_TRUE(copy.lights.empty());
  EXPECT_TRUE(copy.surfaces.empty());
  EXPECT_EQ(copy.object_names, scene.object_names);
}

TEST_F(SceneFile, RefusesEveryTruncation) {
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_NE(refusal(bytes.substr(0, length)), "") << length;
}

TEST_F(SceneFile, RefusesAFlippedBitInEveryByte) {
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    Bytes flipped = bytes;
    flipped[i] = static_cast<char>(flipped[i] ^ (1 << i % 8));
    EXPECT_NE(refusal(flipped), "") << i;
  }
}

TEST_F(SceneFile, SaysWhatIsWrong) {
  const auto says = [&](Bytes content, const char* words) {
    const std::string sentence = refusal(content);
    EXPECT_NE(sentence.find(words), std::string::npos) << sentence;
  };
  says(bytes + "x", "(extra bytes)");
  says(bytes.substr(0, HEADER - 1), "(file truncated)");
  says("", "found 0 bytes");
  says("ply\nformat ascii 1.0\n", "another file type");
  Bytes other = bytes;
  put<std::uint32_t>(other, 4, 2);
  says(other, "found version 2, expected version 10 to 14");
  other = bytes;
  put<std::uint32_t>(other, 8, 0x04030201);
  says(other, "a foreign byte order");
  other = bytes;
  other[section_offset(bytes, 4)] ^= 1;
  says(other, "section 4 with another checksum");
}

TEST_F(SceneFile, RefusesForgedContent) {
  const auto says = [&](std::size_t section, std::size_t offset, std::uint32_t value, const char* words) {
    Bytes forged = bytes;
    put(forged, section_offset(bytes, section) + offset, value);
    reseal(forged);
    const std::string sentence = refusal(forged);
    EXPECT_NE(sentence.find(words), std::string::npos) << sentence;
  };
  says(1, 0, 2, "node 0 with children at 2");
  says(1, 4, 0x40000002, "leaf 1");
  says(2, 4, 5, "Begin-End entry 2");
  says(2, 8, 6, "a Begin-End from 0 to 6");
  says(4, 8, 4, "a reference to splat 4");
  says(5, 12, 0xFFFF0000, "splat 0 with a radius");
  says(5, 28, 0x20000002, "splat 1 of object 2");
  says(10, 0, 7, "light 0");
  says(1, 8, 0x40000000, "node 2 that shares filled leaf 0");
  says(1, 8, 0x80000001, "empty leaf 2 whose box reaches over a filled leaf");
  says(1, 32, 0x80000000, "1 filled leaves that are not in the tree");
  says(3, 4, 0x20F803E0, "slab 1 whose halves leave out 1");
  says(9, 28, std::bit_cast<std::uint32_t>(-1e30F),
       "material 0 with a shininess out of range, expected 1 or more");
  says(9, 32, std::bit_cast<std::uint32_t>(1e30F), "material 0 with a mirror out of range, expected 0 to 1");
  says(9, 44, 32, "material 0 with a mask bit");
  says(10, 32, std::bit_cast<std::uint32_t>(-1.0F), "light 0 with a power");
  says(12, 24, 2, "a station's flag above 1");
  says(12, 4, 0x7FF00000, "a station whose place is not finite");
  says(13, 0, 0, "names, expected 9, of objects, environment, stations and columns");
}

TEST_F(SceneFile, RefusesForgedCounts) {
  const auto refused = [&](std::size_t offset, std::uint64_t value) {
    Bytes forged = bytes;
    put(forged, offset, value);
    reseal_header(forged);
    return !refusal(forged).empty();
  };
  for (const std::size_t offset : {40, 48, 56, 64, 72, 80, 240, 248, 280}) {
    EXPECT_TRUE(refused(offset, 1ULL << 60U)) << offset;
    EXPECT_TRUE(refused(offset, 3)) << offset;
  }
  for (const std::size_t column : {0, 3, 4, 31})
    for (const std::uint64_t type : {0, 5, 255}) {
      Bytes forged = bytes;
      put(forged, 248 + column, static_cast<std::uint8_t>(type));
      if (forged == bytes) continue;
      reseal_header(forged);
      EXPECT_NE(refusal(forged), "") << "column " << column << " of type " << type;
    }
  EXPECT_TRUE(refused(112, 0));                  // unit_world
  EXPECT_TRUE(refused(TABLE + 8, 1ULL << 40U));  // first section's offset
}

TEST_F(SceneFile, RefusesPathsThatAreNoFiles) {
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
