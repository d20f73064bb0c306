/// The viewer on a display of its own, for tests that use it as a person does.
#pragma once
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "tests/cli/child_process.h"
#include "tests/view/desktop.h"

namespace splatray {

inline void pause(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

class ViewSession : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    first = write("first.ply", splat_grid_ply());
    second = write("second.ply", splat_grid_ply(100.0));
  }

  std::vector<std::string> viewer_environment() {
    return {"DISPLAY=" + desktop.display(), "XDG_STATE_HOME=" + file("state")};
  }

  /// Starts the viewer with a window of 960 x 600; `more`: further environment variables.
  void start(std::vector<std::string> words, const std::vector<std::string>& more = {}) {
    words.insert(words.begin(),
                 {VIEW, "--resolution=960x600", "--samples=2", "--stats-json", file("stats.json")});
    std::vector<std::string> environment = viewer_environment();
    environment.insert(environment.end(), more.begin(), more.end());
    viewer.emplace(words, environment, folder.string(), file("log"));
  }

  /// Drags with a mouse button over the picture.
  void drag(const char* button, int steps) {
    desktop.xdotool({"mousemove", "250", "250", "mousedown", button});
    for (int i = 0; i < steps; ++i) {
      desktop.xdotool({"mousemove_relative", "4", "2"});
      pause(0.03);
    }
    desktop.xdotool({"mouseup", button});
  }

  /// Presses and releases at a place of the window; long enough for a frame in between.
  void click(int x, int y) {
    desktop.xdotool({"mousemove", std::to_string(x), std::to_string(y)});
    pause(0.3);
    desktop.xdotool({"mousedown", "1"});
    pause(0.3);
    desktop.xdotool({"mouseup", "1"});
    pause(0.3);
  }

  /// Waits until `met`, a minute at most; under ThreadSanitizer, which takes ten times as long, ten.
  void await(const char* what, const std::function<bool()>& met) {
#ifdef __SANITIZE_THREAD__
    constexpr std::chrono::minutes MOST{10};
#else
    constexpr std::chrono::minutes MOST{1};
#endif
    const auto end = std::chrono::steady_clock::now() + MOST;
    while (!met()) {
      ASSERT_LT(std::chrono::steady_clock::now(), end) << "waited in vain for " << what;
      pause(0.02);
    }
  }

  /// What the viewer has written about itself; an empty object before it has.
  nlohmann::json stats() {
    const nlohmann::json read = nlohmann::json::parse(content(file("stats.json")), nullptr, false);
    return read.is_object() ? read : nlohmann::json::object();
  }
  /// What the viewer remembers; an empty object before it does.
  nlohmann::json state() {
    const nlohmann::json read =
        nlohmann::json::parse(content(file("state/splatray/view.json")), nullptr, false);
    return read.is_object() ? read : nlohmann::json::object();
  }
  bool is_bookmarked(const std::string& scene, std::size_t slot) {
    const nlohmann::json bookmarks = state().value("bookmarks", nlohmann::json::object());
    return bookmarks.contains(scene) && !bookmarks[scene][slot].is_null();
  }
  void await_finished_picture() {
    await("a finished picture", [this] { return stats().value("samples", 0) == 2; });
  }
  /// Waits for the error that says `words`, sees it, closes it, and sees it gone.
  void expect_error(unsigned long window, const std::string& words) {
    await(words.c_str(), [&] {
      const nlohmann::json errors = stats().value("errors", nlohmann::json::array());
      return !errors.empty() && errors.back().get<std::string>().find(words) != std::string::npos;
    });
    await("the window without the error", [&] {
      desktop.xdotool({"key", "Escape"});
      return desktop.pixels(window) == resting;
    });
  }

  /// Opens the dialog that saves, takes what it proposes and waits for the file.
  void save() {
    desktop.xdotool({"key", "s"});
    desktop.xdotool({"keydown", "Return"});  // held: Dear ImGui sees keys as they are when a frame begins
    await("splatray.png", [this] { return std::filesystem::exists(file("splatray.png")); });
    desktop.xdotool({"keyup", "Return"});
  }

  /// Ends the viewer and returns its statistics.
  nlohmann::json end(unsigned long window) {
    desktop.close(window);
    EXPECT_EQ(viewer->wait(), 0);
    EXPECT_EQ(content(file("log")), "") << "nothing is said, by the validation layers neither";
    return nlohmann::json::parse(content(file("stats.json")));
  }

  /// The middle of the slider of Material::mirror.
  static constexpr int MIRROR_X = 755, MIRROR_Y = 468;

  Desktop desktop;
  std::optional<Program> viewer;
  std::string first, second;
  std::vector<std::uint32_t> resting;  ///< pixels of the window without an error
};

}  // namespace splatray
