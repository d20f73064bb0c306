/// What PLY says of scans.
#include <locale>

#include "tests/readers/read_error.h"

namespace splatray {
namespace {

std::string ply(const std::string& remarks, const std::string& properties, const std::string& more,
                const std::string& body, int vertices = 3) {
  return "ply\nformat ascii 1.0\n" + remarks + "element vertex " + std::to_string(vertices) +
         "\nproperty float x\nproperty float y\nproperty float z\n" + properties + more + "end_header\n" +
         body;
}

TEST(PlyScan, AttributesBecomeColumns) {
  const TempFolder folder;
  const std::string properties =
      "property uchar scalar_Classification\nproperty float confidence\nproperty float scalar_Intensity\n"
      "property int echo\nproperty int other\nproperty ushort scan_id\n";
  const auto file = folder.write(
      "a.ply",
      ply("", properties, "", "0 0 0 6 0.5 1.25 70000 1 4\n1 0 0 2 0.5 2 1 1 9\n2 0 0 2 1 3 2 1 4\n"));
  ReadOptions options;
  options.scans.attributes = {"Echo"};
  const Input input = read_input({file}, options);
  const Points& points = input.objects.at(0).points;
  const auto number = [&](std::string_view name) {
    const Column* column = find_column(points.columns, name);
    EXPECT_NE(column, nullptr) << name;
    return column == nullptr ? -1.0 : column->number(0);
  };
  EXPECT_EQ(number(COLUMN_CLASS), 6.0);
  EXPECT_EQ(number(COLUMN_INTENSITY), 1.25);
  EXPECT_EQ(number("confidence"), 0.5);
  EXPECT_EQ(number("Echo"), 70000.0);
  EXPECT_EQ(number(COLUMN_SCAN), 4.0);
  EXPECT_EQ(points.station, (std::vector<std::uint16_t>{0, 1, 0}));
  EXPECT_EQ(points.stations.at(1).name, "9");
  EXPECT_TRUE(has_note(input, "skipped vertex properties 'other'"));
  EXPECT_EQ(find_column(read_input({file}, {}).objects[0].points.columns, "Echo"), nullptr);
}

TEST(PlyScan, MeshesHaveNoColumns) {
  const TempFolder folder;
  ReadOptions few;
  few.samples = 50;
  const Input input =
      read_input({folder.write("m.ply", ply("comment sensor 0 0 1\n", "property float confidence\n",
                                            "element face 1\nproperty list uchar int vertex_indices\n",
                                            "0 0 0 1\n1 0 0 1\n0 1 0 1\n3 0 1 2\n"))},
                 few);
  EXPECT_TRUE(input.objects.at(0).points.columns.empty());
  EXPECT_TRUE(input.objects[0].points.stations.empty());
  EXPECT_TRUE(has_note(input, "skipped vertex properties 'confidence'"));
}

TEST(PlyScan, RangeGridsOfStanford) {
  const TempFolder folder;
  const auto grid = [&](const std::string& rows, const std::string& body) {
    return folder.write("g.ply", ply("obj_info num_cols 3\nobj_info num_rows " + rows + "\n", "",
                                     "element range_grid 6\nproperty list uchar int vertex_indices\n",
                                     "0 0 0\n1 0 0\n0 1 0\n" + body));
  };
  const std::string cells = "0\n1 0\n0\n1 2\n0\n1 1\n";
  const Input input = read_input({grid("2", cells)}, {});
  const Points& points = input.objects.at(0).points;
  EXPECT_EQ(points.grid_cell, (std::vector<std::uint32_t>{1, 5, 3}));
  EXPECT_EQ(points.stations.at(0).rows, 2U);
  EXPECT_EQ(points.stations.at(0).columns, 3U);
  EXPECT_TRUE(input.notes.empty());
  const Input other = read_input({grid("5", cells)}, {});
  EXPECT_TRUE(other.objects.at(0).points.grid_cell.empty());
  EXPECT_TRUE(has_note(other, "skipped elements 'range_grid'"));
  EXPECT_NE(read_error(grid("2", "0\n1 0\n0\n1 3\n0\n1 1\n"))
                .find("line 18: a cell of the range grid has vertex 3"),
            std::string::npos);
}

TEST(PlyScan, SensorsStandInRemarks) {
  const TempFolder folder;
  const std::string body = "0 0 0 4\n1 0 0 9\n2 0 0 4\n";
  const auto stations = [&](const std::string& remarks, const std::string& property) {
    return read_input({folder.write("s.ply", ply(remarks, "property uchar " + property + "\n", "", body))},
                      {})
        .objects.at(0)
        .points.stations;
  };
  EXPECT_EQ(stations("comment sensor 0 0.0 -0.5 1\n", "ring").at(0).sensor_world, glm::dvec3(0.0, -0.5, 1.0));
  EXPECT_EQ(stations("comment sensor 0.25 -0.5 1\n", "ring").at(0).sensor_world, glm::dvec3(0.25, -0.5, 1.0));
  EXPECT_FALSE(stations("comment sensor 0 0 0 99\n", "ring").at(0).sensor_world) << "too far to be credible";
  EXPECT_TRUE(stations("comment sensor of 3 megapixels\n", "ring").empty());
  const std::vector<Station> two = stations("comment sensor 9 0 0 1\ncomment sensor 4 0 1 0\n", "scan");
  ASSERT_EQ(two.size(), 2U);
  EXPECT_EQ(two[0].sensor_world, glm::dvec3(0.0, 1.0, 0.0));
  EXPECT_EQ(two[1].sensor_world, glm::dvec3(0.0, 0.0, 1.0));
}

/// Numbers with a comma and points between thousands, as a program may ask for that embeds the library.
struct Commas : std::numpunct<char> {
  [[nodiscard]] char do_decimal_point() const override { return ','; }
  [[nodiscard]] char do_thousands_sep() const override { return '.'; }
  [[nodiscard]] std::string do_grouping() const override { return "\3"; }
};

TEST(PlyScan, TheLocaleOfTheProgramDoesNotMatter) {
  const TempFolder folder;
  const std::filesystem::path file = folder.write(
      "l.ply",
      ply("comment sensor 0.25 -0.5 1\n", "property uchar ring\n", "", "0 0.5 0 4\n1000 0 0 9\n2 0 1.5 4\n"));
  const std::locale before = std::locale::global(std::locale(std::locale(), new Commas));
  const Points points = read_input({file}, {}).objects.at(0).points;
  std::locale::global(before);
  EXPECT_EQ(points.stations.at(0).sensor_world, glm::dvec3(0.25, -0.5, 1.0));
  EXPECT_EQ(points.position.at(1), glm::dvec3(1000.0, 0.0, 0.0));
  EXPECT_EQ(points.position.at(2), glm::dvec3(2.0, 0.0, 1.5));
}

}  // namespace
}  // namespace splatray
