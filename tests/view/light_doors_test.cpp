/// The light of pictures as people get them by default: what it shows, and that its amount is what was asked for.
#include <cmath>
#include <string>
#include <vector>

#include "app/library/image_file.h"
#include "engine/base/srgb.h"
#include "tests/cli/child_process.h"
#include "tests/view/live_documents.h"

namespace splatray {
namespace {

class DefaultLight : public CliTest {
 protected:
  /// What splatray-render says on stderr as it makes a picture.
  std::string made(const std::vector<std::string>& words, const std::string& name) {
    std::vector<std::string> command{RENDER, "--device=cpu", "-o", file(name)};
    command.insert(command.end(), words.begin(), words.end());
    const ChildResult result = run_program(command);
    EXPECT_EQ(result.code, 0) << result.err;
    return result.err;
  }
  /// The red, green and blue of an EXR, pixel by pixel.
  [[nodiscard]] std::vector<double> radiance(const std::string& name) const {
    std::vector<double> values;
    for (const glm::vec3& texel : read_environment(file(name)).texels)
      for (int i = 0; i < 3; ++i) values.push_back(double(texel[i]));
    return values;
  }
};

// --- scans ---------------------------------------------------------------------------------------------------------------

constexpr std::array GREYS = {10, 20, 30, 39, 60, 100, 150, 200};

/// Stripes of these greys along x, on the floor y = 0 or the wall z = 0.
std::string striped_ply(bool wall) {
  constexpr int ACROSS = 12, ALONG = 24;
  std::string rows;
  int count = 0;
  for (std::size_t stripe = 0; stripe < GREYS.size(); ++stripe)
    for (int i = 0; i < ACROSS; ++i)
      for (int j = 0; j < ALONG; ++j) {
        const std::string x = std::to_string(double(stripe) + (i + 0.5) / ACROSS);
        const std::string other = std::to_string((j + 0.5) / ACROSS - 1.0),
                          grey = std::to_string(GREYS[stripe]);
        rows += x + (wall ? " " + other + " 0 0 0 1 " : " 0 " + other + " 0 1 0 ") + grey + " " + grey + " " +
                grey + "\n";
        ++count;
      }
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\n"
         "property float nz\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n" +
         rows;
}

class ScanTone : public DefaultLight {
 protected:
  /// The middles of the stripes in a picture, 0 .. 255: red, green and blue of each.
  std::vector<glm::vec3> shown(bool wall, const std::string& exposure) {
    write("stripes.ply", striped_ply(wall));
    (void)made({file("stripes.ply"), "--look=scan", wall ? "--eye=4,0,9" : "--eye=4,9,0", "--target=4,0,0",
                wall ? "--camera-up=0,1,0" : "--camera-up=0,0,-1", "--ortho-height=1", "--resolution=64x8",
                "--samples=64", "--keep-noise", "--exposure=" + exposure},
               "stripes.png");
    const DisplayImage picture = read_display_image(file("stripes.png"), {});
    std::vector<glm::vec3> middles;
    for (std::uint32_t i = 0; i < GREYS.size(); ++i)
      middles.push_back(255.0F * picture.rgb[4 * 64 + 8 * i + 4]);
    return middles;
  }
};

/// Khronos PBR Neutral, which scans were shown by before, made 8 of 39 and 27 of 60.
TEST_F(ScanTone, GreysComeBack) {
  for (const bool wall : {false, true}) {
    const std::vector<glm::vec3> middles = shown(wall, "0");
    for (std::size_t i = 0; i < GREYS.size(); ++i)
      for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(middles[i][channel], GREYS[i], 2.0) << (wall ? "wall" : "floor");
  }
}

TEST_F(ScanTone, AutomaticExposureIsOneFactorThatIsSaid) {
  const std::vector<glm::vec3> plain = shown(false, "0"), automatic = shown(false, "auto");
  std::string said;
  for (const auto& [name, value] : read_metadata(file("stripes.png")))
    if (name == "choices") said = value;
  const std::size_t at = said.find("--exposure ");
  ASSERT_NE(at, std::string::npos) << said;
  const double factor = std::exp2(std::stod(said.substr(at + 11)));
  EXPECT_GT(std::abs(factor - 1.0), 0.05);
  for (std::size_t i = 0; i < GREYS.size(); ++i) {
    const float bright = srgb_to_linear(plain[i].x / 255.0F) * static_cast<float>(factor);
    if (bright > 0.79F) continue;  // the shoulder
    EXPECT_NEAR(automatic[i].x, 255.0F * linear_to_srgb(bright), 2.5) << GREYS[i];
  }
}

// --- lights of files -----------------------------------------------------------------------------------------------------

double median_of(const DisplayImage& picture) {
  std::vector<double> values;
  for (const glm::vec3& pixel : picture.rgb)
    for (int i = 0; i < 3; ++i) values.push_back(255.0 * double(pixel[i]));
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Daylight is some hundred W/m2: unexposed pictures in it would be white.
TEST_F(DefaultLight, PicturesInDaylightAreExposed) {
  write("cube.obj", cube_obj());
  for (const char* sky : {"--environment=sky:2,120", "--environment=sky:60,120,8",
                          "--sun-at=2026-06-21T15:00+02:00,48.1,11.6"}) {
    (void)made({file("cube.obj"), "--mesh-points=2000", "--ground", "--resolution=32x24", "--samples=8", sky},
               "sky.png");
    const double median = median_of(read_display_image(file("sky.png"), {}));
    EXPECT_TRUE(median >= 60.0 && median <= 220.0) << sky << ": " << median;
  }
  // The sun's height there and then, by another door.
  const auto seen = [&](const std::string& sky) {
    (void)made({file("cube.obj"), "--mesh-points=2000", "--resolution=32x24", "--samples=2", sky}, "sky.exr");
    return radiance("sky.exr");
  };
  EXPECT_EQ(seen("--sun-at=2026-06-21T15:00+02:00,48.1,11.6"),
            seen("--environment=sky:2026-06-21T13:00Z,48.1,11.6,3"));
}

TEST_F(DefaultLight, DaylightThatIsNoneIsRefused) {
  write("cube.obj", cube_obj());
  for (const auto& [asked, words] : std::vector<std::pair<std::string, std::string>>{
           {"2026-06-21T01:00+02:00,48.1,11.6", "expected a time when the sun is up"},
           {"2026-02-29T12:00Z,48.1,11.6", "expected a date and time with its zone"},
           {"2026-06-21T15:00,48.1,11.6", "expected a date and time with its zone"},
           {"2026-06-21T15:00Z,91,11.6", "expected a latitude from -90 to 90"},
           {"2026-06-21T15:00Z", "expected ELEVATION,AZIMUTH"},
           {"2026-06-21T15:00Z,48,11,1", "expected a turbidity from 2 to 10"}})
    expect_refused(
        [&] {
          return run_program({RENDER, file("cube.obj"), "-o", file("x.png"), "--sun-at=" + asked});
        },
        2, words);
}

/// Lights beyond some bounds were scaled to irradiance pi before, in EXRs, too.
TEST_F(DefaultLight, AFilesLampsKeepTheirPowerAndItsPictureIsExposed) {
  const std::vector<std::string> small{"--mesh-points=2000", "--resolution=32x24", "--samples=8"};
  std::vector<double> of_one;
  for (const double candela : {1.0, 0.01, 100.0, 10000.0}) {
    write("lamp.gltf", lamp_gltf(candela));
    std::vector<std::string> words = small;
    words.push_back(file("lamp.gltf"));
    (void)made(words, "lamp.png");
    const double median = median_of(read_display_image(file("lamp.png"), {}));
    EXPECT_TRUE(median >= 60.0 && median <= 190.0) << candela << " cd: " << median;
    (void)made(words, "lamp.exr");
    const std::vector<double> found = radiance("lamp.exr");
    if (of_one.empty()) of_one = found;
    for (std::size_t i = 0; i < found.size(); ++i)
      ASSERT_NEAR(found[i], candela * of_one[i], 1e-4 * candela * of_one[i]) << candela << " cd";
    // The lamp alone: facing it 1.5 away is 1 / 2.25 of its intensity.
    words.push_back("--environment=black");
    words.insert(words.end(), {"--eye=0.3,0.3,1", "--target=0.3,0.3,0", "--fov=1", "--camera-up=0,1,0"});
    (void)made(words, "black.exr");
    const double red = radiance("black.exr")[3 * (12 * 32 + 16)];
    EXPECT_NEAR(red, candela / 2.25 * 0.5 / std::acos(-1.0), 0.08 * candela) << candela << " cd";
  }
}

// --- the light at the camera ---------------------------------------------------------------------------------------------

TEST_F(DefaultLight, NoLampIsPutWhereAnEnvironmentOrALightIsAskedFor) {
  write("cube.obj", cube_obj());
  const std::vector<std::string> within{file("cube.obj"),     "--mesh-points=2000", "--eye=0.5,0.5,0.9",
                                        "--target=0.5,0.5,0", "--resolution=16x16", "--samples=4"};
  const auto lamps = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = within;
    words.insert(words.end(), more.begin(), more.end());
    return made(words, "room.exr").find("one is put there") != std::string::npos;
  };
  EXPECT_TRUE(lamps({}));
  EXPECT_GT(radiance("room.exr")[3 * 8 * 17], 0.05);
  for (const char* asked : {"--environment=white", "--environment=sky:30,120", "--environment=studio",
                            "--light=0.5,0.5,0.5", "--lights=none"})
    EXPECT_FALSE(lamps({asked})) << asked;
  EXPECT_FALSE(lamps({"--environment=white"}));
  EXPECT_EQ(radiance("room.exr")[3 * 8 * 17], 0.0) << "a closed box has no light";
  EXPECT_FALSE(lamps({"--material=glass"})) << "no ray from the eye leaves it, but light comes in";
}

}  // namespace
}  // namespace splatray
