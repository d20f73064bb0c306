#include "engine/device/vulkan/instance.h"

#include <dlfcn.h>
#include <link.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <thread>

#include "engine/device/vulkan/vulkan_device.h"

namespace splatray {
namespace {

/// What the loader says on this thread while someone listens.
thread_local std::vector<std::string>* heard = nullptr;

/// Listens for so long.
class Listening {
 public:
  explicit Listening(std::vector<std::string>& words) { heard = &words; }
  ~Listening() { heard = nullptr; }
  Listening(const Listening&) = delete;
  Listening& operator=(const Listening&) = delete;
};

VKAPI_ATTR VkBool32 VKAPI_CALL on_words(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                        VkDebugUtilsMessageTypeFlagsEXT,
                                        const VkDebugUtilsMessengerCallbackDataEXT* data, void*) {
  if (heard != nullptr && data->pMessage != nullptr) heard->emplace_back(data->pMessage);
  return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT listener_info(const VkDebugUtilsMessengerCreateInfoEXT* next) {
  VkDebugUtilsMessengerCreateInfoEXT info{};
  info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  info.pNext = next;
  info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT;
  info.pfnUserCallback = on_words;
  return info;
}

/// All that `list(count, items)`, a vkEnumerate... function, lists. What it lists may change between two calls.
template <typename Item, typename List>
std::vector<Item> enumerate(const List& list, const char* what) {
  std::vector<Item> items;
  VkResult result = VK_INCOMPLETE;
  while (result == VK_INCOMPLETE) {
    std::uint32_t count = 0;
    check(list(&count, nullptr), what);
    items.resize(count);
    result = list(&count, items.data());
    items.resize(count);
  }
  check(result, what);
  return items;
}

VkResult make_instance(const VkDebugUtilsMessengerCreateInfoEXT* messenger, bool validation,
                       const std::vector<const char*>& extensions, VkInstance& instance) {
  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.pApplicationName = "splatray";
  application.apiVersion = VK_API_VERSION_1_2;
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pNext = messenger;
  info.pApplicationInfo = &application;
  info.enabledLayerCount = validation ? 1 : 0;
  info.ppEnabledLayerNames = &VALIDATION_LAYER;
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  return vkCreateInstance(&info, nullptr, &instance);
}

std::string text_of(VkResult result) {
  if (result == VK_SUCCESS) return "VK_SUCCESS and no device";
  return result == VK_ERROR_INCOMPATIBLE_DRIVER ? "VK_ERROR_INCOMPATIBLE_DRIVER"
                                                : "VK_ERROR_INITIALIZATION_FAILED";
}

/// The result and the first of the loader's words, each once.
std::string sentence_of(VkResult result, const std::vector<std::string>& words) {
  constexpr std::size_t MOST_WORDS = 4, MOST_LENGTH = 300;
  std::vector<std::string> told;
  for (const std::string& word : words)
    if (told.size() < MOST_WORDS && std::find(told.begin(), told.end(), word) == told.end())
      told.push_back(word);
  std::string sentence = text_of(result);
  for (const std::string& word : told)
    sentence += (&word == told.data() ? ", and the loader said '" : "'; '") + word.substr(0, MOST_LENGTH);
  return sentence + (told.empty() ? "" : "'");
}

/// Makes one instance after the other.
class Starter {
 public:
  Starter(const VkDebugUtilsMessengerCreateInfoEXT* validation, const std::vector<const char*>& extensions)
      : validation_(validation), extensions_(extensions) {}

  VulkanStart start() {
    std::vector<const char*> extensions = extensions_;
    if (validation_ != nullptr) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    return start(validation_, extensions);
  }

  /// The same, and hears what the loader says of it.
  VulkanStart start_listening() {
    const VkDebugUtilsMessengerCreateInfoEXT listener = listener_info(validation_);
    std::vector<const char*> extensions = extensions_;
    extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    words_.clear();
    const Listening listening(words_);
    return start(&listener, extensions);
  }

  /// Whether no device was found though a driver may be installed; the loader has words of its own for where there is none.
  [[nodiscard]] bool driver_failed() const {
    constexpr const char* NO_DRIVERS = "Found no drivers";
    return result_ != VK_ERROR_INCOMPATIBLE_DRIVER || words_.size() != 1 ||
           words_[0].find(NO_DRIVERS) == std::string::npos;
  }

 private:
  VulkanStart start(const VkDebugUtilsMessengerCreateInfoEXT* messenger,
                    const std::vector<const char*>& extensions) {
    VulkanStart started;
    result_ = make_instance(messenger, validation_ != nullptr, extensions, started.instance);
    if (result_ == VK_ERROR_INCOMPATIBLE_DRIVER)
      started.instance = VK_NULL_HANDLE;
    else
      check(result_, "starting Vulkan");
    if (started.instance != VK_NULL_HANDLE) started.devices = devices_of(started.instance);
    if (started.devices.empty() && driver_failed()) started.said = sentence_of(result_, words_);
    return started;
  }

  /// Lists the devices; without their hardware drivers may fail to.
  std::vector<VkPhysicalDevice> devices_of(VkInstance instance) {
    const auto list = [&](std::uint32_t* count, VkPhysicalDevice* devices) {
      result_ = vkEnumeratePhysicalDevices(instance, count, devices);
      if (result_ != VK_ERROR_INITIALIZATION_FAILED) return result_;
      *count = 0;
      return VK_SUCCESS;
    };
    try {
      return enumerate<VkPhysicalDevice>(list, "listing the Vulkan devices");
    } catch (...) {
      vkDestroyInstance(instance, nullptr);
      throw;
    }
  }

  const VkDebugUtilsMessengerCreateInfoEXT* validation_;
  const std::vector<const char*>& extensions_;
  VkResult result_ = VK_SUCCESS;
  std::vector<std::string> words_;
};

int add_name(dl_phdr_info* library, std::size_t, void* names) {
  if (library->dlpi_name[0] != '\0')
    static_cast<std::vector<std::string>*>(names)->emplace_back(library->dlpi_name);
  return 0;
}

/// Keeps all libraries that are loaded until the process ends, the drivers among them. The loader unloads a driver with its last
/// instance, and glibc does not get back what a library had of the static thread-local storage: NVIDIA's driver 580 could not be
/// loaded any more once it had been some tens of times.
void keep_libraries() {
  std::vector<std::string> names;
  dl_iterate_phdr(add_name, &names);
  for (const std::string& name : names)
    if (void* library = dlopen(name.c_str(), RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE)) dlclose(library);
}

}  // namespace

void sleep_for(std::chrono::milliseconds time) { std::this_thread::sleep_for(time); }

bool validation_layer_present() {
  const auto layers =
      enumerate<VkLayerProperties>(vkEnumerateInstanceLayerProperties, "listing the Vulkan layers");
  return std::any_of(layers.begin(), layers.end(), [](const VkLayerProperties& layer) {
    return std::strcmp(layer.layerName, VALIDATION_LAYER) == 0;
  });
}

VulkanStart start_vulkan(const VkDebugUtilsMessengerCreateInfoEXT* validation,
                         const std::vector<const char*>& extensions, const Pause& pause) {
  using std::chrono_literals::operator""ms;
  constexpr std::array PAUSES = {0ms, 25ms, 50ms, 100ms, 200ms};
  Starter starter(validation, extensions);
  VulkanStart started = starter.start();
  for (const std::chrono::milliseconds time : PAUSES) {
    if (!started.devices.empty() || !starter.driver_failed()) break;
    if (started.instance != VK_NULL_HANDLE) vkDestroyInstance(started.instance, nullptr);
    pause(time);
    started = starter.start_listening();
  }
  if (!started.devices.empty()) keep_libraries();
  return started;
}

}  // namespace splatray
