#include "app/view/window/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <utility>

#include "engine/base/error.h"

namespace splatray {
namespace {

/// What GLFW says went wrong last.
std::string glfw_reason() {
  const char* reason = nullptr;
  glfwGetError(&reason);
  return reason != nullptr ? reason : "no reason given";
}

Error no_window(const std::string& found) {
  return {ExitCode::no_device,
          found + "; a window needs a display with Vulkan, splatray-render writes pictures without one"};
}

/// Why the queue that computes cannot draw into a window.
std::string reason_not_to_present(VkInstance instance, VkPhysicalDevice device) {
  const std::uint32_t family = compute_queue_family(device);
  std::uint32_t count = family + 1;
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  if ((families[family].queueFlags & VK_QUEUE_GRAPHICS_BIT) == 0) return "no graphics queue";
  return glfwGetPhysicalDevicePresentationSupport(instance, device, family) == GLFW_TRUE
             ? ""
             : "it cannot show pictures on this display";
}

/// GLFW_MOD_* of the keys that are down.
int modifiers_down(GLFWwindow* window) {
  const auto either = [window](int left, int right, int modifier) {
    return glfwGetKey(window, left) == GLFW_PRESS || glfwGetKey(window, right) == GLFW_PRESS ? modifier : 0;
  };
  return either(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT, GLFW_MOD_SHIFT) |
         either(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL, GLFW_MOD_CONTROL) |
         either(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT, GLFW_MOD_ALT);
}

Window& window_of(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }

}  // namespace

Window::Window(const std::string& title, glm::uvec2 size, bool scaled) {
  if (glfwInit() != GLFW_TRUE) throw no_window("no display found (" + glfw_reason() + ")");
  try {
    if (glfwVulkanSupported() != GLFW_TRUE) throw no_window("no Vulkan driver for windows found");
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, scaled ? GLFW_TRUE : GLFW_FALSE);
    window_ =
        glfwCreateWindow(static_cast<int>(size.x), static_cast<int>(size.y), title.c_str(), nullptr, nullptr);
    if (window_ == nullptr) throw no_window("no window could be opened (" + glfw_reason() + ")");
    fit_monitor();
    listen();
  } catch (...) {
    glfwTerminate();
    throw;
  }
}

Window::~Window() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

/// Shrinks a window that is larger than the first monitor's work area: its controls would be out of sight.
void Window::fit_monitor() {
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  if (monitor == nullptr) return;
  glm::ivec2 corner(0), room(0);
  glfwGetMonitorWorkarea(monitor, &corner.x, &corner.y, &room.x, &room.y);
  const glm::ivec2 now(size()), fitting = glm::min(now, room);
  if (fitting.x <= 0 || fitting.y <= 0 || fitting == now) return;
  glfwSetWindowSize(window_, fitting.x, fitting.y);
  glfwSetWindowPos(window_, corner.x, corner.y);
}

void Window::listen() {
  // Dear ImGui's back end, started later, takes the places of these and passes on what it gets.
  using Kind = InputEvent::Kind;
  glfwSetWindowUserPointer(window_, this);
  glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double, double) {
    window_of(window).on_input({Kind::move, 0, 0, window_of(window).cursor_px()});
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int modifiers) {
    window_of(window).on_input({action == GLFW_PRESS ? Kind::press : Kind::release, button, modifiers,
                                window_of(window).cursor_px()});
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double notches) {
    window_of(window).on_input(
        {Kind::wheel, 0, modifiers_down(window), window_of(window).cursor_px(), notches});
  });
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int modifiers) {
    if (action == GLFW_PRESS) window_of(window).on_input({Kind::key, key, modifiers});
    window_of(window).happened_ = true;
  });
  glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
    window_of(window).dropped_.insert(window_of(window).dropped_.end(), paths, paths + count);
    window_of(window).happened_ = true;
  });
  // What else changes what is seen.
  glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned) { window_of(window).happened_ = true; });
  glfwSetCursorEnterCallback(window_, [](GLFWwindow* window, int) { window_of(window).happened_ = true; });
  glfwSetWindowFocusCallback(window_, [](GLFWwindow* window, int) { window_of(window).happened_ = true; });
  glfwSetWindowRefreshCallback(window_, [](GLFWwindow* window) { window_of(window).happened_ = true; });
  glfwSetFramebufferSizeCallback(window_,
                                 [](GLFWwindow* window, int, int) { window_of(window).happened_ = true; });
  glfwSetWindowContentScaleCallback(
      window_, [](GLFWwindow* window, float, float) { window_of(window).happened_ = true; });
  glfwSetWindowIconifyCallback(window_, [](GLFWwindow* window, int) { window_of(window).happened_ = true; });
  glfwSetWindowCloseCallback(window_, [](GLFWwindow* window) { window_of(window).happened_ = true; });
}

void Window::on_input(InputEvent event) {
  inputs_.push_back(event);
  happened_ = true;
}

glm::dvec2 Window::cursor_px() const {
  glm::dvec2 cursor;
  glfwGetCursorPos(window_, &cursor.x, &cursor.y);
  glm::ivec2 size, pixels;
  glfwGetWindowSize(window_, &size.x, &size.y);
  glfwGetFramebufferSize(window_, &pixels.x, &pixels.y);
  return cursor * glm::dvec2(pixels) / glm::dvec2(glm::max(size, glm::ivec2(1)));
}

bool Window::wait(double seconds) {
  if (seconds > 0.0 && !happened_)
    glfwWaitEventsTimeout(seconds);
  else
    glfwPollEvents();
  return happened_.exchange(false);
}

void Window::wake() {
  happened_ = true;
  glfwPostEmptyEvent();
}

bool Window::should_close() const { return glfwWindowShouldClose(window_) == GLFW_TRUE; }

glm::uvec2 Window::size() const {
  int width = 0, height = 0;
  glfwGetWindowSize(window_, &width, &height);
  return {width, height};
}

glm::uvec2 Window::framebuffer_size() const {
  if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE) return {0, 0};
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  return {width, height};
}

float Window::content_scale() const {
  float x = 1.0F, y = 1.0F;
  glfwGetWindowContentScale(window_, &x, &y);
  return x > 0.0F ? x : 1.0F;
}

std::vector<InputEvent> Window::take_inputs() { return std::exchange(inputs_, {}); }

bool Window::is_down(int key) const { return glfwGetKey(window_, key) == GLFW_PRESS; }

std::vector<std::filesystem::path> Window::take_dropped() { return std::exchange(dropped_, {}); }

void Window::set_title(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }

std::string Window::clipboard() const {
  const char* text = glfwGetClipboardString(window_);
  return text != nullptr ? text : "";
}

void Window::set_clipboard(const std::string& text) { glfwSetClipboardString(window_, text.c_str()); }

DeviceNeeds Window::needs() const {
  std::uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  if (names == nullptr) throw no_window("no way to show Vulkan's pictures on this display found");
  DeviceNeeds needs;
  needs.instance_extensions = {names, names + count};
  needs.device_extensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
  needs.refusal = reason_not_to_present;
  needs.second_queue = true;
  return needs;
}

VkSurfaceKHR Window::make_surface(VkInstance instance) const {
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  check(glfwCreateWindowSurface(instance, window_, nullptr, &surface), "making the window's surface");
  return surface;
}

}  // namespace splatray
