// What readers do with sections that are more, fewer or others than they know.
#include "engine/file/scene_sections.h"

#include "engine/file/scene_file.h"
#include "engine/scene/phong.h"
#include "tests/format/same_scene.h"
#include "tests/format/scene_file_fixture.h"
#include "tests/format/scene_of_sections.h"
#include "tests/format/scene_of_version.h"

namespace splatray {
namespace {

constexpr std::uint32_t OPTIONAL = 1;

class SceneSections : public SceneFile {
 protected:
  void SetUp() override {
    scene.stations[1].sensor_found_world = glm::dvec3(1.0, 2.0, -3.0);
    sections = sections_of(written(scene));
  }

  /// Refusal of the sections with one changed.
  template <typename Change>
  void expect_refusal_after(const std::string& name, const Change& change, const char* words) const {
    FileSections changed = sections;
    change(section_in(changed, name));
    expect_refusal(file_of(changed), words);
  }

  Scene scene = scene_of_version(14);
  FileSections sections;
};

TEST_F(SceneSections, TheTestsWriterWritesTheSameFile) { EXPECT_EQ(file_of(sections), load()); }

TEST_F(SceneSections, AreReadInAnyOrder) {
  std::reverse(sections.begin(), sections.end());
  expect_same_scene(read(file_of(sections)), scene);
}

TEST_F(SceneSections, UnknownOptionalOnesArePassedOver) {
  sections.insert(sections.begin() + 3, {"warmth", 3, 4, OPTIONAL, Bytes(7 * 4, 'w')});
  sections.push_back({"a-name-of-24-characters.", 0, 5, OPTIONAL, "55555"});
  sections.push_back({"nothing", 2, 2, OPTIONAL, ""});
  Bytes file = file_of(sections);
  expect_same_scene(read(file), scene);
  file[section_offset(file, "warmth") + 5] ^= 1;
  expect_refusal(file, "section 'warmth' with another checksum");
}

TEST_F(SceneSections, UnknownOnesThatAreNotOptionalAreRefused) {
  sections.push_back({"warmth", 3, 4, 0, Bytes(7 * 4, 'w')});
  expect_refusal(file_of(sections), "found section 'warmth', expected none");
}

TEST_F(SceneSections, MissingOnesAreNamed) {
  const std::string needed[] = {"node_pool", "begin_end",    "slab_pool", "reference_pool", "data_pool",
                                "materials", "object_names", "root",      "build",          "world"};
  for (const std::string& name : needed)
    expect_refusal(file_of(without(sections, name)), ("found no section '" + name + "'").c_str());
  for (const char* name : {"station_names", "column_names"})
    expect_refusal(file_of(without(sections, name)),
                   (std::string("found no section '") + name + "'").c_str());
  expect_refusal(file_of(without(sections, "column.1")), "section 'column_names' of 4 names, expected 1");
  expect_refusal(file_of(without(without(sections, "column.1"), "column_names")), "'column_names'");
  expect_refusal(file_of(without(sections, "stations")), "section 'station_names' of 2 names, expected 0");
  expect_refusal(file_of({}), "found no section");
}

TEST_F(SceneSections, OfOneNameAreRefused) {
  sections.push_back(sections.front());
  expect_refusal(file_of(sections), "two sections 'node_pool'");
}

TEST_F(SceneSections, TailsOfLongerRecordsAreLeftOut) {
  for (const char* name : {"lights", "stations", "camera", "root", "build", "world", "materials"}) {
    FileSections longer = sections;
    FileSection& section = section_in(longer, name);
    for (std::size_t end = section.content.size(); end > 0; end -= section.element_bytes)
      section.content.insert(end, "later!!!");
    section.element_bytes += 8;
    SCOPED_TRACE(name);
    expect_same_scene(read(file_of(longer)), scene);
  }
}

/// As files of versions 10 to 14 have materials, and the first ones of version 15.
TEST_F(SceneSections, OldMaterialsStandBesideSurfacesOrAlone) {
  FileSection& materials = section_in(sections, "materials");
  FileSection old{"materials", 0, 48, 0, {}}, surfaces{"surfaces", 0, 80, 0, {}};
  for (std::size_t at = 0; at < materials.content.size(); at += 144) {
    const Bytes record = materials.content.substr(at, 144);
    old.content += record.substr(96, 36) + record.substr(76, 12);  // phong; ior, flags, mask_bit
    surfaces.content += record.substr(0, 76) + Bytes(4, '\0');
  }
  materials = old;
  sections.push_back(surfaces);
  expect_same_scene(read(file_of(sections)), scene);
  sections.back().content.resize(80);
  expect_refusal(file_of(sections), "1 surfaces, expected none or the 2 of the objects");
  for (Material& material : scene.materials) follow_phong(material);
  expect_same_scene(read(file_of(without(sections, "surfaces"))), scene);
}

TEST_F(SceneSections, WhatShorterRecordsDoNotHoldIsZero) {
  const auto cut = [&](const std::string& name, std::size_t length) {
    FileSection& section = section_in(sections, name);
    Bytes content;
    for (std::size_t at = 0; at < section.content.size(); at += section.element_bytes)
      content += section.content.substr(at, length);
    section.content = content;
    section.element_bytes = static_cast<std::uint32_t>(length);
  };
  cut("stations", 40);
  for (Station& station : scene.stations) station.noise_world = station.step_world = 0.0;
  expect_same_scene(read(file_of(sections)), scene);
  cut("lights", 104);
  scene.lights.front().spot_axis = {};
  scene.lights.front().spot_inner = scene.lights.front().spot_outer = scene.lights.front().range = 0.0;
  expect_same_scene(read(file_of(sections)), scene);
  cut("lights", 40);
  expect_refusal(file_of(sections), "section 'lights' with records of 40 bytes, expected at least 48");
}

TEST_F(SceneSections, OfAnotherFormAreRefused) {
  const auto says = [&](const char* name, auto FileSection::*member, auto value, const char* words) {
    expect_refusal_after(
        name, [&](FileSection& section) { section.*member = value; }, words);
  };
  says("node_pool", &FileSection::type, 3U, "section 'node_pool' of type 3, expected 5");
  says("node_pool", &FileSection::type, 0U, "section 'node_pool' of type 0, expected 5");
  says("lights", &FileSection::type, 7U, "section 'lights' with elements of 152 bytes, expected 1");
  says("node_pool", &FileSection::type, 8U, "section 'node_pool' of type 8, expected 0 to 7");
  says("node_pool", &FileSection::element_bytes, 8U,
       "section 'node_pool' with elements of 8 bytes, expected 4");
  says("lights", &FileSection::element_bytes, 0U, "section 'lights' with elements of 0 bytes");
  says("lights", &FileSection::element_bytes, 150U, "a multiple of its elements' 150");
  says("lights", &FileSection::flags, 2U, "section 'lights' with unknown flags");
  says("column.0", &FileSection::type, 7U, "with elements of 2 bytes, expected 1");
  says("crs", &FileSection::content, "no end", "section 'crs' of 0 names, expected 1");
  says("crs", &FileSection::content, Bytes("a\0b", 3),
       "section 'crs' of 1 names, expected 1, a zero byte after each");
  says("crs", &FileSection::name, "two\nlines", "a section without a proper name");
  says("crs", &FileSection::name, "", "a section without a proper name");
  says("camera", &FileSection::content, Bytes(2 * 88, 'c'), "section 'camera' of 2 records, expected one");
  says("root", &FileSection::content, "", "section 'root' of 0 records, expected one");
  says("color_pool", &FileSection::content, Bytes(12, 'c'), "3 colours, expected 4");
  says("column.3", &FileSection::content, Bytes(16, 'c'), "2 values of time, expected 4");
  says("column.3", &FileSection::name, "column.4", "expected 3");
}

TEST_F(SceneSections, ColumnsOfTypesThatTheyAreNotOfAreRefused) {
  expect_refusal_after(
      "column.2", [](FileSection& section) { section.type = 5; }, "section 'column.2' of a type");
}

TEST_F(SceneSections, NoMoreColumnsThanASceneMayHave) {
  const FileSection column = section_in(sections, "column.1");
  for (std::size_t i = scene.columns.size(); i <= COLUMNS_MOST; ++i) {
    sections.push_back(column);
    sections.back().name = "column." + std::to_string(i);
    section_in(sections, "column_names").content += Bytes("more\0", 5);
  }
  expect_refusal(file_of(sections), "section 'column_names' of 33 names, expected 32");
}

TEST_F(SceneSections, TablesThatContradictTheFileAreRefused) {
  const Bytes whole = file_of(sections);
  const auto refused = [&](std::size_t offset, std::uint64_t value) {
    Bytes forged = whole;
    put(forged, offset, value);
    reseal_header(forged);
    EXPECT_NE(refusal(forged), "") << offset << " " << value;
  };
  constexpr std::uint64_t FAR = 1ULL << 40U, MOST = UINT64_MAX;
  for (std::size_t entry = NAMED.begin; entry < head_bytes(whole); entry += NAMED.entry) {
    const auto place = get<std::uint64_t>(whole, entry + 40), size = get<std::uint64_t>(whole, entry + 48);
    for (const std::uint64_t other :
         std::vector<std::uint64_t>{0, place - 16, place + 16, place + 1, FAR, MOST})
      refused(entry + 40, other);
    for (const std::uint64_t other : std::vector<std::uint64_t>{size + 16, FAR, MOST, MOST - place})
      refused(entry + 48, other);
  }
  for (const std::uint64_t value : {0ULL, 3ULL, 1ULL << 31U, 0xFFFFFFFFULL}) {
    refused(32, value | 64ULL << 32U);                          // sections
    refused(32, get<std::uint32_t>(whole, 32) | value << 32U);  // bytes of an entry
    refused(40, value == 0 ? 1 : value);
  }
}

TEST_F(SceneSections, HeadsThatDoNotFitTheFileAreRefused) {
  for (const std::uint32_t size : {0U, 31U, 32U, 47U, 48U, 0x7FFFFFFFU, 0xFFFFFFFFU}) {
    Bytes forged = load();
    put(forged, 12, size);
    if (size < forged.size()) reseal_header(forged);
    EXPECT_NE(refusal(forged), "") << size;
  }
}

}  // namespace
}  // namespace splatray
