/// Sequences of pictures, and pictures made again.
#include <fstream>

#include "app/library/image_file.h"
#include "app/library/request/frame_list.h"
#include "tests/cli/child_process.h"

namespace splatray {
namespace {

class CliSequences : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    grid = write("grid.ply", splat_grid_ply());
  }

  [[nodiscard]] std::string bytes(const std::string& name) const {
    std::ifstream in(file(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  /// Renders to other names than out.png; the last -o holds.
  [[nodiscard]] ChildResult render_to(const std::string& output, std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"-o", file(output)});
    return render(arguments);
  }
  /// A key of a camera path that looks at the grid's middle from `eye`.
  static std::string key(const std::string& eye, int frame) {
    return R"({"eye": [)" + eye +
           R"(], "target": [0.55, 0, 0.55], "up": [0, 1, 0], "fov_y_deg": 40, "frame": )" +
           std::to_string(frame) + "}";
  }

  std::string grid;
};

TEST_F(CliSequences, TurntableTurnsTheCamera) {
  const std::string eye = "1.3,1.2,0.9", target = "--target=0.55,0,0.55";
  ASSERT_EQ(render_to("t.##.png", {grid, "--turntable=4", "--eye=" + eye, target}).code, 0);
  EXPECT_EQ(names(), (std::vector<std::string>{"grid.ply", "t.00.png", "t.01.png", "t.02.png", "t.03.png"}));
  ASSERT_EQ(render_to("still.png", {grid, "--eye=" + eye, target}).code, 0);
  EXPECT_EQ(bytes("still.png"), bytes("t.00.png"));
  ASSERT_EQ(render_to("turned.png", {grid, "--eye=-0.2,1.2,0.2", target, "--environment-turn=0.5"}).code, 0);
  const DisplayImage turned = read_display_image(file("turned.png"), 0.0);
  EXPECT_EQ(read_display_image(file("t.02.png"), 0.0).rgb, turned.rgb);
  EXPECT_NE(read_display_image(file("t.00.png"), 0.0).rgb, turned.rgb);
  ASSERT_EQ(run_program({RENDER, "--quiet", "--from", file("t.02.png")}).code, 0);
  EXPECT_EQ(bytes("t.02.again.png"), bytes("t.02.png")) << "a frame's file says how to make it alone";
}

/// What is seen behind the object: the studio's panels do not pass by, other environments do.
TEST_F(CliSequences, TheStudioStandsStillAroundATurntable) {
  const auto backgrounds = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> words{grid, "--turntable=4", "--target=0.55,0,0.55", "--look=lit",
                                   "--keep-noise"};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(render_to(name + ".##.png", words).code, 0);
    std::vector<vec3> corners;
    for (const char* frame : {".00.png", ".01.png", ".02.png"})
      corners.push_back(read_display_image(file(name + frame), 0.0).rgb.front());
    return corners;
  };
  const std::vector<vec3> studio = backgrounds("s", {"--eye=1.3,0.3,0.9"});
  for (const vec3& corner : studio) EXPECT_LT(glm::length(corner - studio.front()), 0.01F);
  const std::vector<vec3> sky = backgrounds("d", {"--eye=1.3,-0.2,0.9", "--environment=sky:20,90"});
  EXPECT_GT(glm::length(sky[1] - sky[0]) + glm::length(sky[2] - sky[0]), 0.01F);
}

TEST_F(CliSequences, APanoramaIsMadeAgain) {
  const std::vector<std::string> inside{grid, "--panorama", "--eye=0.55,0.4,0.55", "--target=1,0.5,0.55"};
  ASSERT_EQ(render_to("p.png", inside).code, 0);
  const DisplayImage picture = read_display_image(file("p.png"), 0.0);
  EXPECT_EQ(picture.width, 2 * picture.height);
  ASSERT_EQ(run_program({RENDER, "--quiet", "--from", file("p.png")}).code, 0);
  EXPECT_EQ(bytes("p.again.png"), bytes("p.png"));
  std::vector<std::string> both = inside;
  both.emplace_back("--fov=40");
  expect_refused([&] { return render_to("q.png", both); }, 2, "found --panorama and --fov");
}

TEST_F(CliSequences, CameraPathMoves) {
  const std::string near = key("1, 1, 1", 0),
                    path = write("path.json", R"({"keys": [)" + near + "," + key("2, 1, 1", 4) + "]}");
  const std::string other = write("other.json", R"({"keys": [)" + near + "," + key("1, 2, 1", 4) + "]}");
  ASSERT_EQ(render_to("a#.png", {grid, "--camera-path", path, "--frames=0-2"}).code, 0);
  ASSERT_EQ(render_to("b#.png", {grid, "--camera-path", other, "--frames=0-2"}).code, 0);
  EXPECT_EQ(bytes("a0.png"), bytes("b0.png"));
  EXPECT_NE(bytes("a2.png"), bytes("b2.png"));
  EXPECT_FALSE(std::filesystem::exists(file("a3.png")));
  const std::string still = write("still.json", near);
  ASSERT_EQ(render_to("still.png", {grid, "--camera", still}).code, 0);
  EXPECT_EQ(bytes("still.png"), bytes("a0.png"));
  const std::string scan = write("scan.ply", grid_ply(true));
  ASSERT_EQ(render_to("scan#.png", {scan, "--camera-path", path, "--frames=0-0"}).code, 0);
  ASSERT_EQ(render_to("scan.png", {scan, "--camera", still}).code, 0);
  EXPECT_EQ(bytes("scan.png"), bytes("scan0.png")) << "no view is chosen beside the path's";
}

TEST_F(CliSequences, WholeFramesAreSkippedAndBrokenOnesMadeAgain) {
  for (const std::string extension : {".png", ".exr"}) {
    const std::string pattern = "t#" + extension, first = "t0" + extension, second = "t1" + extension;
    const std::vector<std::string> arguments = {grid, "--turntable=2", "--skip-existing"};
    ASSERT_EQ(render_to(pattern, arguments).code, 0);
    const std::string whole = bytes(first);
    const auto time = std::filesystem::last_write_time(file(first));
    for (const std::size_t size : {std::size_t{0}, whole.size() / 2, whole.size() - 1}) {
      const std::string broken = bytes(second).substr(0, std::min(size, bytes(second).size() - 1));
      write(second, broken);
      ASSERT_EQ(render_to(pattern, arguments).code, 0);
      EXPECT_EQ(read_display_image(file(second), 0.0).width, 16U) << second << " of " << size << " bytes";
      EXPECT_EQ(std::filesystem::last_write_time(file(first)), time);
    }
  }
}

TEST_F(CliSequences, FramesOfTheSameFileSpeltOtherwiseAreSkipped) {
  ASSERT_EQ(render_to("t#.png", {grid, "--turntable=2", "--skip-existing"}).code, 0);
  const auto time = std::filesystem::last_write_time(file("t0.png"));
  const std::filesystem::path path = grid;
  const std::string spelt =
      (path.parent_path() / "." / ".." / path.parent_path().filename() / path.filename()).string();
  ASSERT_EQ(render_to("t#.png", {spelt, "--turntable=2", "--skip-existing"}).code, 0);
  EXPECT_EQ(std::filesystem::last_write_time(file("t0.png")), time);
  std::filesystem::copy_file(grid, file("other.ply"));
  ASSERT_EQ(render_to("t#.png", {file("other.ply"), "--turntable=2", "--skip-existing"}).code, 0);
  EXPECT_NE(std::filesystem::last_write_time(file("t0.png")), time) << "another file's frames are made again";
}

TEST_F(CliSequences, FullDiskLeavesNoFrame) {
  const std::vector<std::string> command = {RENDER,           "--quiet",       grid, "--resolution=128x128",
                                            "--samples=1",    "--turntable=2", "-o", file("t#.png"),
                                            "--skip-existing"};
  const ChildResult result = run_program(command, {}, {}, SIGINT, {.most_bytes = 2048});
  EXPECT_EQ(result.code, 1) << result.err;
  EXPECT_EQ(names(), std::vector<std::string>{"grid.ply"});
  EXPECT_EQ(run_program(command).code, 0);
  EXPECT_EQ(read_display_image(file("t1.png"), 0.0).width, 128U);
}

TEST_F(CliSequences, OneFailedFrameFailsAlone) {
  std::filesystem::create_directory(file("t1.png"));
  const ChildResult result = render_to("t#.png", {grid, "--turntable=3", "--stats-json", file("stats.json")});
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.err.find("frame 1"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("1 of 3 frames failed"), std::string::npos) << result.err;
  EXPECT_EQ(names(), (std::vector<std::string>{"grid.ply", "stats.json", "t0.png", "t1.png", "t2.png"}));
  EXPECT_NE(bytes("stats.json").find("\"frame\": 2"), std::string::npos);
}

TEST_F(CliSequences, InterruptLeavesWholeFrames) {
  const ChildResult result = run_program({RENDER, "--quiet", grid, "--resolution=64x64", "--samples=64",
                                          "--turntable=100000", "-o", file("t.######.png")},
                                         {}, [&] { return std::filesystem::exists(file("t.000001.png")); });
  EXPECT_EQ(result.code, 130);
  EXPECT_GT(names().size(), 1U);
  std::filesystem::remove(grid);
  for (const std::string& name : names()) EXPECT_EQ(read_display_image(file(name), 0.0).width, 64U) << name;
}

TEST_F(CliSequences, FramesOfAChunk) {
  ASSERT_EQ(render_to("a#.png", {grid, "--turntable=12", "--frames=0-1,5,5-11:3"}).code, 0);
  EXPECT_EQ(names(),
            (std::vector<std::string>{"a0.png", "a1.png", "a11.png", "a5.png", "a8.png", "grid.ply"}));
  ASSERT_EQ(render_to("b#.png", {grid, "--turntable=12"}).code, 0);
  EXPECT_EQ(bytes("a8.png"), bytes("b8.png"));
  EXPECT_NE(bytes("a8.png"), bytes("b7.png"));
}

TEST(FrameList, IsReadAsFarmsWriteIt) {
  const auto frames = [](const std::string& text) { return listed_frames(read_frame_list(text).value()); };
  using Frames = std::vector<std::uint32_t>;
  EXPECT_EQ(frames("7"), (Frames{7}));
  EXPECT_EQ(frames("0-3,7,9-12:3"), (Frames{0, 1, 2, 3, 7, 9, 12}));
  EXPECT_EQ(frames("4-9:4"), (Frames{4, 8}));
  EXPECT_EQ(frames("3,1-4"), (Frames{3, 1, 2, 4}));
  EXPECT_EQ(frames("999999"), (Frames{999999}));
  for (const char* text : {"", ",", "1,", "2-1", "1-2:0", "1:2", "1-", "-1", "a", "1 -2", "1000000",
                           "1-2:", "1--2", "99999999999", "1-2:3:4"})
    EXPECT_FALSE(read_frame_list(text)) << text;
}

TEST_F(CliSequences, NonsenseIsRefused) {
  const std::string path =
      write("path.json", R"({"keys": [)" + key("1, 1, 1", 3) + "," + key("2, 1, 1", 9) + "]}");
  const auto refuse = [&](const std::vector<std::string>& arguments, const std::string& words, int code = 2) {
    std::vector<std::string> all = {grid};
    all.insert(all.end(), arguments.begin(), arguments.end());
    expect_refused([&] { return render_to("a.#.png", all); }, code, words);
  };
  refuse({"--frames=1-2"}, "--turntable or --camera-path");
  refuse({"--turntable=4", "--frames=2-4"}, "0-3");
  refuse({"--turntable=4", "--frames=2-1"}, "first-last");
  refuse({"--turntable=4", "--frames=0,2-3:0"}, "first-last");
  refuse({"--turntable=4", "--camera-path", path}, "one of them");
  refuse({"--camera-path", path, "--frames=2-9"}, "3-9");
  refuse({"--camera-path", path, "--eye=1,1,1"}, "as the path has its cameras");
  refuse({"--camera-path", path, "--reference", file("a.png")}, "of a single picture");
  refuse({"--camera-path", file("none.json")}, "no such file", 3);
  refuse({"--camera", path}, "a camera path", 3);
  expect_refused([&] { return render_to("a.png", {grid, "--turntable=4"}); }, 2, "one run of #");
}

class CliPictures : public CliSequences {
 protected:
  /// Renders a picture with about every option that matters, and again from its metadata.
  void expect_again(const std::string& extension, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {grid,
                                          "--environment=0.5,0.6,0.7",
                                          "--object=0:preset=copper",
                                          "--sun=1,2,3",
                                          "--light=0.1,0.7,0.3,0.2,0.3,0.4",
                                          "--seed=9",
                                          "--exposure=0.3",
                                          "--kappa=0.7",
                                          "--stats-json",
                                          file("stats.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    ASSERT_EQ(render_to("first" + extension, arguments).code, 0);
    std::filesystem::remove(file("stats.json"));
    const ChildResult again = run_program({RENDER, "--quiet", "--from", file("first" + extension)});
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(bytes("first.again" + extension), bytes("first" + extension));
    EXPECT_FALSE(std::filesystem::exists(file("stats.json")));
  }
};

TEST_F(CliPictures, AreMadeAgain) {
  expect_again(".png", {});
  expect_again(".exr", {"--aov=depth,id"});
  expect_again(".exr", {"--eye=1,2,3", "--ortho-height=2", "--camera-up=0,1,0.1"});
}

TEST_F(CliPictures, AreMadeAgainOtherwise) {
  ASSERT_EQ(render_to("a.exr", {grid, "--aov=depth", "--light=1,2,3"}).code, 0);
  const auto from = [&](const std::vector<std::string>& more) {
    std::vector<std::string> command = {RENDER, "--quiet", "--from", file("a.exr"), "-o", file("b.png")};
    command.insert(command.end(), more.begin(), more.end());
    const ChildResult result = run_program(command);
    EXPECT_EQ(result.code, 0) << result.err;
    return bytes("b.png");
  };
  ASSERT_EQ(render_to("plain.png", {grid, "--light=1,2,3"}).code, 0);
  EXPECT_EQ(from({}), bytes("plain.png"));
  EXPECT_NE(from({"--light=1,2,-3"}), bytes("plain.png"));
  EXPECT_NE(from({"--lights=none"}), bytes("plain.png"));
  EXPECT_NE(from({"--object=0:hidden=on"}), bytes("plain.png"));
  (void)from({"--resolution=24x16"});
  EXPECT_EQ(read_display_image(file("b.png"), 0.0).width, 24U);
}

TEST_F(CliPictures, RelativeInputsAreFoundAboveThePicture) {
  std::filesystem::create_directories(folder / "work/pictures");
  std::filesystem::rename(grid, folder / "work/grid.ply");
  const std::string in_work = "cd '" + (folder / "work").string() + "' && ";
  ASSERT_EQ(
      run_program({"/bin/sh", "-c",
                   in_work + RENDER + " --quiet grid.ply --resolution 16x16 --samples 1 -o pictures/a.png"})
          .code,
      0);
  EXPECT_EQ(bytes("work/pictures/a.png").find(folder.string()), std::string::npos)
      << "no path of the machine";
  const ChildResult again = run_program({RENDER, "--quiet", "--from", file("work/pictures/a.png")});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(read_display_image(file("work/pictures/a.again.png"), 0.0).rgb,
            read_display_image(file("work/pictures/a.png"), 0.0).rgb);
}

TEST_F(CliPictures, OfOthersAreRefused) {
  const auto refuse = [&](const std::string& picture, const std::string& words, int code) {
    expect_refused(
        [&] {
          return run_program({RENDER, "--from", picture, "-o", file("b.png")});
        },
        code, words);
  };
  refuse(file("none.png"), "no such file", 3);
  refuse(grid, "grid.ply", 3);
  const DisplayImage black{2, 2, std::vector<vec3>(4)};
  write_png(black, {}, file("other.png"));
  refuse(file("other.png"), "no splatray.command_line", 3);
  const auto quoted = [](const std::string& path) { return "'" + path + "'"; };  // the folder may have blanks
  write_png(black, {{"command_line", "splatray-render --from " + quoted(file("other.png"))}},
            file("loop.png"));
  refuse(file("loop.png"), "loop.png", 3);
  write_png(
      black,
      {{"command_line", "splatray-render " + quoted(grid) + " --stats-json " + quoted(file("trap.json"))}},
      file("trap.png"));
  EXPECT_EQ(
      run_program({RENDER, "--quiet", "--from", file("trap.png"), "--resolution=8x8", "--samples=1"}).code,
      0);
  EXPECT_FALSE(std::filesystem::exists(file("trap.json"))) << "a picture names no file to write";
}

}  // namespace
}  // namespace splatray
