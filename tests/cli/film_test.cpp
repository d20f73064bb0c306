/// Films of sequences, made by a program of the name ffmpeg that the tests bring: what it is given, and what becomes of its failures.
#include <fstream>
#include <iterator>

#include "tests/cli/child_process.h"

namespace splatray {
namespace {

class CliFilms : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    grid = write("grid.ply", grid_ply(true));
    std::filesystem::create_directory(tools.path() / "none");
  }

  /// A turntable of three frames, `maker` being what ffmpeg does: a shell's commands, in which $film is the file to write.
  [[nodiscard]] ChildResult turn(const std::string& maker, const std::string& output = "turn.mp4") const {
    const std::filesystem::path program =
        tools.write("ffmpeg", "#!/bin/sh\nfor film; do :; done\nfilm=${film#file:}\n" + maker + "\n");
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    return turn_with(tools.path(), output);
  }
  [[nodiscard]] ChildResult turn_with(const std::filesystem::path& tool_folder,
                                      const std::string& output) const {
    return render({grid, "--turntable=3", "-o", file(output)},
                  {"PATH=" + tool_folder.string() + (tool_folder == tools.path() ? ":/usr/bin:/bin" : "")});
  }

  [[nodiscard]] std::string bytes(const std::string& name) const {
    std::ifstream in(file(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  std::string grid;
  const TempFolder tools;
};

TEST_F(CliFilms, AreMadeOfAllPicturesInTheirOrder) {
  ASSERT_EQ(render({grid, "--turntable=3", "-o", file("t.#.png")}).code, 0);
  const ChildResult made = turn("cat > \"$film\"");
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(bytes("turn.mp4"), bytes("t.0.png") + bytes("t.1.png") + bytes("t.2.png"));
  EXPECT_EQ(names(), (std::vector<std::string>{"grid.ply", "t.0.png", "t.1.png", "t.2.png", "turn.mp4"}));
}

TEST_F(CliFilms, ThatFailLeaveTheirPicturesAndTheOlderFilm) {
  write("turn.mp4", "older");
  for (const char* maker :
       {"cat > \"$film\"; echo no encoder >&2; exit 1", "echo no encoder >&2; exit 1", "kill -9 $$"}) {
    const ChildResult failed = turn(maker);
    EXPECT_EQ(failed.code, 1) << maker;
    EXPECT_NE(failed.err.find("turn.mp4: ffmpeg failed ("), std::string::npos) << failed.err;
    EXPECT_EQ(bytes("turn.mp4"), "older");
    EXPECT_EQ(names(), (std::vector<std::string>{"grid.ply", "turn.frames", "turn.mp4"}));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(file("turn.frames")), {}), 3);
  }
  ASSERT_EQ(turn("cat > \"$film\"").code, 0);
  EXPECT_EQ(names(), (std::vector<std::string>{"grid.ply", "turn.mp4"}));
}

TEST_F(CliFilms, ThatCannotBeMadeAreRefused) {
  expect_refused([&] { return turn_with(tools.path() / "none", "turn.mp4"); }, 2,
                 "no ffmpeg, expected Debian's package ffmpeg");
  expect_refused(
      [&] {
        return render({grid, "-o", file("a.mp4")});
      },
      2, "a single picture, expected --turntable");
}

}  // namespace
}  // namespace splatray
