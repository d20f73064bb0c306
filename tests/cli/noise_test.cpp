/// What is left of the noise in pictures of scans as they come: of 16 samples, denoised, in the light that is chosen for them.
#include <cmath>

#include "app/library/image_file.h"
#include "tests/all_tests.h"
#include "tests/cli/child_process.h"

namespace splatray {
namespace {

class CliNoise : public CliTest {
 protected:
  /// Hills with houses on them, 200 x 200 points without colours or normals.
  [[nodiscard]] std::string site() const {
    std::string rows;
    for (int i = 0; i < 200; ++i) {
      for (int j = 0; j < 200; ++j) {
        const double x = 0.5 * i, y = 0.5 * j + 1e-3 * (i * 7 % 5);
        const bool house = i % 40 < 14 && j % 50 < 12;
        const double z = 4.0 * std::sin(0.06 * x) * std::cos(0.05 * y) + (house ? 6.0 : 0.0);
        rows += std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
      }
    }
    return write("site.xyz", rows);
  }

  [[nodiscard]] DisplayImage shown(const std::string& scene, const std::string& seed,
                                   const std::vector<std::string>& more = {}) const {
    std::vector<std::string> command{RENDER,          scene, "-o", file("out.png"), "--resolution=320x180",
                                     "--seed=" + seed};
    command.insert(command.end(), more.begin(), more.end());
    const ChildResult result = run_program(command);
    EXPECT_EQ(result.code, 0) << result.err;
    return read_display_image(file("out.png"), 0.0);
  }
};

/// How two pictures with independent noise differ where the scan is, in the middle of them.
struct Noise {
  double deviation = 0.0;  ///< of one of them, of 255 levels
  /// Of the pixels, that are more than 6 levels apart: 2.6 % at this size, 0.55 % at 1280x720, which takes too long here.
  double visible_share = 0.0;
};

Noise noise_between(const DisplayImage& a, const DisplayImage& b) {
  Noise noise;
  double pixels = 0.0;
  for (std::uint32_t y = a.height / 3; y < 2 * a.height / 3; ++y) {
    for (std::uint32_t x = a.width / 3; x < 2 * a.width / 3; ++x, pixels += 1.0) {
      const glm::dvec3 apart = 255.0 * glm::dvec3(a.rgb[y * a.width + x] - b.rgb[y * a.width + x]);
      const double grey = glm::dot(apart, glm::dvec3(0.2126, 0.7152, 0.0722));
      noise.deviation += 0.5 * grey * grey;
      noise.visible_share += std::abs(grey) > 6.0 ? 1.0 : 0.0;
    }
  }
  return {std::sqrt(noise.deviation / pixels), noise.visible_share / pixels};
}

TEST_F(CliNoise, SixteenSamplesOfAScanShowNone) {
  SPLATRAY_NIGHTLY();
  ASSERT_EQ(preprocess({site(), "-o", file("site.soct")}).code, 0);
  const std::string scene = file("site.soct");
  const Noise left = noise_between(shown(scene, "1"), shown(scene, "2"));
  RecordProperty("deviation", std::to_string(left.deviation));
  RecordProperty("visible_share", std::to_string(left.visible_share));
  EXPECT_LT(left.deviation, 2.0) << "what the eye does not see at arm's length";
  const Noise kept = noise_between(shown(scene, "1", {"--keep-noise"}), shown(scene, "2", {"--keep-noise"}));
  EXPECT_GT(kept.deviation, 2.0) << "the measure sees noise where it is";
}

}  // namespace
}  // namespace splatray
