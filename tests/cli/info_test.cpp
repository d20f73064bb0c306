/// splatray-info: what a file holds comes out, of every format.
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/cli/child_process.h"
#include "tests/readers/las_file.h"

namespace splatray {
namespace {

using Json = nlohmann::json;

class CliInfo : public CliTest {
 protected:
  [[nodiscard]] static ChildResult info(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), INFO);
    return run_program(arguments);
  }

  [[nodiscard]] static Json described(const std::string& path, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{path, "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ChildResult result = info(arguments);
    EXPECT_EQ(result.code, 0) << result.err;
    return Json::parse(result.out).at(0);
  }
};

/// Four points, one of them withheld, of two classes.
LasFile survey() {
  LasFile file;
  file.offset = {600000.0, 5000000.0, 100.0};
  file.records.resize(4);
  for (std::int32_t i = 0; i < 4; ++i) {
    LasRecord& record = file.records[static_cast<std::size_t>(i)];
    record.position = {1000 * i, 2000 * i, -500 * i};
    record.intensity = static_cast<std::uint16_t>(10 + i);
    record.classification = i < 2 ? 2 : 6;
    record.is_withheld = i == 3;
  }
  file.box = 7.0;
  file.vlrs = {
      las_vlr("LASF_Projection", 2112, R"(PROJCS["UTM 32",UNIT["metre",1],AUTHORITY["EPSG","25832"]])")};
  return file;
}

TEST_F(CliInfo, AnOutputThatTakesNothingIsAFailure) {
  const std::string scan = write("a.las", survey().bytes());
  for (const std::string& words : {scan + " --json", scan, std::string("--help"), std::string("--version")}) {
    const ChildResult result =
        run_program({"/bin/sh", "-c", std::string(INFO) + " " + words + " > /dev/full"});
    EXPECT_EQ(result.code, 1) << words;
    EXPECT_NE(result.err.find("could be written to stdout"), std::string::npos) << result.err;
  }
}

TEST_F(CliInfo, OfASurvey) {
  const Json json = described(write("a.las", survey().bytes()));
  EXPECT_EQ(json["points"], 3);
  EXPECT_EQ(json["left_out"]["withheld"], 1);
  EXPECT_EQ(json["box"], Json::parse("[[600000.0, 5000000.0, 99.0], [600002.0, 5000004.0, 100.0]]"));
  EXPECT_EQ(json["crs"]["name"], "UTM 32");
  EXPECT_EQ(json["crs"]["epsg"], 25832);
  EXPECT_EQ(json["crs"]["horizontal_metres"], 1.0);
  EXPECT_EQ(json["attributes"]["intensity"], Json::parse(R"({"type": "uint16", "low": 10.0, "high": 12.0})"));
  EXPECT_EQ(json["classes"], Json::parse(R"({"2": 2, "6": 1})"));
  EXPECT_EQ(json["head"]["version"], "LAS 1.2");
  EXPECT_FALSE(json["from_head"]);
}

TEST_F(CliInfo, ItsHeadAlone) {
  const Json json = described(write("a.las", survey().bytes()), {"--head"});
  EXPECT_EQ(json["points"], 4);
  EXPECT_TRUE(json["from_head"]);
  EXPECT_EQ(json["box"][1][2], 7.0);
  EXPECT_EQ(json["crs"]["epsg"], 25832);
  EXPECT_TRUE(json["attributes"].empty());
}

TEST_F(CliInfo, ForPeople) {
  const ChildResult result = info({write("a.las", survey().bytes())});
  EXPECT_EQ(result.code, 0) << result.err;
  for (const char* words :
       {"a.las\n", "  points        3\n", "  left out      1 withheld\n", "z 99 to 100; 2 x 4 x 1\n",
        "  coordinates   UTM 32 (EPSG:25832); x and y in metres\n", "  class 6       1 building\n"})
    EXPECT_NE(result.out.find(words), std::string::npos) << words << result.out;
}

TEST_F(CliInfo, OfMeshesAndScenes) {
  const Json mesh = described(write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n"));
  EXPECT_EQ(mesh["points"], 3);
  EXPECT_EQ(mesh["triangles"], 1);
  EXPECT_EQ(mesh["objects"][0]["name"], "a");
  const std::string grid = write("grid.ply", grid_ply(true));
  EXPECT_EQ(described(grid)["points"], 144);
  EXPECT_TRUE(described(grid)["crs"].is_null());
  ASSERT_EQ(run_program({PREPROCESS, grid, "-o", file("grid.soct")}).code, 0);
  const Json scene = described(file("grid.soct"));
  EXPECT_EQ(scene["points"], 144);
  EXPECT_EQ(scene["objects"], Json::parse(R"([{"name": "grid", "points": 144}])"));
  EXPECT_EQ(scene["box"][0], described(grid)["box"][0]);
}

TEST_F(CliInfo, KeepsWhatTheSceneKnows) {
  ASSERT_EQ(run_program({PREPROCESS, write("a.las", survey().bytes()), "-o", file("a.soct")}).code, 0);
  const Json json = described(file("a.soct"));
  EXPECT_EQ(json["crs"]["name"], "UTM 32");
  EXPECT_EQ(json["classes"], Json::parse(R"({"2": 2, "6": 1})"));
  EXPECT_EQ(json["scans"][0]["points"], 3);
}

TEST_F(CliInfo, ColumnsAreWhatTheMessageAsksFor) {
  const std::string points = write("a.txt", "Rechts;Hoch;Lage\n1,5;2;3\n1,5;2;4\n");
  expect_refused([&] { return info({points}); }, 3, "--columns gives names");
  EXPECT_EQ(described(points, {"--columns", "x,y,z"})["points"], 2);
}

TEST_F(CliInfo, AFolderIsItsScans) {
  const std::string tiles = file("tiles");
  expect_refused([&] { return info({tiles}); }, 3, "tiles: no such file");
  std::filesystem::create_directory(tiles);
  expect_refused([&] { return info({tiles}); }, 3, "a folder without scans");
  write("tiles/notes.txt", "bring the tripod\n");
  expect_refused([&] { return info({tiles}); }, 3, "notes.txt");
  write("tiles/b.las", survey().bytes());
  write("tiles/a.xyz", "0 0 0\n1 0 0\n0 1 0\n");
  write("tiles/house.obj", "v 0 0 0\n");
  const ChildResult result = info({tiles, "--json"});
  EXPECT_EQ(result.code, 0) << result.err;
  const Json json = Json::parse(result.out);
  ASSERT_EQ(json.size(), 2U) << "scans alone, as the other programs read them";
  EXPECT_EQ(json[0]["file"], tiles + "/a.xyz");
  EXPECT_EQ(json[1]["points"], 3);
  EXPECT_NE(result.err.find("notes.txt"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("it was left out"), std::string::npos) << result.err;
}

TEST_F(CliInfo, UnreadableFilesAreRefused) {
  for (const char* name : {"a.las", "a.e57", "a.ply", "a.soct", "a.gltf", "a.xyzzy"}) {
    expect_refused([&] { return info({file(name)}); }, 3, name);
    write(name, "no such thing");
    expect_refused([&] { return info({file(name)}); }, 3, name);
    std::filesystem::remove(file(name));
  }
  expect_refused([&] { return info({}); }, 2, "INPUT");
}

}  // namespace
}  // namespace splatray
