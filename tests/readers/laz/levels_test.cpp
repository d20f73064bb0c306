/// Scans written as levels and read again: the same points, in an octree, whatever interrupted the writing.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <tuple>

#include "preprocess/levels/level_folder.h"
#include "preprocess/levels/level_nodes.h"
#include "preprocess/levels/write_levels.h"
#include "preprocess/read/formats.h"
#include "preprocess/read/scan/input_files.h"
#include "preprocess/read/tiles/ept.h"
#include "preprocess/read/tiles/read_json.h"
#include "preprocess/read/tiles/tile_schema.h"
#include "tests/readers/las_file.h"
#include "tests/readers/read_error.h"
#include "tests/temp_folder.h"

namespace splatray {
namespace {

constexpr std::size_t POINTS = 70000;  ///< of a file: more than a node has that is not divided

/// Hilly ground far from the origin, a few towers, some points at one place.
std::string ground_las(unsigned seed) {
  std::mt19937_64 random(seed);
  LasFile file;
  file.offset = {500000.0, 4600000.0, 100.0};
  for (std::size_t i = 0; i < POINTS; ++i) {
    LasRecord record;
    const auto x = static_cast<std::int32_t>(random() % 200000),
               y = static_cast<std::int32_t>(random() % 200000);
    record.position = {
        x, y, static_cast<std::int32_t>(i % 100 == 0 ? random() % 40000 : 5 * ((x / 300 + y / 700) % 50))};
    if (i % 1000 == 0) record.position = {77, 77, 77};
    record.intensity = static_cast<std::uint16_t>(random());
    record.classification = i % 3 == 0 ? 2 : 6;
    record.return_number = 1 + i % 2;
    record.returns = 2;
    record.source = static_cast<std::uint16_t>(seed);
    record.time = 1e5 + 1e-4 * static_cast<double>(i);
    record.color = {static_cast<std::uint16_t>(random()), 1, static_cast<std::uint16_t>(i)};
    file.records.push_back(record);
  }
  return file.bytes();
}

/// A point with all that is kept of it, to be sorted.
using Row = std::tuple<double, double, double, std::vector<double>>;

std::vector<Row> rows_of(const Points& points) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<double> values;
    for (int channel = 0; channel < 3; ++channel) values.push_back(points.stored_color[i][channel]);
    for (const Column& column : points.columns) values.push_back(column.number(i));
    rows.emplace_back(points.position[i].x, points.position[i].y, points.position[i].z, std::move(values));
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

std::map<std::string, std::string> files_below(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream stream(entry.path(), std::ios::binary);
    files[std::filesystem::relative(entry.path(), folder).string()] = {std::istreambuf_iterator<char>(stream),
                                                                       {}};
  }
  return files;
}

class WrittenLevels : public ::testing::Test {
 protected:
  WrittenLevels() {
    static const std::array<std::string, 3> SCANS{ground_las(1), ground_las(2), ground_las(3)};
    for (const std::string& scan : SCANS)
      files.push_back(folder.write("scans/" + std::to_string(files.size()) + ".las", scan));
  }

  [[nodiscard]] std::filesystem::path ept(const std::string& name) const {
    return folder.path() / name / "ept.json";
  }

  LevelsMade write(const std::string& name, LevelSteps steps = {}, const Progress& progress = {}) const {
    ReadOptions options;
    options.progress = progress;
    steps.most_part_points = 30000;
    return write_levels({folder.path() / "scans"}, options, steps, ept(name));
  }

  /// The sentence that writing ends in.
  [[nodiscard]] std::string refusal(const std::string& name, const LevelSteps& steps = {}) const {
    try {
      write(name, steps);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      return error.what();
    }
    return "";
  }

  static Points read(const std::filesystem::path& path, const ReadOptions& options = {}) {
    std::vector<std::string> notes;
    Points points = find_format(path)->read_scan(path, options, {notes, options.progress}).points;
    EXPECT_TRUE(notes.empty()) << notes.front();
    return points;
  }

  /// What a node's own file holds.
  [[nodiscard]] Points points_of_node(const std::string& name, const LevelNode& node) const {
    const TileSchema schema = read_tile_schema(read_json(ept(name)).at("schema"), ept(name));
    const std::string file = node_name(node.level, node.cell) + ".bin";
    ScanCounts counts;
    return points_of_records(read_records(folder.path() / name / "ept-data" / file), schema, {}, counts);
  }

  const TempFolder folder;
  std::vector<std::filesystem::path> files;
};

TEST_F(WrittenLevels, AreTheSamePoints) {
  const LevelsMade made = write("levels");
  EXPECT_EQ(made.points, 3 * POINTS);
  EXPECT_GT(made.parts, 7U);
  EXPECT_TRUE(made.notes.empty());
  std::vector<Row> expected;
  for (const auto& file : files)
    for (Row& row : rows_of(read(file))) expected.push_back(std::move(row));
  std::sort(expected.begin(), expected.end());
  EXPECT_TRUE(rows_of(read(ept("levels"))) == expected);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "levels/ept-build"));
}

TEST_F(WrittenLevels, AreAnOctreeOfEvenSamples) {
  const LevelsMade made = write("levels");
  const Levels levels = levels_of(ept("levels"));
  ASSERT_EQ(levels.nodes.size(), made.nodes);
  EXPECT_GE(levels.depth(), 3U);
  std::vector<bool> is_leaf(levels.nodes.size(), true);
  for (const LevelNode& node : levels.nodes)
    if (node.parent != LevelNode::NO_PARENT) is_leaf[node.parent] = false;
  for (std::uint32_t i = 0; i < levels.nodes.size(); ++i) {
    const LevelNode& node = levels.nodes[i];
    const Points points = points_of_node("levels", node);
    ASSERT_EQ(points.size(), node.points);
    EXPECT_GT(node.points, 0U);
    const double edge = levels.edge / std::ldexp(1.0, static_cast<int>(node.level));
    std::set<std::tuple<int, int, int>> cells;
    for (const glm::dvec3& position : points.position) {
      const glm::dvec3 within = (position - levels.low) / edge - glm::dvec3(node.cell);
      ASSERT_TRUE(glm::all(glm::greaterThanEqual(within, glm::dvec3(0.0))) &&
                  glm::all(glm::lessThan(within, glm::dvec3(1.0))));
      const glm::ivec3 cell(within * 128.0);
      cells.emplace(cell.x, cell.y, cell.z);
    }
    if (!is_leaf[i]) {
      EXPECT_EQ(cells.size(), node.points) << "two points of a cell are no even sample";
    }
  }
}

/// The node of each point's place that is the deepest of those chosen, and whether it is where the octree ends.
struct Deepest {
  std::uint32_t node;
  bool is_end;
};

Deepest deepest(const Levels& levels, const std::vector<bool>& is_chosen, const glm::dvec3& position) {
  Deepest found{0, false};
  for (std::uint32_t i = 1; i < levels.nodes.size(); ++i) {
    const LevelNode& node = levels.nodes[i];
    const double edge = levels.edge / std::ldexp(1.0, static_cast<int>(node.level));
    if (node.parent != found.node || glm::uvec3(glm::floor((position - levels.low) / edge)) != node.cell)
      continue;
    if (!is_chosen[i]) return found;
    found.node = i;
  }
  return {found.node, true};
}

TEST_F(WrittenLevels, HaveMeansForNodesThatAreNotRead) {
  write("levels");
  const Levels levels = levels_of(ept("levels"));
  const Points all = read(ept("levels"));
  for (unsigned seed = 1; seed <= 4; ++seed) {
    std::mt19937 random(seed);
    std::vector<bool> is_chosen(levels.nodes.size());
    ReadOptions options;
    std::vector<std::uint32_t>& chosen = options.nodes[ept("levels")];
    for (std::uint32_t i = 0; i < levels.nodes.size(); ++i) {
      is_chosen[i] = i == 0 || (is_chosen[levels.nodes[i].parent] && random() % 3 > 0);
      if (is_chosen[i]) chosen.push_back(i);
    }
    // The points in each cell of a node where finer ones are not read.
    std::map<std::tuple<std::uint32_t, int, int, int>, std::vector<glm::dvec3>> cells;
    std::size_t as_they_are = 0, at_means = 0, all_means = 0, divided = 0;
    for (const glm::dvec3& position : all.position) {
      const Deepest at = deepest(levels, is_chosen, position);
      const double cell_m = levels.edge / std::ldexp(128.0, static_cast<int>(levels.nodes[at.node].level));
      const glm::ivec3 cell((position - levels.low) / cell_m);
      if (at.is_end)
        ++as_they_are;
      else
        cells[{at.node, cell.x, cell.y, cell.z}].push_back(position - levels.low);
    }
    const Points found = read(ept("levels"), options);
    const Column& count = *find_column(found.columns, COLUMN_POINT_COUNT);
    std::map<std::tuple<std::uint32_t, int, int, int>, std::vector<std::uint32_t>> means;
    for (std::uint32_t i = 0; i < found.size(); ++i) {
      const Deepest at = deepest(levels, is_chosen, found.position[i]);
      ASSERT_EQ(at.is_end, count.number(i) == 0.0);
      if (at.is_end) {
        --as_they_are;
        continue;
      }
      const double cell_m = levels.edge / std::ldexp(128.0, static_cast<int>(levels.nodes[at.node].level));
      const glm::ivec3 cell((found.position[i] - levels.low) / cell_m);
      means[{at.node, cell.x, cell.y, cell.z}].push_back(i);
    }
    EXPECT_EQ(as_they_are, 0U);
    ASSERT_EQ(means.size(), cells.size());
    for (const auto& [key, numbers] : means) {
      const auto of_cell = cells.find(key);
      ASSERT_NE(of_cell, cells.end());
      divided += numbers.size() > 1 ? 1 : 0;
      const double part_m =
          levels.edge / std::ldexp(256.0, static_cast<int>(levels.nodes[std::get<0>(key)].level));
      for (const std::uint32_t i : numbers) {
        // All points of the cell, or, where it has several means, those of an eighth of it.
        const glm::dvec3 place = found.position[i] - levels.low;
        std::vector<glm::dvec3> points;
        std::copy_if(of_cell->second.begin(), of_cell->second.end(), std::back_inserter(points),
                     [&, alone = numbers.size() == 1](const glm::dvec3& point) {
                       return alone || glm::ivec3(point / part_m) == glm::ivec3(place / part_m);
                     });
        ASSERT_EQ(count.number(i), static_cast<double>(points.size()));
        const glm::dvec3 mean =
            std::accumulate(points.begin(), points.end(), glm::dvec3(0.0)) / count.number(i);
        // The mean, each level of which is rounded to the file's steps of 0.01, or of what is no surface a mean of some.
        if (points.size() <= 3) {
          ASSERT_LT(glm::distance(place, mean), 0.03);
        }
        at_means += glm::distance(place, mean) < 0.03 ? 1 : 0;
        ++all_means;
      }
    }
    EXPECT_GT(at_means, all_means / 2);
    EXPECT_GT(divided, 0U);
  }
}

/// What is loaded of some nodes is known beforehand: exactly where all of a level are read, else within the points of nodes of which some
/// below them are read.
TEST_F(WrittenLevels, SayHowMuchIsLoadedOfSomeNodes) {
  write("levels");
  const Levels levels = levels_of(ept("levels"));
  const auto count_of = [&](const std::vector<std::uint32_t>& chosen) {
    LoadCount count(levels);
    for (const std::uint32_t i : chosen) count.add(i);
    return count.sum();
  };
  const auto found_of = [&](const std::vector<std::uint32_t>& chosen) {
    ReadOptions options;
    options.nodes[ept("levels")] = chosen;
    return read(ept("levels"), options).size();
  };
  ASSERT_GE(levels.depth(), 3U);
  for (std::uint32_t depth = 1; depth <= levels.depth(); ++depth) {
    std::vector<std::uint32_t> chosen;
    std::uint64_t inner = 0;
    for (std::uint32_t i = 0; i < levels.nodes.size(); ++i)
      if (levels.nodes[i].level < depth) {
        chosen.push_back(i);
        inner += levels.nodes[i].level + 1 < depth ? levels.nodes[i].points : 0;
      }
    const std::uint64_t found = found_of(chosen), count = count_of(chosen);
    EXPECT_GE(count, found) << depth;
    EXPECT_LE(count, found + inner) << depth;
    if (depth == 1 || depth == levels.depth()) {
      EXPECT_EQ(count, found) << depth;
    }
  }
}

TEST_F(WrittenLevels, OfOnePlaceTakeLittleMemory) {
  LasFile file;
  for (std::int32_t i = 0; i < 5000; ++i) {
    LasRecord record;
    record.position = i < 4990 ? std::array{7, 7, 7} : std::array{1000 * i, 0, 0};
    record.intensity = static_cast<std::uint16_t>(i);
    file.records.push_back(record);
  }
  const std::filesystem::path place = folder.write("place.las", file.bytes());
  LevelSteps steps;
  steps.most_part_points = 100;
  EXPECT_EQ(write_levels({place}, {}, steps, ept("place")).points, 5000U);
  std::multiset<double> expected, found;
  const Points points = read(ept("place"));
  ASSERT_EQ(points.size(), 5000U);
  const Column& intensity = *find_column(points.columns, COLUMN_INTENSITY);
  for (std::size_t i = 0; i < 5000; ++i)
    expected.insert(static_cast<double>(i)), found.insert(intensity.number(i));
  EXPECT_EQ(found, expected);
}

TEST_F(WrittenLevels, GoOnWhereTheyWereInterrupted) {
  write("whole");
  const std::map<std::string, std::string> whole = files_below(folder.path() / "whole");
  std::mt19937_64 random(5);
  int interruptions = 0;
  for (bool done = false; !done;) {
    std::size_t left = 1 + random() % 4;
    try {
      write("resumed", {}, [&](const char*, double) { return --left > 0; });
      done = true;
    } catch (const Error& error) {
      ASSERT_EQ(error.code(), ExitCode::interrupted) << error.what();
      // What a killed process appended after it had kept how much there is.
      if (++interruptions > 12) left = 1000;
      if (std::filesystem::exists(folder.path() / "resumed/ept-build/part-0.bin"))
        std::ofstream(folder.path() / "resumed/ept-build/part-0.bin", std::ios::app) << "torn";
    }
    if (interruptions > 12) {
      write("resumed");
      done = true;
    }
  }
  EXPECT_GT(interruptions, 2);
  EXPECT_TRUE(files_below(folder.path() / "resumed") == whole);
}

TEST_F(WrittenLevels, AreMadeInStepsByMany) {
  write("whole");
  EXPECT_NE(refusal("shared", level_steps("join")).find("'divide'"), std::string::npos);
  write("shared", level_steps("divide"));
  write("shared", level_steps("2/3"));
  EXPECT_NE(refusal("shared", level_steps("join")).find("not built"), std::string::npos);
  write("shared", level_steps("3/3"));
  write("shared", level_steps("1/3"));
  write("shared", level_steps("join"));
  EXPECT_TRUE(files_below(folder.path() / "shared") == files_below(folder.path() / "whole"));
  for (const char* nonsense : {"", "0/3", "4/3", "1/3x", "1", "build", "/2", "-1/2"})
    EXPECT_THROW(static_cast<void>(level_steps(nonsense)), Error) << nonsense;
}

TEST_F(WrittenLevels, ReplaceNothing) {
  write("levels");
  EXPECT_NE(refusal("levels").find("found a scan in levels there"), std::string::npos);
  write("other", level_steps("divide"));
  folder.write("scans/4.las", ground_las(4));
  EXPECT_NE(refusal("other").find("other files or options"), std::string::npos);
}

TEST_F(WrittenLevels, OfTextAreTheSameNumbers) {
  const std::filesystem::path file =
      folder.write("a.xyz", "0.1 1e7 3\n0.30000000000000004 10000000.125 -7\n1 2 3\n");
  write_levels({file}, {}, {}, ept("text"));
  Points expected = read(file), found = read(ept("text"));
  const auto order = [](const glm::dvec3& a, const glm::dvec3& b) { return a.x < b.x; };
  std::sort(expected.position.begin(), expected.position.end(), order);
  std::sort(found.position.begin(), found.position.end(), order);
  EXPECT_EQ(found.position, expected.position);
}

TEST_F(WrittenLevels, OfMeshesDegreesAndNothingAreRefused) {
  const auto sentence = [&](const std::string& name, const std::string& bytes) {
    try {
      write_levels({folder.write(name, bytes)}, {}, {}, ept("refused"));
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::input_unreadable);
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(sentence("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").find("found a mesh"),
            std::string::npos);
  LasFile none;
  EXPECT_NE(sentence("none.las", none.bytes()).find("found no points"), std::string::npos);
  LasFile degrees;
  degrees.records.resize(3);
  degrees.vlrs = {
      las_vlr("LASF_Projection", 2112, std::string("GEOGCS[\"WGS 84\",UNIT[\"degree\",0.0174]]") + '\0')};
  EXPECT_NE(sentence("degrees.las", degrees.bytes()).find("in degrees"), std::string::npos);
}

TEST(TileSchema, FaultsAreASentence) {
  const TempFolder folder;
  const auto sentence = [&](const std::string& schema) {
    const auto path = folder.write(
        "ept.json", R"({"bounds": [0, 0, 0, 1, 1, 1], "dataType": "binary", "schema": )" + schema + "}");
    try {
      static_cast<void>(ept_levels(path));
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::input_unreadable);
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(sentence("[]").find("without X, Y and Z"), std::string::npos);
  for (const char* entry :
       {R"({"name": "X", "type": "float", "size": 2})", R"({"name": "X", "type": "signed", "size": 3})",
        R"({"name": "X", "type": "signed", "size": 1e300})", R"({"name": "X", "size": 4})", "7",
        R"({"name": "X", "type": "signed", "size": 4, "scale": 0})",
        R"({"name": "X", "type": "signed", "size": 4, "offset": 1e999})"})
    EXPECT_NE(sentence("[" + std::string(entry) + "]"), "") << entry;
}

TEST(TileSchema, NumbersOfAllKindsAreRead) {
  TileSchema schema;
  using Kind = TileField::Kind;
  for (const char* name : {"X", "Y", "Z"}) schema.add({.name = name, .kind = Kind::floating, .bytes = 8});
  schema.add({.name = "Intensity", .kind = Kind::floating, .bytes = 4});
  schema.add({.name = "Classification", .kind = Kind::signed_integer, .bytes = 8});
  schema.add({.name = "height", .kind = Kind::signed_integer, .bytes = 2, .scale = 0.5, .offset = 3.0});
  std::vector<unsigned char> record(schema.record_bytes);
  const double values[] = {1.5, -2.5, 1e9, 0.25, -5.0, -1.5};
  for (std::size_t i = 0; i < schema.fields.size(); ++i) schema.fields[i].store(values[i], record.data());
  ScanCounts counts;
  ScanOptions options;
  options.attributes = {"height"};
  const Points points = points_of_records(record, schema, options, counts);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points.position[0], glm::dvec3(1.5, -2.5, 1e9));
  EXPECT_EQ(find_column(points.columns, COLUMN_INTENSITY)->number(0), 0.25);
  EXPECT_EQ(find_column(points.columns, COLUMN_CLASS)->number(0), -5.0);
  EXPECT_EQ(find_column(points.columns, "height")->number(0), -1.5);
  EXPECT_EQ(counts.stored, 1U);
}

}  // namespace
}  // namespace splatray
