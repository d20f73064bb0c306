/// What records of LAS files hold beside positions and the usual attributes: normals, radii, further fields, extra bytes.
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>

#include "tests/readers/las_file.h"
#include "tests/temp_folder.h"

namespace splatray {
namespace {

/// The input that a file of these bytes is, with these attributes asked for.
Input input_of(const std::string& bytes, const std::vector<std::string>& attributes = {}) {
  const TempFolder folder;
  ReadOptions options;
  options.scans.attributes = attributes;
  return read_input({folder.write("a.las", bytes)}, options);
}

/// Two points with the extra bytes that these descriptors are of, `extra` in the first and zeros in the second.
std::string with_extra(const std::string& descriptors, const std::string& extra) {
  LasFile file;
  file.format = 1;
  file.records = {las_point(1000, 2000, 3000), las_point(-1000, 0, 7)};
  file.vlrs = {las_vlr("LASF_Spec", 4, descriptors)};
  file.extra_bytes = extra.size();
  file.records[0].extra = extra;
  file.records[1].extra = std::string(extra.size(), '\0');
  return file.bytes();
}

TEST(LasFields, NormalsAndRadiiOfExtraBytesAreThePoints) {
  const std::string normal = bytes_of(0.6F) + bytes_of(0.0F) + bytes_of(-0.8F);
  const auto three = [](const std::string& x, const std::string& y, const std::string& z) {
    return las_descriptor(9, x) + las_descriptor(9, y) + las_descriptor(9, z);
  };
  for (const std::string& descriptors :
       {three("NormalX", "NormalY", "NormalZ"), three("Nx", "Ny", "Nz"),
        three("normal_x", "normal_y", "normal_z"), three("nx", "ny", "nz"),
        three("normal[0]", "normal[1]", "normal[2]"), las_descriptor(29, "Normal")}) {
    const Input input =
        input_of(with_extra(descriptors + las_descriptor(9, "Radius"), normal + bytes_of(0.25F)));
    const Points& points = input.objects.at(0).points;
    EXPECT_EQ(points.normal, (std::vector<glm::vec3>{{0.6F, 0.0F, -0.8F}, glm::vec3(0.0F)})) << descriptors;
    EXPECT_EQ(points.radius, (std::vector<float>{0.25F, 0.0F})) << descriptors;
    EXPECT_TRUE(points.columns.size() == 2U) << "return and returns alone";
  }
}

TEST(LasFields, NormalsMayBeScaledIntegers) {
  const auto one = [](const char* name) { return las_descriptor(4, name, 8, 0.5); };
  const std::string numbers =
      bytes_of<std::int16_t>(-2) + bytes_of<std::int16_t>(0) + bytes_of<std::int16_t>(0);
  const Input input = input_of(with_extra(one("NormalX") + one("NormalY") + one("NormalZ"), numbers));
  ASSERT_EQ(input.objects.at(0).points.normal.size(), 2U);
  EXPECT_EQ(input.objects[0].points.normal[0], glm::vec3(-1.0F, 0.0F, 0.0F));
}

TEST(LasFields, NormalsThatLackAnAxisOrAreZeroAreNone) {
  const std::string two = las_descriptor(9, "NormalX") + las_descriptor(9, "NormalY");
  EXPECT_TRUE(input_of(with_extra(two, bytes_of(1.0F) + bytes_of(0.0F))).objects.at(0).points.normal.empty());
  const std::string zeros = las_descriptor(29, "Normal") + las_descriptor(9, "radius");
  const Input input = input_of(with_extra(zeros, std::string(16, '\0')));
  EXPECT_TRUE(input.objects.at(0).points.normal.empty());
  EXPECT_TRUE(input.objects.at(0).points.radius.empty());
}

/// Reads a file of two points of a format, whose first record has these bytes instead, with attributes asked for.
void expect_fields(unsigned format, const std::map<std::size_t, unsigned>& record,
                   const std::map<std::string, double>& expected) {
  LasFile file;
  file.format = format;
  file.version_minor = 4;
  file.records = {las_point(1, 2, 3), las_point(4, 5, 6)};
  std::string bytes = file.bytes();
  for (const auto& [at, value] : record) bytes[las_points_offset(bytes) + at] = static_cast<char>(value);
  std::vector<std::string> names;
  for (const auto& [name, value] : expected) names.push_back(name);
  const Input input = input_of(bytes, names);
  for (const auto& [name, value] : expected) {
    const Column* column = find_column(input.objects.at(0).points.columns, name);
    ASSERT_NE(column, nullptr) << name;
    EXPECT_DOUBLE_EQ(column->number(0), value) << name;
    EXPECT_EQ(column->number(1), 0.0) << name;
  }
  EXPECT_FALSE(has_note(input, "no input has"));
}

TEST(LasFields, FurtherFieldsOfRecordsAreKeptWhenAskedFor) {
  const std::map<std::string, double> both = {{"user_data", 200.0},       {"ScanAngleRank", -12.0},
                                              {"ScanDirectionFlag", 1.0}, {"edge_of_flight_line", 1.0},
                                              {"synthetic", 1.0},         {"key-point", 1.0}};
  expect_fields(3, {{14, 9 | 64 | 128}, {15, 2 | 32 | 64}, {16, 244}, {17, 200}}, both);
  std::map<std::string, double> extended = both;
  extended.insert({{"Overlap", 1.0}, {"scanner_channel", 3.0}});
  // An angle is counted in 0.006 degrees: -2000 is 0xF830.
  expect_fields(6, {{15, 1 | 2 | 8 | 3U << 4U | 64 | 128}, {17, 200}, {18, 0x30}, {19, 0xF8}}, extended);
}

TEST(LasFields, InfraredIsKeptWhenAskedFor) {
  const std::filesystem::path path = std::filesystem::path(CORPUS) / "las/pf10_items_v4.las";
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  std::uint16_t record_bytes = 0;
  std::memcpy(&record_bytes, bytes.data() + 105, sizeof record_bytes);
  ReadOptions options;
  options.scans.keep_withheld = true;
  options.scans.attributes = {"NIR"};
  const Input input = read_input({path}, options);
  const Column* nir = find_column(input.objects.at(0).points.columns, "NIR");
  ASSERT_NE(nir, nullptr);
  for (std::size_t i = 0; i < nir->size(); ++i) {
    std::uint16_t stored = 0;
    std::memcpy(&stored, bytes.data() + las_points_offset(bytes) + i * record_bytes + 36, sizeof stored);
    EXPECT_EQ(nir->number(i), stored);
  }
}

TEST(LasFields, WhatWasAskedForAndIsThereIsNotCalledMissing) {
  const std::string descriptors =
      las_descriptor(29, "v") + las_descriptor(1, "zero") + las_descriptor(13, "pair");
  const std::string extra = bytes_of(1.0F) + bytes_of(2.0F) + bytes_of(3.0F) + std::string(3, '\0');
  const Input input = input_of(with_extra(descriptors, extra), {"v", "zero", "pair", "user_data", "source"});
  EXPECT_FALSE(has_note(input, "no input has"));
  for (const char* name : {"v[0]", "v[2]", "zero", "user_data", "source"})
    EXPECT_NE(find_column(input.objects.at(0).points.columns, name), nullptr) << name;
  EXPECT_TRUE(has_note(input_of(with_extra(descriptors, extra), {"v", "absent"}), "no input has 'absent';"));
}

TEST(LasFields, IntegersThatDoublesRoundAreNamed) {
  const std::string descriptors = las_descriptor(7, "id") + las_descriptor(8, "key");
  const auto notes = [&](std::uint64_t id, std::int64_t key) {
    return input_of(with_extra(descriptors, bytes_of(id) + bytes_of(key)), {"id", "key"}).notes;
  };
  constexpr std::int64_t MOST_EXACT = std::int64_t{1} << 53;
  EXPECT_TRUE(notes(MOST_EXACT - 1, 1 - MOST_EXACT).empty());
  const std::vector<std::string> said = notes(MOST_EXACT + 1, -MOST_EXACT - 1);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_NE(said[0].find("'id', 'key'"), std::string::npos) << said[0];
}

}  // namespace
}  // namespace splatray
