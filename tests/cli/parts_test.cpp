/// Pictures made in parts, and how progress is reported.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>

#include "app/library/image_file.h"
#include "tests/cli/child_process.h"

namespace splatray {
namespace {

class CliParts : public CliTest {
 protected:
  void SetUp() override { grid = write("grid.ply", splat_grid_ply()); }

  /// Renders 40 x 30 pixels of three samples to a file.
  [[nodiscard]] ChildResult make(const std::string& name, std::vector<std::string> more) const {
    more.insert(more.begin(), {RENDER, grid, "-o", file(name), "--resolution=40x30", "--samples=3",
                               "--device=cpu", "--look=lit", "--quiet"});
    return run_program(more);
  }
  [[nodiscard]] ChildResult merge(std::vector<std::string> words) const {
    words.insert(words.begin(), MERGE);
    return run_program(words);
  }
  [[nodiscard]] std::string bytes(const std::string& name) const { return read_file(file(name)); }
  static std::string read_file(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  /// Points of a wavy ground as text, without normals.
  [[nodiscard]] static std::string scattered() {
    std::ostringstream text;
    for (int i = 0; i < 2500; ++i) text << i % 50 << ' ' << i / 50 << ' ' << std::sin(0.2 * i) << '\n';
    return text.str();
  }

  std::string grid;
};

TEST_F(CliParts, MergedTilesAreTheWholePictureByteForByte) {
  const std::string aov = "--aov=depth,normal,id,error,albedo";
  ASSERT_EQ(make("whole.exr", {aov}).code, 0);
  for (const std::string i : {"1", "2", "3"})
    ASSERT_EQ(make("part" + i + ".exr", {aov, "--tile=" + i + "/3"}).code, 0);
  const std::vector<std::string> parts{file("part2.exr"), file("part1.exr"), file("part3.exr")};
  ASSERT_EQ(merge({parts[0], parts[1], parts[2], "-o", file("merged.exr")}).code, 0);
  EXPECT_TRUE(bytes("merged.exr") == bytes("whole.exr"));
  ASSERT_EQ(make("whole.png", {"--keep-noise"}).code, 0);
  ASSERT_EQ(merge({parts[0], parts[1], parts[2], "-o", file("merged.png")}).code, 0);
  ASSERT_EQ(make("plain.exr", {"--tile=1/2", "--keep-noise"}).code +
                make("plain2.exr", {"--tile=2/2", "--keep-noise"}).code,
            0);
  ASSERT_EQ(merge({file("plain.exr"), file("plain2.exr"), "-o", file("plain.png")}).code, 0);
  EXPECT_TRUE(bytes("plain.png") == bytes("whole.png"));
  EXPECT_EQ(read_display_image(file("merged.png"), {}).rgb, read_display_image(file("whole.png"), {}).rgb);
  EXPECT_FALSE(bytes("part1.exr") == bytes("part2.exr"));
}

/// Ranges of samples: {offset, samples}.
using Ranges = std::vector<std::pair<int, int>>;

class CliSampleRanges : public CliParts {
 protected:
  /// Renders as the whole picture and in ranges, joins these in another order, and expects the same file, as EXR and as PNG.
  void expect_same(const Ranges& ranges, std::vector<std::string> options) const {
    options.emplace_back("--keep-noise");  // as parts do
    const int samples = ranges.back().first + ranges.back().second;
    ASSERT_EQ(make_range("whole", ".exr", {0, samples}, options).code, 0);
    std::vector<std::string> parts;
    for (const auto& range : ranges) {
      const std::string name = "part" + std::to_string(range.first);
      ASSERT_EQ(make_range(name, ".exr", range, options).code, 0);
      parts.insert(parts.begin(), file(name + ".exr"));
      EXPECT_FALSE(bytes(name + ".exr") == bytes("whole.exr"));
    }
    expect_merged(parts, "whole.exr");
    if (std::any_of(options.begin(), options.end(), [](const auto& o) { return o.starts_with("--aov"); }))
      return;
    ASSERT_EQ(make_range("whole", ".png", {0, samples}, options).code, 0);
    expect_merged(parts, "whole.png");
  }

  [[nodiscard]] ChildResult make_range(const std::string& name, const std::string& extension,
                                       std::pair<int, int> range, std::vector<std::string> options) const {
    options.push_back("--samples=" + std::to_string(range.second));
    if (range.first > 0) options.push_back("--sample-offset=" + std::to_string(range.first));
    return make(name + extension, options);
  }

  void expect_merged(std::vector<std::string> parts, const std::string& whole) const {
    const std::string merged = "merged_" + whole;
    parts.insert(parts.end(), {"-o", file(merged)});
    const ChildResult result = merge(parts);
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_TRUE(bytes(merged) == bytes(whole)) << whole;
  }
};

TEST_F(CliSampleRanges, TwoAreTheWholePictureByteForByte) { expect_same({{0, 64}, {64, 64}}, {}); }

TEST_F(CliSampleRanges, ThreeAreWithTheLastOneShorter) { expect_same({{0, 128}, {128, 64}, {192, 9}}, {}); }

TEST_F(CliSampleRanges, TheyKeepOtherChannels) {
  expect_same({{0, 64}, {64, 64}, {128, 64}}, {"--aov=depth,normal,id,albedo"});
}

TEST_F(CliSampleRanges, ThePapersLookHasThemToo) { expect_same({{0, 64}, {64, 64}}, {"--look=paper"}); }

TEST_F(CliSampleRanges, TilesOfThemAreJoinedAtOnce) {
  ASSERT_EQ(make_range("whole", ".exr", {0, 128}, {}).code, 0);
  std::vector<std::string> parts;
  for (const std::string tile : {"1", "2"})
    for (const int offset : {0, 64}) {
      const std::string name = tile + "_" + std::to_string(offset);
      ASSERT_EQ(make_range(name, ".exr", {offset, 64}, {"--tile=" + tile + "/2"}).code, 0);
      parts.push_back(file(name + ".exr"));
    }
  expect_merged(parts, "whole.exr");
}

TEST_F(CliSampleRanges, WhatIsNoWholePictureIsRefused) {
  const std::vector<std::string> small{"--resolution=8x8"};
  const auto part = [&](std::pair<int, int> range, std::vector<std::string> options) {
    const std::string name = "p" + std::to_string(range.first) + "_" + std::to_string(range.second) +
                             (options.empty() ? "" : options.back());
    options.insert(options.begin(), small.begin(), small.end());
    EXPECT_EQ(make_range(name, ".exr", range, options).code, 0);
    return file(name + ".exr");
  };
  const auto refused = [&](std::vector<std::string> words, const std::string& found) {
    words.insert(words.end(), {"-o", file("out.exr")});
    expect_refused([&] { return merge(words); }, 3, found);
  };
  const std::string first = part({0, 64}, {}), second = part({64, 64}, {}), third = part({128, 64}, {});
  refused({first, third}, "found the samples 128 to 191 behind a gap, expected the samples 64 to 127");
  refused({second}, "found the samples 64 to 127 behind a gap, expected the samples 0 to 63");
  refused({first, part({0, 128}, {}), third},
          "found the samples 0 to 63 of the pixel 0,0, which another part has");
  refused({part({0, 3}, {}), second},
          "found the samples 0 to 2 before others, expected 64, 128, 256 ... samples");
  refused({part({0, 96}, {}), third}, "found the samples 0 to 95 before others");
  refused({part({0, 192}, {}), part({192, 64}, {})}, "found the samples 0 to 191 before others");
  refused({first, part({64, 64}, {"--seed=7"})}, "command_line");
  ExrPicture other = read_exr(part({64, 64}, {"--aov=depth"}));
  other.values.back() = 1.0F;
  write_exr(other, file("other.exr"));
  refused({part({0, 64}, {"--aov=depth"}), file("other.exr")}, "other values of a channel that is no colour");
}

TEST_F(CliSampleRanges, OptionsThatNeedAllSamplesAreRefused) {
  const auto refused = [&](const std::vector<std::string>& words, const std::string& found) {
    expect_refused([&] { return make("x.exr", words); }, 2, found);
  };
  refused({"--sample-offset=32", "--samples=64"}, "expected a multiple of 64");
  refused({"--sample-offset=64", "--samples=65"}, "expected a multiple of 128");
  refused({"--sample-offset=65536", "--samples=64"}, "65535");
  refused({"--sample-offset=65472", "--samples=64", "--error=0.1"}, "--samples");
  refused({"--sample-offset=64", "--samples=64", "--aov=error"}, "for all samples");
  refused({"--sample-offset=64", "--samples=64", "--denoise"}, "keep their noise");
}

TEST_F(CliParts, ACropIsThatPartOfThePicture) {
  ASSERT_EQ(make("whole.exr", {}).code, 0);
  ASSERT_EQ(make("crop.exr", {"--crop=13,7,11,9"}).code, 0);
  const ExrPicture whole = read_exr(file("whole.exr")), crop = read_exr(file("crop.exr"));
  EXPECT_EQ(crop.width, 40U);
  EXPECT_EQ(crop.window, (PixelWindow{13, 7, 11, 9}));
  ASSERT_EQ(crop.values.size(), 4U * 11 * 9);
  for (std::size_t y = 0; y < 9; ++y)
    for (std::size_t x = 0; x < 44; ++x)
      ASSERT_EQ(crop.values[44 * y + x], whole.values[4 * (40 * (7 + y) + 13) + x]) << x / 4 << ' ' << y;
  ASSERT_EQ(make("crop.png", {"--crop=13,7,11,9"}).code, 0);
  EXPECT_EQ(read_display_image(file("crop.png"), {}).width, 11U);
}

TEST_F(CliParts, ADenoisedCropIsFilteredByItself) {
  const std::vector<std::string> crop{"--crop=13,7,11,9", "--aov=normal"};
  for (const std::string option : {"--denoise", "--despeckle"}) {
    for (const std::string look : {"lit", "clay"}) {
      ASSERT_EQ(make("noisy.exr", {crop[0], crop[1], "--look=" + look}).code, 0);
      const ChildResult result = make("crop.exr", {crop[0], crop[1], "--look=" + look, option});
      ASSERT_EQ(result.code, 0) << result.err;
      const ExrPicture made = read_exr(file("crop.exr")), noisy = read_exr(file("noisy.exr"));
      EXPECT_EQ(made.window, (PixelWindow{13, 7, 11, 9}));
      ASSERT_EQ(made.values.size(), noisy.values.size());
      for (std::size_t i = 0; i < made.values.size(); ++i) ASSERT_TRUE(std::isfinite(made.values[i])) << i;
      EXPECT_TRUE(option != "--denoise" || made.values != noisy.values) << look;
    }
    expect_refused(
        [&] {
          return merge({file("crop.exr"), "-o", file("out.exr")});
        },
        3, "noise was taken out");
  }
}

TEST_F(CliParts, PartsThatDoNotMakeAPictureAreRefused) {
  ASSERT_EQ(make("a.exr", {"--tile=1/2"}).code, 0);
  ASSERT_EQ(make("b.exr", {"--tile=2/2"}).code, 0);
  ASSERT_EQ(make("seed.exr", {"--tile=2/2", "--seed=7"}).code, 0);
  const std::string a = file("a.exr"), b = file("b.exr"), out = file("out.exr");
  const auto refused = [&](std::vector<std::string> words, const std::string& found) {
    words.insert(words.end(), {"-o", out});
    expect_refused([&] { return merge(words); }, 3, found);
  };
  refused({a}, "found at least 600 pixels in none of the 1 parts");
  ExrPicture claims{16384, 8192, {0, 0, 1, 1}, {"R", "G", "B", "A"}, {1, 1, 1, 1}, read_exr(a).metadata};
  write_exr(claims, file("claims.exr"));
  refused({file("claims.exr")}, "found at least 134217727 pixels in none of the 1 parts");
  claims = read_exr(a);
  for (auto& [name, value] : claims.metadata)
    if (name == "command_line") value += " --no-such-option";
  write_exr(claims, file("command.exr"));
  refused({file("command.exr"), b}, "command.exr': found a command that is none of ours");
  refused({a, a, b}, "the pixel 0,0, which another part has too");
  refused({a, file("seed.exr")}, "command_line");
  refused({a, grid}, "no picture");
  refused({a, file("missing.exr")}, "no such file");
  expect_refused([&] { return merge({a, b, "-o", file("out.gif")}); }, 2, ".png, .jpg, .webp or .exr");
}

TEST_F(CliParts, PartsOfSeveralDevicesAreRefusedUnlessAllowed) {
  ASSERT_EQ(make("a.exr", {"--tile=1/2"}).code + make("b.exr", {"--tile=2/2"}).code, 0);
  ExrPicture other = read_exr(file("b.exr"));
  std::string here;
  for (auto& [name, value] : other.metadata) {
    if (name == "device") here = std::exchange(value, "other, driver 7");
    if (name == "command_line") value.replace(value.find("--device=cpu"), 12, "--device=other");
  }
  write_exr(other, file("b.exr"));
  const std::string a = file("a.exr"), b = file("b.exr"), out = file("out.exr");
  expect_refused(
      [&] {
        return merge({a, b, "-o", out});
      },
      3,
      "b.exr': found a part that 'other, driver 7' made, expected one of '" + here + "' as '" + a +
          "' is, or --mixed-devices");
  ASSERT_EQ(merge({a, b, "-o", out, "--mixed-devices"}).code, 0);
  for (const auto& [name, value] : read_metadata(out)) {
    EXPECT_TRUE(name != "device" || value == here + "; other, driver 7") << value;
    EXPECT_TRUE(name != "command_line" || value.find("--device") == std::string::npos) << value;
  }
}

TEST_F(CliParts, OptionsThatNeedTheWholePictureAreRefused) {
  const auto refused = [&](const std::vector<std::string>& words, const std::string& found) {
    expect_refused([&] { return make("x.exr", words); }, 2, found);
  };
  refused({"--crop=0,0,41,2"}, "beyond the picture's 40x30 pixels");
  refused({"--crop=1,2,3"}, "X,Y,WIDTH,HEIGHT");
  refused({"--tile=0/4"}, "1/4");
  refused({"--tile=5/4"}, "1/4");
  refused({"--tile=1/31"}, "30 rows");
  refused({"--tile=1/4", "--crop=0,0,1,1"}, "one of them");
  refused({"--tile=1/4", "--denoise"}, "keep their noise");
  refused({"--tile=1/4", "--despeckle"}, "keep their noise");
  refused({"--tile=1/4", "--error=0.1"}, "--samples");
}

TEST_F(CliParts, SkipExistingSkipsWhatTheSameCommandMade) {
  const auto time_of = [&] { return std::filesystem::last_write_time(file("p.exr")); };
  ASSERT_EQ(make("p.exr", {"--skip-existing"}).code, 0);
  const auto first = time_of();
  ASSERT_EQ(make("p.exr", {"--skip-existing"}).code, 0);
  EXPECT_EQ(time_of(), first);
  ASSERT_EQ(make("p.exr", {"--skip-existing", "--seed=9"}).code, 0);
  EXPECT_NE(time_of(), first) << "made by another command";
}

TEST_F(CliParts, ProgressIsReportedAsAsked) {
  const auto progress = [&](const std::string& style) {
    return run_program({RENDER, grid, "-o", file("p.png"), "--resolution=40x30", "--progress=" + style});
  };
  EXPECT_NE(progress("json").err.find("{\"stage\": \"tracing\", \"share\": 1.00, \"total\": 1.00}\n"),
            std::string::npos);
  EXPECT_NE(progress("plain").err.find("tracing 100 %\n"), std::string::npos);
  EXPECT_NE(progress("openjd").out.find("openjd_status: tracing\nopenjd_progress: 100\n"), std::string::npos);
  EXPECT_EQ(progress("line").err.find("100 %"), std::string::npos) << "no terminal";
}

TEST_F(CliParts, ProgressNeverFallsAndCountsItsStages) {
  const std::string err =
      run_program({RENDER, write("bare.xyz", scattered()), "-o", file("p.####.png"), "--turntable=3",
                   "--device=cpu", "--resolution=40x30", "--progress=json"})
          .err;
  double total = 0.0, share = 0.0;
  std::string stage;
  std::istringstream lines(err);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("{\"stage\": \"")) continue;
    const std::string name = line.substr(11, line.find("\", ") - 11);
    const double now = std::stod(line.substr(line.find("\"total\": ") + 9));
    const double part = std::stod(line.substr(line.find("\"share\": ") + 9));
    EXPECT_GE(now, total) << err;
    EXPECT_TRUE(part >= share || name != stage) << line;
    EXPECT_LT(line.size(), 80U);
    total = now, share = part, stage = name;
  }
  EXPECT_EQ(total, 1.0) << err;
  const std::string last = "\"stage\": \"frame 2\", \"share\": ";
  ASSERT_NE(err.find(last), std::string::npos) << err;
  EXPECT_GE(std::stod(err.substr(err.find(last) + last.size())), 0.66) << "of all frames";
  const std::string plain = run_program({RENDER, grid, "-o", file("p.png"), "--resolution=40x30",
                                         "--device=cpu", "--progress=plain"})
                                .err;
  EXPECT_NE(plain.find("1/9 reading "), std::string::npos) << plain;
  EXPECT_NE(plain.find("9/9 tracing 100 %\n"), std::string::npos) << plain;
}

}  // namespace
}  // namespace splatray
