// The size of the window on a display whose pixels are half as large.
#include <gtest/gtest.h>

#include <array>

#include "tests/cli/child_process.h"
#include "tests/view/desktop.h"

namespace splatray {
namespace {

using Size = std::array<int, 2>;

class DenseDisplay : public CliTest {
 protected:
  void SetUp() override { desktop.set_resources("Xft.dpi: 192\n"); }

  /// Of the window of a run that is closed at once.
  Size size_of_run(std::vector<std::string> words) {
    words.insert(words.begin(), {VIEW, "--samples=1", scan});
    Program viewer(words, {"DISPLAY=" + desktop.display(), "XDG_STATE_HOME=" + file("state")},
                   folder.string(), file("log"));
    const unsigned long window = desktop.wait_for_window("grid.ply");
    if (window == 0) return {};
    const Size size = desktop.size(window);
    desktop.close(window);
    EXPECT_EQ(viewer.wait(), 0);
    return size;
  }

  Desktop desktop;
  const std::string scan = write("grid.ply", grid_ply(true));
};

TEST_F(DenseDisplay, TheWindowComesBackAsItWasAndFits) {
  EXPECT_EQ(size_of_run({}), (Size{1600, 1000})) << "twice 1280 x 720, but for what the display has not";
  EXPECT_EQ(size_of_run({"--resolution=600x400"}), (Size{600, 400})) << "as asked for";
  for (int i = 0; i < 2; ++i) EXPECT_EQ(size_of_run({}), (Size{600, 400})) << "as the one closed last";
}

}  // namespace
}  // namespace splatray
