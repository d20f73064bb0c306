#include "app/cli/picture.h"

#include <cstdio>

#include "app/cli/command_line.h"
#include "app/cli/reproduce.h"
#include "app/library/commit.h"
#include "app/library/compare.h"
#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/base/number_text.h"
#include "engine/file/atomic_file.h"
#include "preprocess/base/file_extension.h"

namespace splatray {
namespace {

bool is_png(const std::filesystem::path& path) { return lower_extension(path) == ".png"; }

Display display_of(const RenderOptions& options) {
  return {options.exposure_ev.value_or(0.0), choose_tone(options.picture)};
}

std::string size_text(std::uint32_t width, std::uint32_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

}  // namespace

void require_picture_memory(const RenderOptions& options) {
  const PixelWindow made = View{{}, options.picture.width, options.picture.height, options.window()}.made();
  Settings settings = options.picture.settings;
  settings.aov = settings.aov || options.denoise;
  settings.estimate_error = settings.estimate_error || options.denoise || options.has_goal();
  const std::size_t channels = 4 + (options.aov_depth ? 1 : 0) + (options.aov_normal ? 3 : 0) +
                               (options.aov_id ? 1 : 0) + (options.aov_error ? 1 : 0);
  const std::uint64_t writing = is_png(options.output) ? PNG_WRITING_BYTES : exr_writing_bytes(channels);
  require_memory(std::uint64_t{made.width} * made.height * (image_bytes(settings) + writing),
                 "a picture of " + size_text(made.width, made.height) + " pixels and its file");
}

void require_outputs_writable(const RenderOptions& options) {
  require_writable(options.output);
  if (!options.stats_json.empty()) require_writable(options.stats_json);
}

std::optional<DisplayImage> read_reference(const RenderOptions& options) {
  if (options.reference.empty()) return {};
  // An exposure that the picture itself decides cannot be that of a float reference: it is taken as it is.
  DisplayImage reference = read_display_image(options.reference, display_of(options));
  if (reference.width != options.picture.width || reference.height != options.picture.height)
    throw Error(ExitCode::failed, "reference '" + options.reference.string() + "' is " +
                                      size_text(reference.width, reference.height) +
                                      ", expected the picture's " +
                                      size_text(options.picture.width, options.picture.height));
  return reference;
}

Metadata picture_metadata(const RenderOptions& options, const Scene& scene, const View& view,
                          const Context& context) {
  const Camera& camera = view.camera;
  const bool ortho = camera.ortho_height > 0.0;
  return {{"command_line", command_line(still_options(options, camera))},
          {"eye", number_text(camera.eye)},
          {"target", number_text(camera.target)},
          {"up", number_text(camera.up)},
          {ortho ? "ortho_height" : "fov_y_deg", number_text(ortho ? camera.ortho_height : camera.fov_y_deg)},
          {"diagonal_world", number_text(scene.diagonal_world())},
          {"device", context.device_info().name + ", " + context.device_info().driver},
          {"samples", std::to_string(options.picture.settings.samples)},
          {"seed", std::to_string(options.picture.settings.seed)},
          {"commit", COMMIT}};
}

void write_output(const RenderOptions& options, const Image& image, const Metadata& metadata,
                  const std::filesystem::path& path) {
  if (is_png(path)) return write_png(display_image(image, display_of(options)), metadata, path);
  ExrPicture picture = exr_picture(
      image, {options.aov_depth, options.aov_normal, options.aov_id, options.aov_error}, metadata);
  if (const PixelWindow window = options.window(); window.width > 0) {
    picture.width = options.picture.width;
    picture.height = options.picture.height;
    picture.window = window;
  }
  write_exr(picture, path);
}

void require_match(const RenderOptions& options, const Image& image, const DisplayImage& reference) {
  const Tolerance tolerance{options.reference_threshold, options.reference_share, options.reference_limit};
  DisplayImage picture = display_image(image, display_of(options));
  if (is_png(options.output)) quantise(picture);
  const Comparison comparison = compare(picture, reference, tolerance);
  const std::string numbers = describe(comparison, tolerance);
  if (comparison.passed) {
    if (!options.quiet) std::fprintf(stderr, "splatray-render: matches the reference: %s\n", numbers.c_str());
    return;
  }
  std::filesystem::path difference = options.output;
  difference.replace_extension(".diff.png");
  write_png(comparison.difference, {}, difference);
  throw Error(ExitCode::failed, "'" + options.output.string() + "' differs from '" +
                                    options.reference.string() + "': " + numbers + "; see '" +
                                    difference.string() + "'");
}

}  // namespace splatray
