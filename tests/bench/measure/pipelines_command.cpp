/// splatray-bench pipelines SCENE.soct [--device D]: what the driver says of the programs that show a scene, each in a line
/// (VK_KHR_pipeline_executable_properties): on NVIDIA's registers, bytes of code, of spills and of shared memory. Links the engine
/// only, so that it runs on a bare GPU machine.
#include <cstdio>

#include "engine/base/error.h"
#include "engine/device/vulkan/pipeline.h"
#include "engine/device/vulkan/program_code.h"
#include "engine/file/scene_file.h"
#include "engine/gpu/runner.h"
#include "engine/scene/environment.h"
#include "tests/bench/commands.h"
#include "tests/bench/measure/measuring_options.h"

namespace splatray::testing {
namespace {

constexpr const char* USAGE =
    "splatray-bench pipelines SCENE.soct [--device NUMBER|NAME]\n"
    "Prints what the driver says of the programs that show a scene: registers, code, spills.\n"
    "  --device   number or part of a name, as splatray-render --list-devices shows them; default the best\n";

constexpr const char* EXTENSION = VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;

/// A device whose driver tells; throws Error (no_device) where it does not.
class TellingDevice {
 public:
  explicit TellingDevice(const std::string& wanted) : vulkan_(open(wanted)) {
    find("vkGetPipelineExecutablePropertiesKHR", parts_);
    find("vkGetPipelineExecutableStatisticsKHR", statistics_);
  }

  [[nodiscard]] const VulkanDevice& vulkan() const { return *vulkan_; }

  /// Prints the statistics of each part of a pipeline.
  void print(const char* name, VkPipeline pipeline) const {
    VkPipelineInfoKHR info{VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR, nullptr, pipeline};
    std::uint32_t count = 0;
    check(parts_(vulkan_->device, &info, &count, nullptr), "asking for a pipeline's parts");
    for (std::uint32_t part = 0; part < count; ++part) {
      std::printf("%s:", name);
      for (const VkPipelineExecutableStatisticKHR& statistic : statistics_of(pipeline, part))
        print(statistic);
      std::printf("\n");
    }
  }

 private:
  static std::unique_ptr<VulkanDevice> open(const std::string& wanted) {
    VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR features{};
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR;
    features.pipelineExecutableInfo = VK_TRUE;
    DeviceNeeds needs;
    needs.device_extensions = {EXTENSION};
    needs.features = &features;
    try {
      return std::make_unique<VulkanDevice>(wanted, false, needs);
    } catch (const Error& error) {
      throw Error(error.code(), std::string(error.what()) + " (expected one with " + EXTENSION + ")");
    }
  }

  template <class Function>
  void find(const char* name, Function& function) const {
    function = reinterpret_cast<Function>(vkGetInstanceProcAddr(vulkan_->instance, name));
    if (function == nullptr)
      throw Error(ExitCode::no_device,
                  std::string("found no ") + name + ", expected a driver with " + EXTENSION);
  }

  [[nodiscard]] std::vector<VkPipelineExecutableStatisticKHR> statistics_of(VkPipeline pipeline,
                                                                            std::uint32_t part) const {
    const VkPipelineExecutableInfoKHR info{VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR, nullptr, pipeline,
                                           part};
    std::uint32_t count = 0;
    check(statistics_(vulkan_->device, &info, &count, nullptr), "asking for a pipeline's statistics");
    VkPipelineExecutableStatisticKHR empty{};
    empty.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR;
    std::vector<VkPipelineExecutableStatisticKHR> statistics(count, empty);
    check(statistics_(vulkan_->device, &info, &count, statistics.data()),
          "asking for a pipeline's statistics");
    return statistics;
  }

  static void print(const VkPipelineExecutableStatisticKHR& statistic) {
    std::printf(" %s ", statistic.name);
    if (statistic.format == VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_FLOAT64_KHR)
      std::printf("%g;", statistic.value.f64);
    else if (statistic.format == VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_BOOL32_KHR)
      std::printf("%u;", statistic.value.b32);
    else
      std::printf("%lld;", static_cast<long long>(statistic.value.i64));
  }

  std::unique_ptr<VulkanDevice> vulkan_;
  PFN_vkGetPipelineExecutablePropertiesKHR parts_ = nullptr;
  PFN_vkGetPipelineExecutableStatisticsKHR statistics_ = nullptr;
};

/// Prints what is told of a dispatch's program.
void print_program(const TellingDevice& device, Runner& runner, const char* name, const Dispatch& dispatch) {
  const VkPipelineLayout layout = static_cast<VulkanBindings&>(runner.scene.bindings()).layout()->get();
  const auto pipeline =
      make_pipeline(device.vulkan(), {dispatch.program, dispatch.constants}, program_code(dispatch.program),
                    layout, VK_NULL_HANDLE, VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR);
  device.print(name, pipeline.get());
}

void print_programs(const TellingDevice& device, Scene scene) {
  Runner runner(device.vulkan(), {});
  const View view{default_camera(scene, 1.0), 64, 64};
  if (scene.lights.empty()) scene.lights = default_lights(scene, view.camera);
  Look look = look_of(scene);
  look.environment = std::make_shared<const Environment>(studio_environment());
  runner.scene.upload_and_free(scene);
  runner.scene.show(look);
  Settings settings;
  for (const auto& [name, number] :
       {std::pair{"paper", LOOK_PAPER}, {"lit", LOOK_LIT}, {"ao", LOOK_AO}, {"scan", LOOK_SCAN}}) {
    settings.look = number;
    print_program(device, runner, name, runner.picture_dispatch(view, settings));
  }
  Dispatch rays;
  rays.program = Program::rays;
  rays.constants = query_features(runner.scene.content(), settings);
  print_program(device, runner, "rays", rays);
}

}  // namespace

int bench_pipelines(int argc, char** argv) {
  std::filesystem::path scene;
  std::string wanted;
  const ValueOptions values{{"--device", [&](const std::string& value) { wanted = value; }}};
  if (!parse_words({argv + 1, argv + argc}, scene, values, {}, "SCENE.soct")) {
    std::fputs(USAGE, stdout);
    return static_cast<int>(ExitCode::done);
  }
  if (scene.empty())
    throw Error(ExitCode::usage, "found no scene, expected SCENE.soct (--help lists the options)");
  const TellingDevice device(wanted);
  std::printf("%s, %s; fma() rounds once: %s\n", device.vulkan().info().name.c_str(),
              device.vulkan().info().driver.c_str(), device.vulkan().make_queue()->fuses() ? "yes" : "no");
  print_programs(device, read_scene(scene));
  return static_cast<int>(ExitCode::done);
}

}  // namespace splatray::testing
