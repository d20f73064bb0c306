/// No output replaces an input or another output, whatever names they have.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "app/library/image_file.h"
#include "tests/cli/child_process.h"

namespace splatray {
namespace {

namespace fs = std::filesystem;

constexpr const char* TRIANGLE =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "buffers": [{"uri": "buffer.bin", "byteLength": 36}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}]})";

class ReplacedInputs : public CliTest {
 protected:
  void SetUp() override { grid = write("grid.ply", grid_ply(true)); }

  /// Expects exit code 2 and that every file of the folder is as it was.
  void expect_kept(const std::vector<std::string>& command, const std::string& words = "which is the input") {
    const std::string before = contents();
    expect_refused([&] { return run_program(command); }, 2, words);
    EXPECT_EQ(contents(), before);
  }
  void expect_render_keeps(std::vector<std::string> more, const std::string& words = "which is the input") {
    more.insert(more.begin(), {RENDER, grid, "--device=cpu", "--samples=1", "--quiet"});
    expect_kept(more, words);
  }
  [[nodiscard]] std::string contents() const {
    std::string all;
    for (const std::string& name : names()) {
      if (fs::is_directory(file(name))) continue;
      std::ifstream stream(file(name), std::ios::binary);
      all += name + ":" + std::string{std::istreambuf_iterator<char>(stream), {}};
    }
    return all;
  }

  std::string grid;
};

TEST_F(ReplacedInputs, ByPreprocess) {
  expect_kept({PREPROCESS, grid, "-o", grid});
  expect_kept({PREPROCESS, grid, "-o", file("./grid.ply")});
  fs::create_symlink("grid.ply", file("link.ply"));
  fs::create_hard_link(grid, file("hard.ply"));
  expect_kept({PREPROCESS, grid, "-o", file("link.ply")});
  expect_kept({PREPROCESS, grid, "-o", file("hard.ply")});
  fs::create_symlink("nowhere.ply", file("dangling.ply"));
  expect_refused(
      [&] {
        return run_program({PREPROCESS, grid, "-o", file("dangling.ply")});
      },
      1, "it exists and is not a regular file");
  EXPECT_TRUE(fs::is_symlink(file("dangling.ply")));
  fs::remove(file("dangling.ply"));
  const std::string other = write("other.ply", grid_ply(true, 0.1));
  expect_kept({PREPROCESS, grid, "--change-from", other, "-o", other});
  expect_kept({PREPROCESS, grid, "-o", file("out.soct"), "--stats-json", grid});
  expect_kept({PREPROCESS, grid, "-o", file("out.ply"), "--stats-json", file("out.ply")},
              "which are one file");
}

TEST_F(ReplacedInputs, OfAFolder) {
  const std::string tiles = file("tiles");
  fs::create_directory(tiles);
  const std::string points = "x,y,z\n0,0,0\n1,0,0\n0,1,0\n1,1,0\n";
  for (const char* name : {"tiles/a.csv", "tiles/b.csv"}) write(name, points);
  expect_kept({PREPROCESS, tiles, "-o", file("tiles/b.csv")});
  expect_kept({PREPROCESS, tiles, "-o", file("out.soct"), "--stats-json", file("tiles/b.csv")});
  EXPECT_EQ(fs::file_size(file("tiles/b.csv")), points.size());
  EXPECT_EQ(std::distance(fs::directory_iterator(tiles), {}), 2);
}

TEST_F(ReplacedInputs, ThatAnInputNames) {
  write("triangle.gltf", TRIANGLE);
  std::string bytes(36, '\0');
  const float places[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::copy_n(reinterpret_cast<const char*>(places), bytes.size(), bytes.begin());
  const std::string buffer = write("buffer.bin", bytes);
  ASSERT_EQ(
      run_program({PREPROCESS, file("triangle.gltf"), "--mesh-points=100", "-o", file("out.soct")}).code, 0);
  expect_kept({PREPROCESS, file("triangle.gltf"), "-o", file("out.soct"), "--stats-json", buffer});
}

TEST_F(ReplacedInputs, ByPictures) {
  ASSERT_EQ(render({grid}).code, 0);
  const std::string picture = file("out.png");
  expect_render_keeps({"-o", picture, "--environment", picture});
  expect_render_keeps({"-o", picture, "--reference", picture});
  fs::copy_file(picture, file("a.diff.png"));
  expect_render_keeps({"-o", file("a.png"), "--reference", file("a.diff.png")});
  expect_render_keeps({"-o", file("a.png"), "--stats-json", grid});
  expect_kept({RENDER, "--from", picture, "-o", picture});
  const std::string camera =
      write("camera.json", R"({"eye": [3, 3, 3], "target": [0, 0, 0], "up": [0, 1, 0], "fov_y_deg": 40})");
  expect_render_keeps({"-o", file("a.png"), "--camera", camera, "--stats-json", camera});
  expect_render_keeps({"-o", file("a.png"), "--stats-json", file("a.png")}, "which are one file");
  expect_render_keeps({"-o", file("a.png"), "--stats-json", file("a.unfinished.exr")}, "which are one file");
  expect_render_keeps({"-o", file("a##.png"), "--turntable=12", "--stats-json", file("a07.png")},
                      "which are one file");
  const std::string sheet = "--sheet=elevation:south,scale=20,dpi=50";
  expect_render_keeps({"-o", file("a.tif"), sheet, "--height-raster", file("a.tif")}, "which are one file");
  expect_render_keeps({"-o", file("a.png"), sheet, "--stats-json", file("a.pgw")}, "which are one file");
  expect_render_keeps({"-o", file("a.png"), sheet, "--height-raster", grid});
}

TEST_F(ReplacedInputs, ByRequests) {
  const std::string request = file("request.json");
  ASSERT_EQ(run_program({RENDER, grid, "-o", file("a.png"), "--save-request", request}).code, 0);
  expect_kept({RENDER, "--request", request, "--save-request", request});
  expect_kept({RENDER, "--request", request, "--stats-json", request});
  expect_kept({RENDER, grid, "-o", file("a.png"), "--save-request", grid});
}

TEST_F(ReplacedInputs, ByMeasuresAndMerges) {
  const std::string scan = write("scan.csv", "x,y,z\n0,0,0\n1,0,0\n0,1,0\n1,1,0\n");
  expect_kept({MEASURE, scan, "--point=0,0,0", "-o", scan});
  ASSERT_EQ(render({grid, "-o", file("a.exr"), "--tile=1/2"}).code, 0);
  ASSERT_EQ(render({grid, "-o", file("b.exr"), "--tile=2/2"}).code, 0);
  expect_kept({MERGE, file("a.exr"), file("b.exr"), "-o", file("b.exr")});
}

TEST_F(ReplacedInputs, ButSamplesAreAddedInPlace) {
  ASSERT_EQ(render({grid, "-o", file("a.exr"), "--samples=2"}).code, 0);
  EXPECT_EQ(render({grid, "-o", file("a.exr"), "--samples=4", "--resume", file("a.exr")}).code, 0);
  fs::rename(file("a.exr"), file("b.unfinished.exr"));
  EXPECT_EQ(render({grid, "-o", file("b.png"), "--samples=6", "--resume", file("b.unfinished.exr")}).code, 0);
  expect_render_keeps({"-o", file("b.png"), "--samples=8", "--resume", file("b.unfinished.exr"),
                       "--stats-json", file("b.unfinished.exr")},
                      "which are one file");
  fs::rename(file("b.unfinished.exr"), file("c.exr"));
  expect_render_keeps(
      {"-o", file("b.png"), "--samples=8", "--resume", file("c.exr"), "--stats-json", file("c.exr")});
}

TEST_F(ReplacedInputs, AndOlderOutputsAreReplaced) {
  write("out.png", "older");
  EXPECT_EQ(render({grid, "--stats-json", write("stats.json", "older")}).code, 0);
  EXPECT_TRUE(is_whole_picture(file("out.png")));
}

}  // namespace
}  // namespace splatray
