/// What levels hold of points, and of what they say that it is lost.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "preprocess/levels/write_levels.h"
#include "preprocess/read/tiles/ept.h"
#include "tests/temp_folder.h"

namespace splatray {
namespace {

Points read_levels(const std::filesystem::path& path, const ReadOptions& options) {
  std::vector<std::string> notes;
  Points points = read_ept(path, options, {notes, options.progress}).points;
  EXPECT_TRUE(notes.empty()) << notes.front();
  return points;
}

TEST(LevelContents, CountTheirMeansBesideAnAttributeOfThatName) {
  const TempFolder folder;
  const std::filesystem::path ept = folder.path() / "own/ept.json";
  std::string text;
  for (int i = 0; i < 60000; ++i) text += std::to_string(i % 250) + ' ' + std::to_string(i / 250) + " 0 7\n";
  ReadOptions options;
  options.scans.columns = "x,y,z,PointCount";
  options.scans.attributes = {COLUMN_POINT_COUNT};
  LevelSteps steps;
  steps.most_part_points = 30000;
  write_levels({folder.write("own.xyz", text)}, options, steps, ept);
  ReadOptions root;
  root.nodes[ept] = {0};
  const auto counted = [&] {
    const Points points = read_levels(ept, root);
    EXPECT_LT(points.size(), 60000U);
    EXPECT_EQ(std::accumulate(points.mean_of.begin(), points.mean_of.end(), std::uint64_t{0}), 60000U);
    const Column& column = *find_column(points.columns, COLUMN_POINT_COUNT);
    std::vector<double> numbers;
    for (std::size_t i = 0; i < points.size(); ++i) numbers.push_back(column.number(i));
    return std::pair(numbers, std::vector<double>(points.mean_of.begin(), points.mean_of.end()));
  };
  const auto [shown, counts] = counted();
  EXPECT_EQ(shown, counts);
  root.scans.attributes = {COLUMN_POINT_COUNT};
  const auto [own, same] = counted();
  EXPECT_EQ(own, std::vector<double>(own.size(), 7.0));
  EXPECT_EQ(same, counts);
  EXPECT_TRUE(read_levels(ept, options).mean_of.empty());
}

TEST(LevelContents, SayWhatTheyDoNotHold) {
  const TempFolder folder;
  const auto notes_of = [&](const std::string& name, const std::string& properties,
                            const std::string& values) {
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n" +
        properties + "end_header\n";
    for (const char* place : {"0 0 0", "1 0 0", "0 1 0"}) text += place + (' ' + values) + '\n';
    return write_levels({folder.write(name + ".ply", text)}, {}, {}, folder.path() / name / "ept.json").notes;
  };
  const auto expect_note = [&](const std::vector<std::string>& notes, const std::string& words) {
    EXPECT_EQ(std::count_if(notes.begin(), notes.end(),
                            [&](const std::string& note) { return note.find(words) != std::string::npos; }),
              1)
        << words;
  };
  EXPECT_TRUE(notes_of("plain", "", "").empty());
  EXPECT_TRUE(notes_of("unknown", "property float radius\n", "0").empty());
  expect_note(notes_of("discs", "property float radius\n", "0.5"),
              "discs.ply: levels do not hold the radii of its points; a .soct does");
  std::string properties;
  for (const char* name : {"f_dc_0", "f_dc_1", "f_dc_2", "opacity", "scale_0", "scale_1", "scale_2", "rot_0",
                           "rot_1", "rot_2", "rot_3"})
    properties += std::string("property float ") + name + '\n';
  expect_note(notes_of("capture", properties, "0 0 0 9 -1 -2 -5 1 0 0 0"),
              "the up direction 0,-1,0 (it is read with 0,0,1) of its points");
}

}  // namespace
}  // namespace splatray
