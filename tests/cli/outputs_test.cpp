/// Outputs: whole or absent, compared with references, interrupted cleanly.
#include <chrono>
#include <fstream>

#include "app/library/image_file.h"
#include "tests/all_tests.h"
#include "tests/cli/child_process.h"

namespace splatray {
namespace {

class CliOutputs : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    grid = write("grid.ply", grid_ply(true));
  }
  std::string grid;
};

TEST_F(CliOutputs, UnwritableOutput) {
  const auto refuse = [&](const std::string& output) {
    expect_refused([&] { return run_program({RENDER, grid, "-o", output}); }, 1, "cannot write");
  };
  expect_refused(
      [&] {
        return run_program({RENDER, grid, "-o", file("missing/out.png")});
      },
      1, "found no folder '" + file("missing") + "'");
  refuse("/proc/out.png");
  std::filesystem::create_directory(file("folder.png"));
  refuse(file("folder.png"));
  expect_refused(
      [&] {
        return run_program({RENDER, grid, "-o", file("a.png"), "--stats-json", file("missing/a.json")});
      },
      1, "cannot write");
  expect_refused(
      [&] {
        return run_program({PREPROCESS, grid, "-o", file("missing/out.soct")});
      },
      1, "out.soct");
}

TEST_F(CliOutputs, WithoutTheLibraryBesideIt) {
  const std::string alone = file("splatray-render");
  std::filesystem::copy_file(RENDER, alone);
  expect_refused(
      [&] {
        return run_program({alone, grid, "--quiet", "-o", file("a.png"), "--resolution=8x8"});
      },
      1, "libsplatray_image_codec");
}

TEST_F(CliOutputs, WithTheLibraryInstalled) {
  const std::filesystem::path program = folder / "usr/bin/splatray-render";
  const std::filesystem::path library =
      folder / "usr" / INSTALLED_LIBRARIES / std::filesystem::path(IMAGE_CODEC).filename();
  std::filesystem::create_directories(program.parent_path());
  std::filesystem::create_directories(library.parent_path());
  std::filesystem::copy_file(RENDER, program);
  std::filesystem::copy_file(IMAGE_CODEC, library);
  const ChildResult result = run_program(
      {program.string(), grid, "--quiet", "-o", file("a.png"), "--resolution=8x8", "--samples=1"});
  EXPECT_EQ(result.code, 0) << result.err;
}

TEST_F(CliOutputs, PictureAndStatistics) {
  const ChildResult result = render({grid, "--stats-json", file("stats.json"), "--counters"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(names(), (std::vector<std::string>{"grid.ply", "out.png", "stats.json"}));
  std::ifstream stats(file("stats.json"));
  const std::string text{std::istreambuf_iterator<char>(stats), {}};
  EXPECT_NE(text.find("\"rays_primary\": 256"), std::string::npos) << text;
}

TEST_F(CliOutputs, MaterialsOfScansAreShownOrALineSaysWhyNot) {
  SPLATRAY_NIGHTLY();
  std::string sheet = "# x y z r g b\n";
  for (int i = 0; i < 400; ++i)
    sheet += std::to_string(i % 20) + ' ' + std::to_string(i / 20) + " 0 " + std::to_string(i % 20 * 12) +
             " 90 40\n";
  const std::string scan = write("sheet.xyz", sheet), note = "note: this --look does not use materials";
  const std::string gold = "--object=0:preset=gold";
  const auto says_so = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {RENDER,       scan, "-o", file("out.png"), "--resolution=16x16",
                                      "--samples=1"};
    words.insert(words.end(), more.begin(), more.end());
    const ChildResult result = run_program(words);
    EXPECT_EQ(result.code, 0) << result.err;
    return result.err.find(note) != std::string::npos;
  };
  ASSERT_EQ(run_program({RENDER, scan, "-o", file("scan.exr"), "--resolution=16x16", "--samples=1"}).code, 0);
  EXPECT_EQ(run_program({RENDER, scan, "-o", file("again.exr"), "--resolution=16x16", "--samples=1",
                         "--reference", file("scan.exr"), "--reference-limit=0.001"})
                .code,
            0)
      << "its reference is seen in its exposure";
  EXPECT_FALSE(says_so({}));
  std::filesystem::rename(file("out.png"), file("plain.png"));
  EXPECT_EQ(render({scan, gold, "--reference", file("plain.png")}).code, 1)
      << "gold looks as it looked before";
  EXPECT_FALSE(says_so({gold}));
  for (const char* look : {"--look=scan", "--look=clay", "--look=ao"}) {
    EXPECT_TRUE(says_so({gold, look})) << look;
    EXPECT_FALSE(says_so({look})) << look;
  }
  EXPECT_FALSE(says_so({gold, "--look=scan", "--quiet"}));
  EXPECT_FALSE(says_so({gold, "--look=lit"}));
}

TEST_F(CliOutputs, ReferenceDecides) {
  ASSERT_EQ(render({grid}).code, 0);
  std::filesystem::rename(file("out.png"), file("reference.png"));
  EXPECT_EQ(render({grid, "--reference", file("reference.png")}).code, 0);
  const ChildResult changed = render({grid, "--reference", file("reference.png"), "--eye=3,3,3"});
  EXPECT_EQ(changed.code, 1);
  EXPECT_NE(changed.err.find("differs from"), std::string::npos) << changed.err;
  EXPECT_TRUE(std::filesystem::exists(file("out.diff.png")));
  std::filesystem::remove(file("out.png"));
  expect_refused(
      [&] {
        return render({grid, "--reference", file("reference.png"), "--resolution=8x8"});
      },
      1, "16x16");
  expect_refused([&] { return render({grid, "--reference", file("none.png")}); }, 3, "none.png");
}

TEST_F(CliOutputs, SameSeedSameBytes) {
  const auto bytes_of = [&](const std::string& seed) {
    EXPECT_EQ(render({grid, "--samples=4", "--seed", seed}).code, 0);
    std::ifstream file_in(file("out.png"), std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(file_in), {}};
  };
  EXPECT_EQ(bytes_of("7"), bytes_of("7"));
}

TEST_F(CliOutputs, SignalsLeaveNoFrame) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const auto start = std::chrono::steady_clock::now();
    const auto renders = [&] { return std::chrono::steady_clock::now() - start > std::chrono::seconds(1); };
    expect_refused(
        [&] {
          return run_program({RENDER, "--quiet", grid, "--resolution=2048x2048", "--samples=4096",
                              "--turntable=2", "-o", file("out.#.png")},
                             {}, renders, signal);
        },
        130, "interrupted");
  }
}

TEST_F(CliOutputs, FullDiskLeavesTheOlderFile) {
  const auto refuse = [&](const std::string& output, std::vector<std::string> command) {
    write(output, "older");
    expect_refused([&] { return run_program(command, {}, {}, SIGINT, {.most_bytes = 512}); }, 1,
                   "cannot write '" + file(output));
    EXPECT_EQ(std::filesystem::file_size(file(output)), 5U) << output;
    std::filesystem::remove(file(output));
  };
  const std::vector<std::string> picture = {RENDER, "--quiet", grid, "--resolution=128x128", "--samples=1"};
  const auto with = [](std::vector<std::string> command, const std::vector<std::string>& more) {
    command.insert(command.end(), more.begin(), more.end());
    return command;
  };
  refuse("a.png", with(picture, {"-o", file("a.png")}));
  refuse("a.exr", with(picture, {"-o", file("a.exr")}));
  // With what lies beside it, or nothing of that.
  refuse("b.png", {RENDER, "--quiet", grid, "--samples=1", "-o", file("b.png"),
                   "--sheet=elevation:south,scale=4,dpi=200"});
  refuse("a.soct", {PREPROCESS, grid, "-o", file("a.soct")});
}

TEST_F(CliOutputs, FullDiskAndStatistics) {
  write("stats.json", "older");
  const ChildResult result =
      run_program({RENDER, "--quiet", grid, "--resolution=8x8", "--samples=1", "--turntable=40", "-o",
                   file("a##.png"), "--stats-json", file("stats.json")},
                  {}, {}, SIGINT, {.most_bytes = 2048});
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.err.find("stats.json': "), std::string::npos) << result.err;
  EXPECT_EQ(std::filesystem::file_size(file("stats.json")), 5U);
}

TEST_F(CliOutputs, ReadOnlyFolder) {
  std::filesystem::create_directory(file("locked"));
  std::filesystem::permissions(file("locked"), std::filesystem::perms{0555});
  expect_refused(
      [&] {
        return run_program({RENDER, grid, "-o", file("locked/a.png")}, {}, {}, SIGINT,
                           {.bound_by_permissions = true});
      },
      1, "Permission denied");
}

TEST_F(CliOutputs, ErrorsOfOddFileNamesAreOneLine) {
  for (const char* name : {"no\nsuch.soct", "no\nsuch.ply"})
    expect_refused([&] { return render({file(name)}); }, 3, "no?such");
  expect_refused([&] { return render({grid, "--environment", file("no\nsuch.hdr")}); }, 3, "no?such");
  expect_refused([&] { return render({grid, "--camera", file("no\nsuch.json")}); }, 3, "no?such");
}

TEST_F(CliOutputs, InterruptWhileReadingLeavesNothing) {
  constexpr int POINTS = 1000000;
  std::string ply = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(POINTS) +
                    "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  for (int i = 0; i < POINTS; ++i)
    ply += std::to_string(i % 1000) + ".25 " + std::to_string(i / 1000) + ".5 0\n";
  const std::string large = write("large.ply", ply);
  expect_refused(
      [&] {
        return run_program({PREPROCESS, large, "-o", file("out.soct")}, {}, [] { return true; });
      },
      130, "reading was interrupted");
}

TEST_F(CliOutputs, JpegAndWebpKeepTheirCommand) {
  for (const std::string name : {"a.jpg", "a.webp"}) {
    const ChildResult made = run_program(
        {RENDER, grid, "-o", file(name), "--resolution=24x16", "--samples=2", "--device=cpu", "--quiet"});
    ASSERT_EQ(made.code, 0) << made.err;
    const ChildResult again = run_program({RENDER, "--from", file(name), "-o", file("b.png"), "--quiet"});
    ASSERT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(read_display_image(file("b.png"), {}).width, 24U);
  }
}

TEST_F(CliOutputs, WhatAFormatCannotHoldIsRefused) {
  const auto refused = [&](const std::string& name, std::vector<std::string> words,
                           const std::string& found) {
    words.insert(words.begin(), {grid, "-o", file(name)});
    expect_refused([&] { return render(words); }, 2, found);
  };
  refused("a.jpg", {"--background=transparent"}, "a.jpg' with --background transparent, expected");
  refused("a.jpg", {"--aov=depth"}, "a.jpg' with --aov, expected a name ending in .exr");
  refused("a.webp", {"--aov=depth"}, "a.webp' with --aov, expected a name ending in .exr");
  refused("a.webp", {"--resolution=16384x2"}, "at most 16383 a side");
  refused("a.webp", {"--sheet=plan"}, "a.webp' with --sheet, expected a name ending in .png");
  refused("a.gif", {}, ".png, .jpg, .webp or .exr");
}

}  // namespace
}  // namespace splatray
