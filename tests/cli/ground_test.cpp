/// --ground: shadows fall on it.
#include "app/library/image_file.h"
#include "tests/all_tests.h"
#include "tests/cli/child_process.h"

namespace splatray {
namespace {

class CliGround : public CliTest {
 protected:
  /// Pixels of a wall on its edge in the sun that are less than half as bright as without shadows.
  [[nodiscard]] std::size_t shadowed(const std::vector<std::string>& more) const {
    const std::string wall = write("wall.ply", grid_ply(true));
    Image images[2];
    for (const std::string shadows : {"on", "off"}) {
      std::vector<std::string> command{RENDER,
                                       wall,
                                       "-o",
                                       file("out.exr"),
                                       "--quiet",
                                       "--look=lit",
                                       "--up=1,0,0",
                                       "--sun=1,1,0",
                                       "--eye=2.5,-3,1.6",
                                       "--target=0,-0.5,0.5",
                                       "--resolution=48x48",
                                       "--samples=4",
                                       "--environment=0.1,0.1,0.1",
                                       "--shadows=" + shadows};
      command.insert(command.end(), more.begin(), more.end());
      const ChildResult result = run_program(command);
      EXPECT_EQ(result.code, 0) << result.err;
      images[shadows == "on" ? 0 : 1] = image_of(read_exr(file("out.exr")));
    }
    std::size_t count = 0;
    for (std::size_t i = 0; i < images[0].rgba.size(); ++i)
      count += images[0].rgba[i].x < 0.5F * images[1].rgba[i].x ? 1 : 0;
    return count;
  }
};

TEST_F(CliGround, CatchesTheShadow) {
  SPLATRAY_NIGHTLY();
  EXPECT_GT(shadowed({"--ground"}), 50U);
  EXPECT_LT(shadowed({}), 10U);
}

TEST_F(CliGround, IsOfWhatIsBuilt) {
  const std::string wall = write("wall.ply", grid_ply(true));
  ASSERT_EQ(preprocess({wall, "--ground", "-o", file("wall.soct")}).code, 0);
  EXPECT_EQ(render({file("wall.soct")}).code, 0);
  EXPECT_EQ(render({wall, "--ground", "--material=gold"}).code, 0);
  expect_refused([&] { return render({file("wall.soct"), "--ground"}); }, 2, "found --ground with a .soct");
}

}  // namespace
}  // namespace splatray
