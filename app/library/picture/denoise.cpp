#include "app/library/picture/denoise.h"

#include <dlfcn.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "engine/base/error.h"
#include "engine/image/denoise.h"
#include "engine/scene/look_style.h"

namespace splatray {
namespace {

constexpr std::uint32_t BASE_SAMPLES = 16;  ///< enough for what base colours do within a pixel

/// Open Image Denoise 2, by its C interface, which is stable within a major version.
class OpenImageDenoise {
 public:
  /// Nothing where it is not installed.
  static std::optional<OpenImageDenoise> find() {
    std::unique_ptr<void, Close> library(dlopen("libOpenImageDenoise.so.2", RTLD_NOW | RTLD_LOCAL));
    if (!library) return {};
    return OpenImageDenoise(std::move(library));
  }

  /// Replaces the colours of the image. Returns the library's version.
  std::string run(Image& image, std::span<const vec4> base) const {
    const std::unique_ptr<void, void (*)(void*)> device(new_device(0), release_device);
    commit_device(device.get());
    const std::unique_ptr<void, void (*)(void*)> filter(new_filter(device.get(), "RT"), release_filter);
    const auto set = [&](const char* name, const void* data, std::size_t stride) {
      set_image(filter.get(), name, const_cast<void*>(data), FLOAT3, image.width, image.height, 0, stride, 0);
    };
    std::vector<vec4> output = image.rgba;
    set("color", image.rgba.data(), sizeof(vec4));
    set("albedo", base.data(), sizeof(vec4));
    set("normal", image.aov.data(), sizeof(AovPixel));
    set("output", output.data(), sizeof(vec4));
    set_bool(filter.get(), "hdr", true);
    commit_filter(filter.get());
    execute(filter.get());
    const char* message = nullptr;
    if (get_error(device.get(), &message) != 0)
      throw Error(ExitCode::failed,
                  std::string("Open Image Denoise: ") + (message != nullptr ? message : "failed"));
    image.rgba = std::move(output);
    const int version = get_int(device.get(), "version");
    return std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) + "." +
           std::to_string(version % 100);
  }

 private:
  static constexpr int FLOAT3 = 3;

  struct Close {
    void operator()(void* library) const { dlclose(library); }
  };

  explicit OpenImageDenoise(std::unique_ptr<void, Close> library) : library_(std::move(library)) {
    take(new_device, "oidnNewDevice");
    take(commit_device, "oidnCommitDevice");
    take(release_device, "oidnReleaseDevice");
    take(get_error, "oidnGetDeviceError");
    take(get_int, "oidnGetDeviceInt");
    take(new_filter, "oidnNewFilter");
    take(set_image, "oidnSetSharedFilterImage");
    take(set_bool, "oidnSetFilterBool");
    take(commit_filter, "oidnCommitFilter");
    take(execute, "oidnExecuteFilter");
    take(release_filter, "oidnReleaseFilter");
  }

  template <class Function>
  void take(Function*& function, const char* name) {
    function = reinterpret_cast<Function*>(dlsym(library_.get(), name));
    if (function == nullptr)
      throw Error(ExitCode::failed,
                  std::string("Open Image Denoise has no ") + name + ", expected its version 2");
  }

  std::unique_ptr<void, Close> library_;
  void* (*new_device)(int type) = nullptr;
  void (*commit_device)(void* device) = nullptr;
  void (*release_device)(void* device) = nullptr;
  int (*get_error)(void* device, const char** message) = nullptr;
  int (*get_int)(void* device, const char* name) = nullptr;
  void* (*new_filter)(void* device, const char* type) = nullptr;
  void (*set_image)(void* filter, const char* name, void* data, int format, std::size_t width,
                    std::size_t height, std::size_t offset, std::size_t pixel_stride,
                    std::size_t row_stride) = nullptr;
  void (*set_bool)(void* filter, const char* name, bool value) = nullptr;
  void (*commit_filter)(void* filter) = nullptr;
  void (*execute)(void* filter) = nullptr;
  void (*release_filter)(void* filter) = nullptr;
};

}  // namespace

std::optional<Settings> base_settings(const Settings& settings) {
  if (!look_style(settings.look).colors) return {};
  Settings plain = settings;
  plain.look = LOOK_BASE;
  plain.samples = std::min(settings.samples, BASE_SAMPLES);
  plain.sample_offset = 0;  // the same of all ranges of a picture's samples
  plain.aov = plain.estimate_error = plain.counters = false;
  return plain;
}

std::vector<vec4> base_colors(Tracer& tracer, const Look& look, const View& view, const Settings& settings,
                              const Tracer::Progress& progress) {
  const PixelWindow made = view.made();
  if (const std::optional<Settings> plain = base_settings(settings))
    return tracer.render(look, view, *plain, progress).rgba;
  return std::vector<vec4>(std::size_t{made.width} * made.height, vec4(1.0F));
}

namespace {

const std::optional<OpenImageDenoise>& open_image_denoise() {
  static const std::optional<OpenImageDenoise> library = OpenImageDenoise::find();
  return library;
}

}  // namespace

bool has_own_filter() { return !open_image_denoise(); }

std::string remove_noise(Image& image, std::vector<vec4> base) {
  if (const auto& library = open_image_denoise()) {
    make_finite(image, base);
    return "Open Image Denoise " + library->run(image, base);
  }
  image = denoised(std::move(image), std::move(base));
  return "splatray's own filter";
}

}  // namespace splatray
