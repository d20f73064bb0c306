#include <dlfcn.h>
#include <gtest/gtest.h>
#include <link.h>

#include <cctype>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "engine/base/error.h"
#include "engine/device/vulkan/instance.h"
#include "engine/device/vulkan/vulkan_device.h"
#include "tests/temp_folder.h"

namespace splatray {
namespace {

const std::vector<DeviceInfo> MACHINE = {
    {"llvmpipe", "CPU", "", "1.3.0", ""},
    {"Old Card 9000", "discrete GPU", "", "1.1.0", "Vulkan 1.1.0 found, 1.2 needed"},
    {"Chip Graphics", "integrated GPU", "", "1.3.0", ""},
    {"Big Card 2", "discrete GPU", "", "1.3.0", ""},
    {"Big Card 3", "discrete GPU", "", "1.3.0", ""},
};

/// Sets a variable of the environment, and puts it back.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    setenv(name, value, 1);
  }
  ~Variable() {
    if (old_.empty()) {
      unsetenv(name_);
    } else {
      setenv(name_, old_.c_str(), 1);
    }
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::string old_;
};

/// The Error that `action` throws; fails the test when it throws none.
template <typename Action>
Error error_of(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "no Error was thrown";
  return {ExitCode::done, ""};
}

std::string refusal(const std::vector<DeviceInfo>& devices, const std::string& wanted) {
  const Error error = error_of([&] { (void)choose_device(devices, wanted); });
  EXPECT_EQ(error.code(), ExitCode::no_device);
  return error.what();
}

TEST(DeviceChoice, ARefusalListsWhatWasFound) {
  const std::string text = error_of([] { (void)choose_device(MACHINE, "x"); }).what();
  EXPECT_EQ(text.find("no usable Vulkan device matches 'x', found 0: llvmpipe (usable); 1: Old Card"), 0U)
      << text;
}

TEST(DeviceChoice, TakesTheFirstBestUsableDevice) { EXPECT_EQ(choose_device(MACHINE, ""), 3U); }

TEST(DeviceChoice, SoftwareDeviceWinsOnlyAlone) {
  EXPECT_EQ(choose_device({MACHINE[0], MACHINE[2]}, ""), 1U);
  EXPECT_EQ(choose_device({MACHINE[0], MACHINE[1]}, ""), 0U);
  EXPECT_EQ(choose_device({MACHINE[0], {"Odd", "other", "", "1.3.0", ""}}, ""), 1U);
}

TEST(DeviceChoice, TakesANumberOrPartOfAName) {
  EXPECT_EQ(choose_device(MACHINE, "0"), 0U);
  EXPECT_EQ(choose_device(MACHINE, "4"), 4U);
  EXPECT_EQ(choose_device(MACHINE, "CARD 3"), 4U);
  EXPECT_EQ(choose_device(MACHINE, "graph"), 2U);
}

TEST(DeviceChoice, RefusedDeviceIsNamedWithItsReason) {
  for (const char* wanted : {"1", "9000"}) {
    const std::string sentence = refusal(MACHINE, wanted);
    EXPECT_NE(sentence.find("Old Card 9000"), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("Vulkan 1.1.0 found, 1.2 needed"), std::string::npos) << sentence;
  }
}

TEST(DeviceChoice, UnknownNameListsTheDevices) {
  const std::string sentence = refusal(MACHINE, "Voodoo");
  EXPECT_NE(sentence.find("Voodoo"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("2: Chip Graphics (usable)"), std::string::npos) << sentence;
}

TEST(DeviceChoice, ContextTakesEachListedDeviceByNumberAndName) {
  const std::vector<DeviceInfo> devices = list_devices();
  ASSERT_FALSE(devices.empty()) << "this test needs a Vulkan driver";
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (!devices[i].refused.empty()) continue;
    EXPECT_EQ(VulkanDevice(std::to_string(i)).info().name, devices[i].name);
    std::string shouted = devices[i].name;
    for (char& letter : shouted) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    EXPECT_EQ(VulkanDevice(shouted).info().name, devices[i].name);
  }
}

TEST(DeviceChoice, ContextRefusesANameThatNoDeviceHas) {
  EXPECT_EQ(error_of([] { VulkanDevice device("no such device"); }).code(), ExitCode::no_device);
}

TEST(DeviceChoice, NoDriverIsOneHelpfulSentence) {
  const Variable files("VK_DRIVER_FILES", "/nonexistent/driver.json");
  const Variable validation("SPLATRAY_VALIDATION", "0");
  EXPECT_TRUE(list_devices().empty());
  const Error error = error_of([] { VulkanDevice device; });
  EXPECT_EQ(error.code(), ExitCode::no_device);
  EXPECT_NE(std::string(error.what()).find("mesa-vulkan-drivers"), std::string::npos) << error.what();
}

/// A manifest of the library `file` beside it; its name is one that the tests' choice of drivers lets pass.
std::filesystem::path manifest_of(const TempFolder& folder, const std::string& file) {
  return folder.write("lvp_icd.json", R"({"file_format_version":"1.0.0","ICD":{"library_path":")" +
                                          (folder.path() / file).string() + R"(","api_version":"1.3.0"}})");
}

TEST(DeviceChoice, ADriverThatDoesNotLoadIsReportedInTheLoadersWords) {
  const TempFolder folder;
  folder.write("libbroken.so", "no library");
  const Variable files("VK_DRIVER_FILES", manifest_of(folder, "libbroken.so").c_str());
  const Variable validation("SPLATRAY_VALIDATION", "0");
  const std::string sentence = error_of([] { VulkanDevice device; }).what();
  EXPECT_NE(sentence.find("no Vulkan device found (VK_ERROR_INCOMPATIBLE_DRIVER"), std::string::npos)
      << sentence;
  EXPECT_NE(sentence.find("libbroken.so"), std::string::npos) << sentence;
}

/// A driver that starts at the fourth try, as one whose libraries cannot be loaded while memory is short.
TEST(DeviceChoice, ADriverThatFailsForAWhileIsTriedAgain) {
  void* lavapipe = dlopen("libvulkan_lvp.so", RTLD_NOW);
  if (lavapipe == nullptr) GTEST_SKIP() << "lavapipe is not installed";
  const link_map* library = nullptr;
  ASSERT_EQ(dlinfo(lavapipe, RTLD_DI_LINKMAP, &library), 0);
  const TempFolder folder;
  const Variable files("VK_DRIVER_FILES", manifest_of(folder, "liblate.so").c_str());
  int pauses = 0;
  const VulkanStart started = start_vulkan(nullptr, {}, [&](std::chrono::milliseconds) {
    if (++pauses == 3) std::filesystem::create_symlink(library->l_name, folder.path() / "liblate.so");
  });
  EXPECT_EQ(started.devices.size(), 1U);
  EXPECT_EQ(started.said, "");
  EXPECT_EQ(pauses, 3);
  ASSERT_NE(started.instance, nullptr);
  vkDestroyInstance(started.instance, nullptr);
}

/// Else NVIDIA's is out of static thread-local storage once it was loaded some tens of times.
TEST(DeviceChoice, ADriverOnceStartedStaysLoaded) {
  void* lavapipe = dlopen("libvulkan_lvp.so", RTLD_NOW);
  if (lavapipe == nullptr) GTEST_SKIP() << "lavapipe is not installed";
  const link_map* library = nullptr;
  ASSERT_EQ(dlinfo(lavapipe, RTLD_DI_LINKMAP, &library), 0);
  const TempFolder folder;
  const std::filesystem::path copy = folder.path() / "libcopy.so";  // which no other device has loaded
  std::filesystem::copy_file(library->l_name, copy);
  const Variable files("VK_DRIVER_FILES", manifest_of(folder, "libcopy.so").c_str());
  EXPECT_EQ(dlopen(copy.c_str(), RTLD_NOW | RTLD_NOLOAD), nullptr);
  EXPECT_EQ(list_devices().size(), 1U);
  EXPECT_NE(dlopen(copy.c_str(), RTLD_NOW | RTLD_NOLOAD), nullptr);
}

TEST(DeviceChoice, TriesEnd) {
  const TempFolder folder;
  const Variable files("VK_DRIVER_FILES", manifest_of(folder, "libmissing.so").c_str());
  std::chrono::milliseconds waited{0};
  const VulkanStart started =
      start_vulkan(nullptr, {}, [&](std::chrono::milliseconds time) { waited += time; });
  EXPECT_TRUE(started.devices.empty());
  EXPECT_EQ(started.instance, nullptr);
  EXPECT_EQ(waited, std::chrono::milliseconds(375));
}

TEST(DeviceChoice, NoOneWaitsWhereNoDriverIsInstalled) {
  const Variable choice("VK_LOADER_DRIVERS_SELECT", "*no_such_driver*");
  std::chrono::milliseconds waited{0};
  const VulkanStart started =
      start_vulkan(nullptr, {}, [&](std::chrono::milliseconds time) { waited += time; });
  EXPECT_TRUE(started.devices.empty());
  EXPECT_EQ(started.said, "");
  EXPECT_EQ(waited, std::chrono::milliseconds(0));
}

TEST(DeviceChoice, MissingValidationLayerNamesItsPackage) {
  const Variable layers("VK_LAYER_PATH", "/nonexistent");
  const Error error = error_of([] { VulkanDevice device("", true); });
  EXPECT_EQ(error.code(), ExitCode::failed);
  EXPECT_NE(std::string(error.what()).find("vulkan-validationlayers"), std::string::npos) << error.what();
}

TEST(DeviceNeeds, WhatIsOptionalIsLeftOutWhereADeviceHasItNot) {
  DeviceNeeds needs;
  needs.refusal = [](VkInstance, VkPhysicalDevice) { return std::string("no window"); };
  needs.second_queue = true;
  EXPECT_THROW(VulkanDevice("", false, needs), Error);
  needs.optional = true;
  const VulkanDevice refused("", false, needs);
  EXPECT_FALSE(refused.meets_needs());
  EXPECT_EQ(refused.second_queue().get(), refused.queue->get());
  needs.refusal = {};
  needs.device_extensions = {"VK_SPLATRAY_nothing"};
  const VulkanDevice without("", false, needs);
  EXPECT_FALSE(without.meets_needs());
  EXPECT_EQ(without.second_queue().wait(), VK_SUCCESS);
  EXPECT_TRUE(VulkanDevice().meets_needs());
}

}  // namespace
}  // namespace splatray
