/// Files that are read together, and what is left where they hold nothing to read.
#include "tests/readers/e57/read_bytes.h"
#include "tests/readers/las_file.h"
#include "tests/readers/read_error.h"
#include "tests/readers/scan_reading.h"

namespace splatray {
namespace {

LasFile tile(double x, double y) {
  LasFile file;
  file.offset = {x, y, 0.0};
  file.records.resize(100);
  for (std::int32_t i = 0; i < 100; ++i)
    file.records[static_cast<std::size_t>(i)].position = {100 * (i % 10), 100 * (i / 10), i};
  return file;
}

LasFile in_system(LasFile file, const std::string& wkt) {
  file.vlrs = {las_vlr("LASF_Projection", 2112, wkt + std::string(1, '\0'))};
  return file;
}

/// The sentence of the Error that reading ends in; empty where it does not.
std::string refusal(const std::vector<std::filesystem::path>& paths) {
  try {
    static_cast<void>(read_input(paths, {}));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::input_unreadable);
    return error.what();
  }
  return "";
}

TEST(Folder, WhatIsNoScanIsLeftOutWithANote) {
  const TempFolder folder;
  folder.write("tiles/a.las", tile(0.0, 0.0).bytes());
  folder.write("tiles/b.las", tile(1.0, 0.0).bytes());
  folder.write("tiles/readme.txt", "Two tiles of a survey, in metres.\n");
  folder.write("tiles/firmware.bin",
               "\x7f"
               "ELF and more that is no sweep");
  const Input input = read_input({folder.path() / "tiles"}, {});
  ASSERT_EQ(input.objects.size(), 1U);
  EXPECT_EQ(input.objects[0].points.size(), 200U);
  EXPECT_TRUE(has_note(input, "readme.txt"));
  EXPECT_TRUE(has_note(input, "firmware.bin"));
  EXPECT_TRUE(has_note(input, "it was left out"));
}

TEST(Folder, WhatIsNamedOrCanOnlyBeAScanIsNotLeftOut) {
  const TempFolder folder;
  const std::filesystem::path readme = folder.write("tiles/readme.txt", "Nothing but words.\n");
  EXPECT_NE(refusal({folder.path() / "tiles"}).find("readme.txt"), std::string::npos)
      << "nothing else is there";
  folder.write("tiles/a.las", tile(0.0, 0.0).bytes());
  EXPECT_NE(refusal({folder.path() / "tiles" / "a.las", readme}).find("readme.txt"), std::string::npos);
  folder.write("tiles/b.las", "no LAS at all");
  EXPECT_NE(refusal({folder.path() / "tiles"}).find("b.las"), std::string::npos);
}

TEST(Systems, OneThatIsKnownIsThatOfAll) {
  const TempFolder folder;
  const std::string utm = R"(PROJCS["UTM 32",UNIT["metre",1],AUTHORITY["EPSG","25832"]])";
  const auto a = folder.write("a.las", in_system(tile(0.0, 0.0), utm).bytes());
  const auto b = folder.write("b.las", tile(1.0, 0.0).bytes());
  const auto c = folder.write(
      "c.las", in_system(tile(2.0, 0.0), R"(PROJCRS["32N",LENGTHUNIT["metre",1],ID["EPSG",25832]])").bytes());
  const Input input = read_input({b, a, c}, {});
  EXPECT_EQ(input.crs, utm) << "the same by number";
  EXPECT_FALSE(has_note(input, "coordinate systems"));
}

TEST(Systems, DifferentOnesAreUnknownAndReported) {
  const TempFolder folder;
  const auto a = folder.write("a.las", in_system(tile(0.0, 0.0), R"(PROJCS["32N",UNIT["metre",1]])").bytes());
  const auto b = folder.write("b.las", in_system(tile(1.0, 0.0), R"(PROJCS["33N",UNIT["metre",1]])").bytes());
  const Input input = read_input({a, b}, {});
  EXPECT_EQ(input.crs, "");
  EXPECT_TRUE(has_note(input, "a.las, "));
  EXPECT_TRUE(has_note(input, "found the coordinate systems '32N' and '33N', expected one"));
}

TEST(Folder, PlyScansAreScans) {
  const TempFolder folder;
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
      "end_header\n1 2 3\n4 5 6\n";
  folder.write("scans/a.ply", ply);
  folder.write("scans/b.ply", ply);
  EXPECT_EQ(read_input({folder.path() / "scans"}, {}).objects.size(), 2U);
}

TEST(NoPoints, WhatBecameOfThemIsReported) {
  const TempFolder folder;
  LasFile file = tile(0.0, 0.0);
  for (std::size_t i = 0; i < file.records.size(); ++i) {
    file.records[i].is_withheld = i < 97;
    file.records[i].classification = i < 97 ? 2 : 7;
  }
  const std::filesystem::path las = folder.write("a.las", file.bytes());
  EXPECT_NE(read_error(las).find("found no points to keep: of 100 points, 97 withheld, 3 of the classes of "
                                 "noise; expected at least one other (--keep-withheld"),
            std::string::npos)
      << read_error(las);
  ReadOptions options;
  options.scans.keep_withheld = true;
  EXPECT_EQ(read_input({las}, options).objects[0].points.size(), 100U);
  EXPECT_NE(read_error(folder.write("a.xyz", "1 2 nan\n1 2 nan\n")).find("2 without a finite position"),
            std::string::npos);
}

const char* const UTM = "PROJCS[\"WGS 84 / UTM zone 32N\",UNIT[\"metre\",1]]";
const char* const DEGREES = "GEOGCS[\"WGS 84\",UNIT[\"degree\",0.0174532925199433]]";

/// Files of three points each by extension, and files of none.
const std::vector<std::pair<std::string, std::string>> FULL_SCANS = {
    {"full.csv", "x,y,z,intensity,r,g,b\n0,0,0,1,9,9,9\n1,0,0,2,9,9,9\n0,1,0,3,9,9,9\n"},
    {"full.xyz", "0 0 0\n1 0 0\n0 1 0\n"},
    {"full.pts", "3\n0 0 0 5\n1 0 0 6\n0 1 0 7\n"},
    {"full.pcd",
     "FIELDS x y z ring\nSIZE 4 4 4 2\nTYPE F F F U\nWIDTH 3\nHEIGHT 1\nPOINTS 3\nDATA ascii\n"
     "0 0 0 1\n1 0 0 2\n0 1 0 3\n"},
    {"full.ptx",
     "3\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n1 0 0 0.5\n2 0 0 0.5\n0 1 1 "
     "0.5\n"},
    {"full.e57", testing::e57_bytes(testing::line_scan(3))}};

std::vector<std::pair<std::string, std::string>> empty_scans() {
  LasFile noise = tile(0.0, 0.0), withheld = tile(0.0, 0.0), none = tile(0.0, 0.0);
  for (LasRecord& record : noise.records) record.classification = 7;
  for (LasRecord& record : withheld.records) record.is_withheld = true;
  none.records.clear();
  return {{"empty.csv", "x,y,z\n"},
          {"empty.xyz", "0 0 nan\n"},
          {"empty.pts", "0\n"},
          {"empty.pcd", "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 0\nHEIGHT 1\nPOINTS 0\nDATA binary\n"},
          {"empty.ptx", "1\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n0 0 0 0.5\n"},
          {"empty.e57", testing::e57_bytes(testing::line_scan(0))},
          {"no_scans.e57", testing::e57_bytes(testing::E57TestFile{})},
          {"noise.las", noise.bytes()},
          {"withheld.las", withheld.bytes()},
          {"header.las", none.bytes()},
          {"empty.ply",
           "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float "
           "z\nend_header\n"},
          {"empty.gltf", R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[]}]})"}};
}

TEST(NoPoints, AnEmptyFileIsLeftOutBesideOthers) {
  const TempFolder folder;
  for (const auto& [full_name, full_bytes] : FULL_SCANS)
    for (const auto& [empty_name, empty_bytes] : empty_scans()) {
      SCOPED_TRACE(full_name + " and " + empty_name);
      const auto full = folder.write(full_name, full_bytes), empty = folder.write(empty_name, empty_bytes);
      for (const auto& order :
           {std::vector{full, empty}, {empty, full}, {full, empty, full}, {empty, full, empty}}) {
        const Input input = read_input(order, {});
        ASSERT_EQ(input.objects.size(), 1U);
        const Points& points = input.objects[0].points;
        EXPECT_EQ(points.size(), order.size() == 3 && order[0] == full ? 6U : 3U);
        for (const Column& column : points.columns) EXPECT_EQ(column.size(), points.size()) << column.name;
        EXPECT_TRUE(has_note(input, empty.stem().string()));
      }
    }
}

TEST(NoPoints, EmptyFilesAloneAreRefusedInOneSentence) {
  const TempFolder folder;
  for (const auto& [name, bytes] : empty_scans()) {
    const auto empty = folder.write(name, bytes), other = folder.write("other.csv", "x,y,z\n");
    EXPECT_NE(refusal({empty, other}).find("found no points"), std::string::npos) << name;
    EXPECT_NE(refusal({other, empty}).find("found no points"), std::string::npos) << name;
  }
}

TEST(NoPoints, AnEmptyTileSaysNothingOfTheOthers) {
  const TempFolder folder;
  LasFile none = in_system(tile(0.0, 0.0), DEGREES);
  none.records.clear();
  folder.write("tiles/a.las", in_system(tile(9.0, 47.0), UTM).bytes());
  folder.write("tiles/b.las", none.bytes());
  const Input input = read_input({folder.path() / "tiles"}, {});
  EXPECT_EQ(input.objects.at(0).points.size(), 100U);
  EXPECT_EQ(input.objects[0].name, "a");
  EXPECT_EQ(input.crs, UTM);
}

/// A scan of an E57 or PTX in which nothing was measured has no station of the scene.
TEST(NoPoints, EmptyScansInAFileAreLeftOut) {
  const TempFolder folder;
  const auto scan = [](const std::string& name, int count) {
    testing::E57TestScan made = testing::line_scan(count);
    made.xml = "<name type=\"String\">" + name + "</name>";
    return made;
  };
  const auto file =
      folder.write("a.e57", testing::e57_bytes(testing::E57TestFile{
                                {scan("hall", 0), scan("stairs", 2), scan("roof", 0), scan("yard", 1)}}));
  const Input input = read_input({file}, {});
  const Points& points = input.objects.at(0).points;
  EXPECT_TRUE(has_note(input, "found no points in 'hall', 'roof'"));
  ASSERT_EQ(points.stations.size(), 2U);
  EXPECT_EQ(points.stations[0].name, "stairs");
  EXPECT_EQ(points.stations[1].name, "yard");
  EXPECT_EQ(points.station, (std::vector<std::uint16_t>{0, 0, 1}));
}

TEST(OneSystem, DegreesAndLengthsAreRefused) {
  const TempFolder folder;
  const auto a = folder.write("utm.las", in_system(tile(9.0, 47.0), UTM).bytes());
  const auto b = folder.write("degrees.las", in_system(tile(9.0, 47.0), DEGREES).bytes());
  const auto c = folder.write("unknown.las", tile(9.0, 47.0).bytes());
  const std::string sentence = refusal({a, c, b});
  EXPECT_NE(sentence.find("utm.las"), std::string::npos);
  EXPECT_NE(sentence.find("degrees.las"), std::string::npos);
  EXPECT_NE(sentence.find("expected scans in one coordinate system"), std::string::npos);
  EXPECT_EQ(refusal({b, b, c}), "");
  EXPECT_EQ(refusal({a, c}), "");
}

TEST(OneSystem, ScansThatNoSceneHoldsTogetherAreRefused) {
  const TempFolder folder;
  const auto here = folder.write("here.las", tile(0.0, 0.0).bytes());
  const auto there = folder.write("there.las", tile(5e5, 5.2e6).bytes());
  const auto beside = folder.write("beside.las", tile(5e5 + 1.0, 5.2e6).bytes());
  const std::string sentence = refusal({there, here, beside});
  EXPECT_NE(sentence.find("here.las"), std::string::npos);
  EXPECT_NE(sentence.find("apart, which are"), std::string::npos) << sentence;
  EXPECT_EQ(refusal({there, beside}), "");
}

/// One a metre across beside the other 200 metres away: stations of one survey.
TEST(OneSystem, StationsFarApartStay) {
  const TempFolder folder;
  const auto here = folder.write("here.las", tile(0.0, 0.0).bytes());
  const auto there = folder.write("there.las", tile(200.0, 0.0).bytes());
  EXPECT_EQ(refusal({here, there}), "");
}

TEST(Pcd, NumbersMayHaveCommasBetween) {
  const TempFolder folder;
  const std::string head = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n";
  for (const char* rows : {"1,2,3\n4,5.5,6\n", "1, 2, 3\n4, 5.5, 6\n", "\n# points\n1 2 3\n4 5.5 6\n"}) {
    const ReadScan scan = read_scan(folder.write("a.pcd", head + rows));
    ASSERT_EQ(scan.file.points.size(), 2U) << rows;
    EXPECT_EQ(scan.file.points.position[1], glm::dvec3(4.0, 5.5, 6.0)) << rows;
  }
}

std::string floats(const std::vector<float>& values) {
  std::string bytes;
  for (const float value : values) bytes += bytes_of(value);
  return bytes;
}

TEST(Kitti, PointsMayHaveARing) {
  const TempFolder folder;
  std::string bytes;
  for (int i = 0; i < 40; ++i)  // as many bytes as 50 points of four floats have
    bytes += floats({10.0F + float(i), 3.0F, 2.0F, 7.0F, float(i % 32)});
  ScanOptions options;
  options.attributes = {"ring"};
  const ReadScan scan = read_scan(folder.write("a.pcd.bin", bytes), options);
  ASSERT_EQ(scan.file.points.size(), 40U);
  EXPECT_EQ(scan.file.points.position[39], glm::dvec3(49.0, 3.0, 2.0));
  ASSERT_NE(find_column(scan.file.points.columns, "ring"), nullptr);
  EXPECT_EQ(find_column(scan.file.points.columns, "ring")->number(39), 7.0);
  std::string four;
  for (int i = 0; i < 50; ++i) four += floats({10.5F + float(i), 3.25F, 2.125F, 0.5F});
  EXPECT_EQ(read_scan(folder.write("b.bin", four)).file.points.size(), 50U);
}

}  // namespace
}  // namespace splatray
