// A window on the device that traces.
#include <algorithm>
#include <cmath>

#include "app/library/image_file.h"
#include "tests/view/session.h"

namespace splatray {
namespace {

/// Vulkan's device, which the other sessions leave to windows: pictures do not leave it, up to two are under way.
TEST_F(ViewSession, OneDeviceTracesAndShows) {
  const std::vector<std::string> options = {first, "--device=llvmpipe", "--look=paper", "--eye=0.9,1.3,2.2",
                                            "--fov=35"};
  start(options, {"SPLATRAY_VALIDATION=1",
                  "VK_LAYER_ENABLES=VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT"});
  const unsigned long window = desktop.wait_for_window("first.ply");
  ASSERT_NE(window, 0U);
  desktop.xdotool({"key", "Tab"});  // no panels: the picture fills the window
  await("a picture as wide as the window", [this] {
    const nlohmann::json now = stats();
    return now.contains("size") && now["size"][0] == 960 && now["samples"] == 2;
  });
  std::vector<std::string> command = {RENDER, "--quiet",      "--samples=2", "--resolution=960x600",
                                      "-o",   file("out.png")};
  command.insert(command.end(), options.begin(), options.end());
  ASSERT_EQ(run_program(command).code, 0);
  const DisplayImage expected = read_display_image(file("out.png"), 0.0);
  const auto step_apart = [&](std::size_t i, std::uint32_t shown) {
    for (int channel = 0; channel < 3; ++channel) {
      const auto byte = static_cast<int>(shown >> (16 - 8 * channel) & 255U);
      if (std::abs(byte - static_cast<int>(std::lround(255.0F * expected.rgb[i][channel]))) > 1) return false;
    }
    return true;
  };
  await("the headless picture in the window", [&] {
    const std::vector<std::uint32_t> shown = desktop.pixels(window);
    if (shown.size() != expected.rgb.size()) return false;
    for (std::size_t y = 100; y < 500; ++y)  // between the texts above and below
      for (std::size_t x = 100; x < 860; ++x)
        if (!step_apart(y * 960 + x, shown[y * 960 + x])) return false;
    return true;
  });
  drag("1", 20);
  for (const char* width : {"500", "1100", "800"}) {
    desktop.xdotool({"windowsize", std::to_string(window), width, "700"});
    pause(0.2);
  }
  desktop.xdotool({"windowunmap", std::to_string(window)});
  pause(0.2);
  desktop.xdotool({"windowmap", std::to_string(window)});
  desktop.drop(window, second);
  EXPECT_EQ(desktop.wait_for_window("second.ply"), window);
  desktop.xdotool({"mousemove", "250", "250", "mousedown", "1", "mousemove_relative", "40", "20"});
  const nlohmann::json stats = end(window);  // with pictures under way
  EXPECT_EQ(stats["validation_messages"], 0);
  EXPECT_NE(stats["device"].get<std::string>().find("llvmpipe"), std::string::npos);
}

}  // namespace
}  // namespace splatray
