/// The viewer's window: GLFW's, without a graphics API of its own.
#pragma once
#include <atomic>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "engine/device/vulkan/vulkan_device.h"

struct GLFWwindow;

namespace splatray {

/// What mouse or keyboard did, in the order it came.
struct InputEvent {
  enum class Kind { key, press, release, move, wheel };
  Kind kind = Kind::move;
  int code = 0;                 ///< key: GLFW_KEY_*; press, release: GLFW_MOUSE_BUTTON_*
  int modifiers = 0;            ///< GLFW_MOD_*; of key, press and wheel
  glm::dvec2 position_px{0.0};  ///< of the cursor, framebuffer pixels from the top left corner; not of key
  double notches = 0.0;         ///< wheel: away from the person is positive
};

/// One at a time. All members but wake() belong to the thread that made it, the program's first.
class Window {
 public:
  /// `size` in screen coordinates, at most what the monitor has; `scaled`: times content_scale() where a screen coordinate is a
  /// pixel. Throws Error (no_device) where there is no display or no Vulkan driver.
  Window(const std::string& title, glm::uvec2 size, bool scaled);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Sleeps until something happens, `seconds` at most, and handles it; returns whether something did.
  bool wait(double seconds);
  /// Ends wait(), from any thread.
  void wake();
  [[nodiscard]] bool should_close() const;

  /// Screen coordinates, as the constructor takes them without scaling.
  [[nodiscard]] glm::uvec2 size() const;
  /// Pixels; 0 x 0 while minimised.
  [[nodiscard]] glm::uvec2 framebuffer_size() const;
  /// Size of texts and controls that the display asks for; 1 on ordinary ones.
  [[nodiscard]] float content_scale() const;
  /// Inputs since the last call.
  [[nodiscard]] std::vector<InputEvent> take_inputs();
  /// Whether a key (GLFW_KEY_*) is down.
  [[nodiscard]] bool is_down(int key) const;
  /// Files dropped since the last call.
  [[nodiscard]] std::vector<std::filesystem::path> take_dropped();
  void set_title(const std::string& title);
  [[nodiscard]] std::string clipboard() const;  ///< empty when it holds no text
  void set_clipboard(const std::string& text);

  /// What a VulkanDevice that presents in this window needs.
  [[nodiscard]] DeviceNeeds needs() const;
  /// A surface for vkDestroySurfaceKHR. Throws Error (failed).
  [[nodiscard]] VkSurfaceKHR make_surface(VkInstance instance) const;

  [[nodiscard]] GLFWwindow* get() const { return window_; }

 private:
  void fit_monitor();
  void listen();
  void on_input(InputEvent event);
  [[nodiscard]] glm::dvec2 cursor_px() const;

  GLFWwindow* window_ = nullptr;
  std::atomic<bool> happened_{true};
  std::vector<InputEvent> inputs_;
  std::vector<std::filesystem::path> dropped_;
};

}  // namespace splatray
