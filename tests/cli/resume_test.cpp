/// Pictures that a signal stops, and --resume.
#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>

#include "app/library/image_file.h"
#include "app/library/picture/reproduce.h"
#include "tests/cli/child_process.h"

namespace splatray {
namespace {

class CliResume : public CliTest {
 protected:
  void SetUp() override { grid = write("grid.ply", splat_grid_ply()); }

  /// Renders 40 x 30 pixels to a file.
  [[nodiscard]] std::vector<std::string> command(const std::string& name, int samples,
                                                 std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {RENDER, grid, "-o", file(name), "--resolution=40x30", "--look=lit", "--quiet",
                               "--device=cpu", "--samples=" + std::to_string(samples)});
    return more;
  }
  [[nodiscard]] ChildResult make(const std::string& name, int samples,
                                 const std::vector<std::string>& more = {}) const {
    return run_program(command(name, samples, more));
  }
  [[nodiscard]] std::string bytes(const std::string& name) const {
    std::ifstream stream(file(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  [[nodiscard]] std::string resume(const std::string& name) const { return "--resume=" + file(name); }

  std::string grid;
};

/// Of 64, 128, 256 ... samples and at most as many more; else means are rounded once more.
TEST_F(CliResume, GoesOnToTheSameBits) {
  const std::string aov = "--aov=depth,error";
  ASSERT_EQ(make("some.exr", 64, {aov}).code, 0);
  const ChildResult rest = make("all.exr", 128, {aov, resume("some.exr")});
  ASSERT_EQ(rest.code, 0) << rest.err;
  ASSERT_EQ(make("one_go.exr", 128, {aov}).code, 0);
  EXPECT_TRUE(bytes("all.exr") == bytes("one_go.exr"));
  EXPECT_FALSE(bytes("some.exr") == bytes("one_go.exr"));
}

TEST_F(CliResume, GoesOnToTheSamePictureButForRounding) {
  ASSERT_EQ(make("some.exr", 5).code + make("one_go.exr", 9).code, 0);
  ASSERT_EQ(make("all.exr", 9, {resume("some.exr")}).code, 0);
  const ExrPicture all = read_exr(file("all.exr")), one_go = read_exr(file("one_go.exr"));
  double worst = 0.0, apart = 0.0;
  const ExrPicture some = read_exr(file("some.exr"));
  for (std::size_t i = 0; i < all.values.size(); ++i) {
    worst = std::max(worst, std::abs(double(all.values[i]) - one_go.values[i]));
    apart = std::max(apart, std::abs(double(some.values[i]) - one_go.values[i]));
  }
  EXPECT_LT(worst, 1e-6);
  EXPECT_GT(apart, 1e-3);
  EXPECT_EQ(all.metadata, one_go.metadata);
}

TEST_F(CliResume, ASignalLeavesWhatIsThere) {
  for (const auto& [signal, name] : {std::pair(SIGINT, "out.png"), std::pair(SIGTERM, "out.exr")}) {
    ChildResult result;
    for (const int seconds : {1, 4, 12, 36}) {  // a loaded machine may not trace yet
      const auto start = std::chrono::steady_clock::now();
      const auto renders = [&] {
        return std::chrono::steady_clock::now() - start > std::chrono::seconds(seconds);
      };
      std::vector<std::string> loud = command(name, 65536);
      if (signal == SIGTERM) std::erase(loud, "--quiet");
      result = run_program(loud, {}, renders, signal);
      if (result.err.find(" of 65536 samples") != std::string::npos) break;
    }
    EXPECT_EQ(result.code, 130) << result.err;
    EXPECT_NE(result.err.find(" of 65536 samples"), std::string::npos) << result.err;
    const bool told = result.err.find("a second signal ends this at once") != std::string::npos;
    EXPECT_EQ(told, signal == SIGTERM) << result.err;
    EXPECT_TRUE(told || std::count(result.err.begin(), result.err.end(), '\n') == 1) << result.err;
    const std::string kept = signal == SIGINT ? "out.unfinished.exr" : "out.exr";
    const std::uint32_t samples = read_picture_request(file(kept)).settings.samples;
    EXPECT_GT(samples, 0U);
    EXPECT_EQ(read_picture_request(file(name)).settings.samples, samples);
    ASSERT_EQ(make("one_go.exr", int(samples)).code, 0);
    EXPECT_TRUE(bytes(kept) == bytes("one_go.exr"));
    EXPECT_EQ(make("more.png", int(samples) + 1, {resume(kept)}).code, 0);
  }
}

TEST_F(CliResume, OtherPicturesAreRefused) {
  ASSERT_EQ(make("some.exr", 4).code + make("some.png", 4).code, 0);
  ASSERT_EQ(make("clean.exr", 4, {"--denoise"}).code, 0);
  const auto refuse = [&](int samples, const std::vector<std::string>& more, int code,
                          const std::string& words) {
    expect_refused([&] { return make("all.exr", samples, more); }, code, words);
  };
  refuse(4, {resume("some.exr")}, 3, "found 4 samples a pixel, expected fewer than the 4 of --samples");
  refuse(9, {resume("some.exr"), "--bounces=2"}, 3, "found a picture with --bounces 8, expected --bounces 2");
  refuse(9, {resume("some.exr"), "--eye=3,3,3"}, 3, "found a picture with --eye");
  refuse(9, {resume("some.exr"), "--sun=0,1,0"}, 3, "found a picture with no --sun, expected --sun 0,1,0");
  refuse(9, {resume("some.png")}, 3, "expected an EXR of splatray-render");
  refuse(9, {resume("none.exr")}, 3, "no such file");
  refuse(9, {resume("clean.exr")}, 3, "without its noise");
  refuse(9, {"--despeckle", "--denoise"}, 2, "expected one of them");
  refuse(9, {"--despeckle", "--tile=1/2"}, 2, "as parts that are joined keep their noise");
  refuse(1, {"--despeckle"}, 2, "--despeckle with one sample");
  refuse(9, {resume("some.exr"), "--time=1"}, 2, "found --time and --resume, expected one of them");
  expect_refused(
      [&] {
        return run_program(command("a.#.exr", 9, {resume("some.exr"), "--turntable=2"}));
      },
      2, "found --turntable and --resume, expected one of them");
  const std::string eye = "--eye=3,3,3", target = "--target=0,0,0";
  ASSERT_EQ(make("seen.exr", 4, {eye, target}).code, 0);
  write("grid.ply", splat_grid_ply(0.0, 0.2));
  refuse(9, {resume("seen.exr"), eye, target}, 3, "found a scene whose diagonal is");
}

/// A picture as another device or driver would have left it.
void name_device(const std::string& path, const std::string& device) {
  ExrPicture picture = read_exr(path);
  for (auto& [name, value] : picture.metadata)
    if (name == "device") value = device;
  write_exr(picture, path);
}

std::string device_of(const std::string& path) {
  for (const auto& [name, value] : read_metadata(path))
    if (name == "device") return value;
  return "";
}

TEST_F(CliResume, SamplesOfAnotherDeviceAreRefusedUnlessAllowed) {
  ASSERT_EQ(make("some.exr", 4).code, 0);
  const std::string here = device_of(file("some.exr"));
  name_device(file("some.exr"), "other, driver 7");
  expect_refused([&] { return make("all.exr", 9, {resume("some.exr")}); }, 3,
                 "found a picture that 'other, driver 7' made, expected one of '" + here +
                     "', as now, or --mixed-devices");
  ASSERT_EQ(make("all.exr", 9, {resume("some.exr"), "--mixed-devices"}).code, 0);
  EXPECT_EQ(device_of(file("all.exr")), "other, driver 7; " + here);
}

}  // namespace
}  // namespace splatray
