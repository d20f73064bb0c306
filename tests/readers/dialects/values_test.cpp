/// Colours of any scale, coordinates that stand for "no data", and fields by the names that people give them.
#include "engine/base/srgb.h"
#include "preprocess/read/scan/stored_colors.h"
#include "tests/readers/las_file.h"
#include "tests/readers/scan_reading.h"

namespace splatray {
namespace {

double full_of(std::initializer_list<std::pair<double, int>> values, bool floats = false) {
  ColorRange range(floats);
  for (const auto& [value, times] : values)
    for (int i = 0; i < times; ++i) range.add(value);
  return range.full();
}

TEST(ColorRange, IsTheLeastScaleThatAllButAFewValuesFit) {
  EXPECT_EQ(full_of({{0, 5}, {1, 3}}), 1.0);
  EXPECT_EQ(full_of({{0.2, 5}, {0.9, 3}}), 1.0);
  EXPECT_EQ(full_of({{100, 500}, {256, 500}}), 255.0) << "rounded up";
  EXPECT_EQ(full_of({{100, 500}, {65535, 2}}), 255.0) << "outliers";
  EXPECT_EQ(full_of({{0, 5000}, {100, 500}, {1023, 10}}), 1023.0);
  EXPECT_EQ(full_of({{100, 500}, {4095, 100}}), 4095.0);
  EXPECT_EQ(full_of({{100, 500}, {40000, 100}}), 65535.0);
  EXPECT_EQ(full_of({{0.5, 500}, {1.7, 100}}), 1.0) << "light beyond white";
  EXPECT_EQ(full_of({{0.5, 500}, {200.5, 100}}), 255.0);
  EXPECT_EQ(full_of({{2, 5}, {7, 3}}), 255.0) << "dark 8 bits";
  EXPECT_EQ(full_of({{2, 5}}, true), 1.0);
  EXPECT_EQ(full_of({{INFINITY, 5}, {NAN, 3}, {9, 1}}), 255.0);
}

class Values : public ::testing::Test {
 protected:
  Input read(const std::string& name, const std::string& bytes) {
    return read_input({folder_.write(name, bytes)}, {});
  }
  TempFolder folder_;
};

/// A text of 600 points of one grey, and one that is another.
std::string grey(const std::string& value, const std::string& other) {
  std::string text = "x y z r g b\n";
  for (int i = 0; i < 600; ++i) {
    const std::string& v = i == 7 ? other : value;
    text += std::to_string(i % 30) + " " + std::to_string(i / 30) + " 0 " + v + " " + v + " " + v + "\n";
  }
  return text;
}

TEST_F(Values, ColoursOfOddScalesAreReadAndNoted) {
  EXPECT_NEAR(read("a.txt", grey("128", "256")).objects[0].points.color[0].x, srgb_to_linear(128.0F / 255.0F),
              1e-6);
  const Input outlier = read("b.txt", grey("128", "9000"));
  EXPECT_NEAR(outlier.objects[0].points.color[0].x, srgb_to_linear(128.0F / 255.0F), 1e-6);
  EXPECT_TRUE(has_note(outlier, "3 values above it are taken as full"));
  const Input ten = read("c.txt", grey("512", "1023"));
  EXPECT_NEAR(ten.objects[0].points.color[0].x, srgb_to_linear(512.0F / 1023.0F), 1e-6);
  EXPECT_TRUE(has_note(ten, "colours are taken as of 0 to 1023"));
  EXPECT_TRUE(has_note(read("d.txt", grey("0", "0")), "all black and were left out"));
}

TEST_F(Values, ColoursOfPlyAreJudgedByTypeAndValues) {
  const auto red = [&](const std::string& type, const std::string& value) {
    return read("a.ply",
                "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
                "z\n"
                "property " +
                    type + " red\nproperty " + type + " green\nproperty " + type +
                    " blue\nend_header\n0 0 0 " + value + " 0 0\n")
        .objects.at(0)
        .points.color.at(0)
        .x;
  };
  EXPECT_NEAR(red("uint", "32896"), srgb_to_linear(32896.0F / 65535.0F), 1e-5);
  EXPECT_NEAR(red("uint", "128"), srgb_to_linear(128.0F / 255.0F), 1e-6);
  EXPECT_NEAR(red("uchar", "1"), srgb_to_linear(1.0F / 255.0F), 1e-6);
  EXPECT_NEAR(red("ushort", "1000"), srgb_to_linear(1000.0F / 1023.0F), 1e-3);
  EXPECT_NEAR(red("float", "128"), srgb_to_linear(128.0F / 255.0F), 1e-6);
  EXPECT_NEAR(red("double", "0.5"), srgb_to_linear(0.5F), 1e-6);
}

TEST_F(Values, ObjColoursOf16Bits) {
  EXPECT_NEAR(read("a.obj", "v 0 0 0 32896 0 0\nv 1 0 0 65535 0 0\nv 0 1 0 0 0 0\n")
                  .objects.at(0)
                  .points.color.at(0)
                  .x,
              srgb_to_linear(32896.0F / 65535.0F), 1e-5);
}

/// 400 points of a surface whose heights lie between `low` and `low` + 2, with every fourth point as `odd` has it.
std::string surface(double x0, double low, const std::string& odd) {
  std::string text;
  for (int i = 0; i < 400; ++i) {
    const std::string place = std::to_string(x0 + i % 20) + " " + std::to_string(x0 + i / 20.0) + " ";
    text += i % 4 == 1 ? (odd.find(' ') == std::string::npos ? place + odd : odd) + "\n"
                       : place + std::to_string(low + 0.005 * i) + "\n";
  }
  return text;
}

TEST_F(Values, ValuesFarFromAllOthersThatManyShareAreNoData) {
  for (const auto& [x0, low, odd] : {std::tuple(0.0, 0.0, "-9999"),
                                     {0.0, 0.0, "1e20"},
                                     {0.0, 400.0, "-32767"},
                                     {500000.0, 400.0, "0 0 0"},
                                     {500000.0, 400.0, "-99999 -99999 -99999"},
                                     {0.0, 0.0, "3.4028235e38"}}) {
    const Input input = read("a.xyz", surface(x0, low, odd));
    EXPECT_EQ(input.objects.at(0).points.size(), 300U) << odd;
    EXPECT_EQ(input.scan_counts.no_return, 100U) << odd;
    EXPECT_TRUE(has_note(input, "taken as without data")) << odd;
  }
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 400\nproperty double x\nproperty double y\nproperty double z\n"
      "end_header\n" +
      surface(0.0, 0.0, "-9999");
  EXPECT_EQ(read("b.ply", ply).objects.at(0).points.size(), 300U);
}

TEST_F(Values, FloorsAndSingleStraysAreKept) {
  for (const auto& [low, odd] : {std::pair(0.0, "0"), {2.5, "0"}, {0.0, "-15"}, {30.0, "0"}})
    EXPECT_EQ(read("a.xyz", surface(0.0, low, odd)).objects.at(0).points.size(), 400U)
        << odd << " below " << low;
  EXPECT_EQ(read("b.xyz", surface(0.0, 0.0, "1") + "5 5 -9999\n").objects.at(0).points.size(), 401U)
      << "one alone is a stray, which is left out later";
  std::string raster;  // of heights at 1000, 20 km wide, where -9999 is no farther than the sides are long
  for (int i = 0; i < 400; ++i)
    raster += std::to_string(i % 20 * 1000) + " " + std::to_string(i / 20 * 1000) +
              (i % 3 == 0 ? " -9999\n" : " 1000.5\n");
  EXPECT_LT(read("c.xyz", raster).objects.at(0).points.size(), 300U);
}

TEST_F(Values, FieldsOfPcdHaveAliases) {
  const std::string tail = "\nWIDTH 3\nHEIGHT 1\nPOINTS 3\nDATA ascii\n";
  for (const std::string colors : {"r g b", "red green blue", "Red Green Blue"}) {
    const ReadScan scan = read_scan(folder_.write(
        "a.pcd", "FIELDS x y z " + colors +
                     " nx ny nz Reflectance\nSIZE 4 4 4 1 1 1 4 4 4 4\nTYPE F F F U U U F F F F\n"
                     "COUNT 1 1 1 1 1 1 1 1 1 1" +
                     tail + "0 0 0 255 0 9 0 0 1 5\n1 0 0 1 2 3 0 0 1 6\n0 1 0 1 2 3 0 0 1 7\n"));
    EXPECT_EQ(scan.file.points.stored_color.at(0), glm::u16vec3(255, 0, 9)) << colors;
    EXPECT_EQ(scan.file.points.normal.at(2), glm::vec3(0, 0, 1));
    EXPECT_EQ(find_column(scan.file.points.columns, COLUMN_INTENSITY)->number(2), 7.0);
    EXPECT_FALSE(scan.has_note("skipped"));
  }
}

TEST_F(Values, WordsOfPcdAreInAnyCase) {
  EXPECT_EQ(
      read("a.pcd",
           "fields X Y Z\nsize 4 4 4\ntype f f f\ncount 1 1 1\nWidth 3\nHeight 1\npoints 3\ndata ASCII\n"
           "0 0 0\n1 0 0\n0 1 0\n")
          .objects.at(0)
          .points.size(),
      3U);
}

TEST_F(Values, PcdOfOneColumnIsNoGridAndOddViewpointsAreLeftOut) {
  const std::string head = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 3\n";
  const std::string body = "POINTS 3\nDATA ascii\n0 0 0\n1 0 0\n0 1 0\n";
  const ReadScan column = read_scan(folder_.write("a.pcd", head + "VIEWPOINT 0 0 0 1 0 0 0\n" + body));
  EXPECT_EQ(column.file.points.size(), 3U);
  EXPECT_TRUE(column.file.points.grid_cell.empty());
  EXPECT_EQ(column.file.points.stations.at(0).rows, 0U);
  EXPECT_TRUE(column.notes.empty());
  for (const std::string viewpoint : {"0 0 0 1", "nan 0 0 1 0 0 0", "0 0 0 0 0 0 0", "", "a b c d e f g"}) {
    const ReadScan scan = read_scan(folder_.write("b.pcd", head + "VIEWPOINT " + viewpoint + "\n" + body));
    EXPECT_EQ(scan.file.points.size(), 3U);
    EXPECT_FALSE(scan.file.points.stations.at(0).sensor_world) << viewpoint;
    EXPECT_TRUE(scan.has_note("VIEWPOINT")) << viewpoint;
  }
}

TEST_F(Values, SweepsOfKittiMayHaveHolesAndAnyReflectance) {
  std::string bytes;
  for (const float v : {10.0F, -2.0F, 1.5F, -3.0F, NAN, 4.0F, 5.0F, 1.0F, 2500.0F, 4.0F, 5.0F, 70000.0F,
                        INFINITY, 0.0F, 0.0F, NAN})
    bytes += bytes_of(v);
  const ReadScan scan = read_scan(folder_.write("a.bin", bytes));
  ASSERT_EQ(scan.file.points.size(), 2U);
  EXPECT_EQ(scan.file.points.position[1], glm::dvec3(2500, 4, 5));
  EXPECT_EQ(scan.file.counts.no_return, 2U);
  EXPECT_TRUE(scan.has_note("2 of 4 points"));
  EXPECT_EQ(find_column(scan.file.points.columns, COLUMN_INTENSITY)->number(0), -3.0);
}

}  // namespace
}  // namespace splatray
