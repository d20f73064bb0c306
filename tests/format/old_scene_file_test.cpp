// Files of versions 10 to 14, as they were written when these were the newest (golden).
#include "engine/file/old_scene_sections.h"

#include "tests/format/same_scene.h"
#include "tests/format/scene_file_fixture.h"
#include "tests/format/scene_of_version.h"

namespace splatray {
namespace {

class OldSceneFile : public SceneFile, public ::testing::WithParamInterface<std::uint32_t> {
 protected:
  void SetUp() override {
    bytes = golden_bytes(GetParam());
    ASSERT_EQ(get<std::uint32_t>(bytes, 4), GetParam());
  }

  [[nodiscard]] static std::size_t entry(std::size_t id) { return OLD.begin + (id - 1) * OLD.entry; }
  [[nodiscard]] std::size_t place(std::size_t id) const {
    return get<std::uint64_t>(bytes, entry(id) + OLD.place);
  }
};

TEST_P(OldSceneFile, IsReadAsItsScene) {
  const Scene scene = scene_of_version(GetParam()), copy = read(bytes);
  expect_same_scene(copy, scene);
  EXPECT_EQ(written(copy), written(scene)) << "and becomes one of the newest version";
}

/// Every fifth byte of each of the five versions, beginning with another: all bytes of their common form.
TEST_P(OldSceneFile, TruncationsAreRefused) {
  for (std::size_t length = GetParam() % 5; length < bytes.size(); length += 5)
    EXPECT_NE(refusal(bytes.substr(0, length)), "") << length;
}

TEST_P(OldSceneFile, FlippedBitsAreRefused) {
  for (std::size_t i = GetParam() % 5; i < bytes.size(); i += 5) {
    Bytes flipped = bytes;
    flipped[i] = static_cast<char>(flipped[i] ^ (1 << i % 8));
    EXPECT_NE(refusal(flipped), "") << i;
  }
}

TEST_P(OldSceneFile, OfAnotherVersionIsRefused) {
  const std::uint32_t records =
      GetParam() == 13 ? 12 : GetParam();  // these two differ in what field words mean
  for (std::uint32_t version = 9; version <= 15; ++version) {
    if ((version == 13 ? 12 : version) == records) continue;
    Bytes forged = bytes;
    put(forged, 4, version);
    reseal(forged, OLD);
    EXPECT_NE(refusal(forged), "") << version;
  }
}

TEST_P(OldSceneFile, ForgedContentIsRefused) {
  const auto says = [&](std::size_t section, std::size_t offset, std::uint32_t value, const char* words) {
    Bytes forged = bytes;
    put(forged, place(section) + offset, value);
    reseal(forged, OLD);
    expect_refusal(forged, words);
  };
  says(1, 0, 2, "node 0 with children at 2");
  says(2, 8, 6, "a Begin-End from 0 to 6");
  says(4, 8, 4, "a reference to splat 4");
  says(5, 28, 0x20000002, "splat 1 of object 2");
  says(9, 44, 32, "material 0 with a mask bit");
  says(10, 0, 7, "light 0");
  says(12, 24, 2, "a station's flag above 1");
  says(13, 0, 0, "of objects, environment, stations and columns");
}

TEST_P(OldSceneFile, ForgedCountsAreRefused) {
  const auto refused = [&](std::size_t offset, std::uint64_t value) {
    Bytes forged = bytes;
    put(forged, offset, value);
    reseal_header(forged);
    EXPECT_NE(refusal(forged), "") << offset << " " << value;
  };
  for (const std::size_t offset : {32, 40, 48, 56, 64, 72, 76, 80, 240, 248, 280}) {
    refused(offset, 1ULL << 60U);
    refused(offset, ~0ULL);
    refused(offset, 7);
  }
  for (const std::size_t column : {0, 3, 4, 31})
    for (const std::uint8_t type : {0, 5, 255}) {
      Bytes forged = bytes;
      put(forged, 248 + column, type);
      if (forged == bytes) continue;
      reseal_header(forged);
      EXPECT_NE(refusal(forged), "") << "column " << column << " of type " << type;
    }
  refused(112, 0);                     // unit_world
  refused(entry(1) + 8, 1ULL << 40U);  // first section's offset
}

TEST_P(OldSceneFile, EllipsesAreThoseThatTheHeaderTellsOf) {
  EXPECT_EQ(get<std::uint32_t>(bytes, 72), GetParam() == 14 ? 263U : 7U);
  put<std::uint32_t>(bytes, 72, GetParam() == 14 ? 7 : 263);
  reseal(bytes, OLD);
  expect_refusal(bytes, GetParam() == 14 ? "found ellipses, expected" : "found no ellipses, expected");
}

INSTANTIATE_TEST_SUITE_P(, OldSceneFile, ::testing::Range(10U, 15U),
                         [](const auto& one) { return "Version" + std::to_string(one.param); });

}  // namespace
}  // namespace splatray
