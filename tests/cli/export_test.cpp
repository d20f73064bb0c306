/// splatray-preprocess -o of points: what its users meet.
#include <fstream>

#include "engine/base/error.h"
#include "engine/file/scene_file.h"
#include "tests/cli/child_process.h"
#include "tests/format/same_scene.h"

namespace splatray {
namespace {

class CliExport : public CliTest {
 protected:
  [[nodiscard]] ChildResult to(const std::string& output, std::vector<std::string> more = {},
                               const Limits& limits = {}) const {
    more.insert(more.begin(), {PREPROCESS, file("grid.ply"), "-o", output});
    return run_program(more, {}, {}, SIGINT, limits);
  }
  void SetUp() override { write("grid.ply", grid_ply(false)); }
};

TEST_F(CliExport, EachFormatIsReadAgain) {
  for (const char* name : {"a.ply", "a.las", "a.csv", "a.vtp", "A.PLY"}) {
    const ChildResult result = to(file(name));
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_NE(result.out.find("144 points -> 144 splats"), std::string::npos);
    EXPECT_EQ(run_program({PREPROCESS, file(name), "-o", file("again.soct")}).code, 0) << name;
  }
}

TEST_F(CliExport, OfASceneThatIsThere) {
  ASSERT_EQ(to(file("a.soct")).code, 0);
  ASSERT_EQ(to(file("a.ply")).code, 0);
  std::filesystem::create_directory(file("b"));
  ASSERT_EQ(run_program({PREPROCESS, file("a.soct"), "-o", file("b/grid.ply")}).code, 0);
  const auto bytes = [&](const char* name) {
    std::ifstream in(file(name), std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(in), {}};
  };
  EXPECT_TRUE(bytes("a.ply") == bytes("b/grid.ply"));
  ASSERT_EQ(run_program({PREPROCESS, file("b/grid.ply"), "-o", file("b.soct")}).code, 0);
  const Scene a = read_scene(file("a.soct")), b = read_scene(file("b.soct"));
  expect_same_points(a, b);  // bounds are of the centres as stored
  EXPECT_EQ(a.root.unit_world, b.root.unit_world);
  EXPECT_EQ(a.object_names, b.object_names);
}

TEST_F(CliExport, NothingIsLeftHalfWritten) {
  for (const char* name : {"a.ply", "a.las", "a.csv", "a.vtp"}) {
    expect_refused([&] { return to(file(name), {}, {.most_bytes = 3000}); }, 1, name);
    expect_refused([&] { return to(file(std::string("none/") + name)); }, 1, "none");
  }
}

TEST_F(CliExport, WhatCannotBeIsRefused) {
  for (const char* name : {"a.laz", "a.geojson", "a.dxf", "a"})
    expect_refused([&] { return to(file(name)); }, 2, "expected .soct, or .ply, .las, .csv or .vtp");
  expect_refused([&] { return to(file("a.soct"), {"--keep-dropped"}); }, 2, "found --keep-dropped");
  EXPECT_EQ(to(file("kept.las"), {"--keep-dropped"}).code, 0);
}

class CliLevels : public CliTest {};

TEST_F(CliLevels, AreWrittenAndListed) {
  const ChildResult made = preprocess({write("a.ply", grid_ply(false)), "-o", file("levels/ept.json")});
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_NE(made.out.find("144 points in 1 parts, 1 nodes"), std::string::npos) << made.out;
  const ChildResult listed = run_program({INFO, file("levels/ept.json")});
  EXPECT_NE(listed.out.find("1 nodes, points by level 144"), std::string::npos) << listed.out;
  EXPECT_EQ(preprocess({file("levels"), "-o", file("scene.soct")}).code, 0);
}

TEST_F(CliLevels, FollowNoOptionsOfScenesAndReplaceNothing) {
  const std::string scan = write("a.ply", grid_ply(false)),
                    mesh = write("cube.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const auto refused = [&](std::vector<std::string> more, ExitCode code, const std::string& words) {
    expect_refused([&] { return preprocess(std::move(more)); }, static_cast<int>(code), words);
  };
  const std::string levels = file("levels/ept.json");
  refused({scan, "-o", levels, "--smooth", "off"}, ExitCode::usage, "options of scenes");
  refused({scan, "-o", levels, "--change-from", scan}, ExitCode::usage, "options of scenes");
  refused({scan, "-o", levels, "--keep-dropped"}, ExitCode::usage, "--keep-dropped");
  refused({scan, "-o", levels, "--step", "half"}, ExitCode::usage, "step 'half'");
  refused({scan, "-o", levels, "--step", "join"}, ExitCode::usage, "'divide'");
  refused({scan, "-o", file("a.soct"), "--step", "join"}, ExitCode::usage, "expected -o with an ept.json");
  refused({mesh, "-o", levels}, ExitCode::input_unreadable, "found a mesh");
  EXPECT_EQ(preprocess({scan, "-o", levels}).code, 0);
  refused({scan, "-o", levels}, ExitCode::usage, "found a scan in levels there");
}

}  // namespace
}  // namespace splatray
