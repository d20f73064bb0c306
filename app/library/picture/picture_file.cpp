#include "app/library/picture/picture_file.h"

#include <cstdio>

#include "app/library/codec/picture_format.h"
#include "app/library/commit.h"
#include "app/library/measure/measure_file.h"
#include "app/library/picture/compare.h"
#include "app/library/picture/reproduce.h"
#include "app/library/request/command_line.h"
#include "app/library/sheet/sheet_files.h"
#include "app/library/shot/resolve.h"
#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/base/number_text.h"
#include "engine/file/atomic_file.h"
#include "engine/image/sample_mean.h"
#include "preprocess/base/file_extension.h"

namespace splatray {
namespace {

Display display_of(const Request& request) {
  return {request.look.exposure_ev.value_or(0.0), resolve_tone(request), request.settings.transparent};
}

std::string size_text(std::uint32_t width, std::uint32_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

std::vector<unsigned char> encode_picture(const Shot& shot, const Image& image, const Metadata& metadata,
                                          const std::filesystem::path& path) {
  if (is_display_format(path)) return encode_display(shown_image(shot, image), metadata, path);
  if (lower_extension(path) != ".exr") return encode_sheet(shot, shown_image(shot, image), metadata, path);
  ExrPicture picture = exr_picture(image, shot.request.output.aovs, metadata);
  if (shot.view.window.width > 0) {
    picture.width = shot.view.width;
    picture.height = shot.view.height;
    picture.window = shot.view.window;
  }
  return encode_exr(picture);
}

/// What was chosen, of a picture made again by that picture's request.
std::string choices_of(const Shot& shot) {
  if (!shot.choices.empty()) return choices_text(shot);
  return shot.request.output.chosen.empty() ? "none" : shot.request.output.chosen;
}

}  // namespace

std::uint64_t made_image_bytes(const Shot& shot) {
  const PixelWindow made = shot.view.made();
  Settings settings = shot.traced_settings();
  settings.estimate_error = settings.estimate_error || shot.request.settings.has_goal();
  const bool shows_albedo = needs(shot.request.output.aovs, AovSource::albedo);
  return std::uint64_t{made.width} * made.height *
         (image_bytes(settings) + (shows_albedo ? sizeof(vec4) : 0));
}

void require_picture_memory(const Shot& shot) {
  const PixelWindow made = shot.view.made();
  const Request::Output& output = shot.request.output;
  const std::size_t channels = 4 + count_channels(output.aovs);
  const std::uint64_t writing =
      is_display_format(output.path) ? DISPLAY_WRITING_BYTES : exr_writing_bytes(channels);
  const std::uint64_t ranges = shot.is_sequence() ? 0 : range_bytes(shot.settings.samples);
  require_memory(made_image_bytes(shot) + std::uint64_t{made.width} * made.height * (writing + ranges),
                 "a picture of " + size_text(made.width, made.height) + " pixels and its file");
}

void require_outputs_writable(const Request& request) {
  const Request::Output& output = request.output;
  require_writable(output.film.empty() ? output.path : output.film);
  if (!output.height_raster.empty()) require_writable(output.height_raster);
  if (!output.measures.empty()) static_cast<void>(read_measures(output.measures, ""));
  require_picture_writer(output.path);
  const bool drawn =
      request.view.sheet && !is_picture_format(output.path) && lower_extension(output.path) != ".dxf";
  if (drawn || !output.height_raster.empty()) require_sheet_writer();
  if (!output.stats_json.empty()) require_writable(output.stats_json);
}

std::optional<DisplayImage> read_reference(const Request& request) {
  if (request.output.reference.empty()) return {};
  DisplayImage reference = read_display_image(request.output.reference, display_of(request));
  const glm::uvec2 size = picture_size(request.view);
  if (reference.width != size.x || reference.height != size.y)
    throw Error(ExitCode::failed, "reference '" + request.output.reference.string() + "' is " +
                                      size_text(reference.width, reference.height) +
                                      ", expected the picture's " + size_text(size.x, size.y));
  return reference;
}

std::string device_text(const Device& device) { return device.info().name + ", " + device.info().driver; }

std::string joined_devices(const std::string& devices, const std::string& more) {
  const std::string between = "; ";
  const bool named = (between + devices + between).find(between + more + between) != std::string::npos;
  return named ? devices : devices + between + more;
}

Metadata picture_metadata(const Shot& shot, const Scene& scene, const Camera& camera,
                          const std::string& devices) {
  const std::pair<std::string, std::string> projection =
      camera.panorama             ? std::pair("projection", "equirectangular")
      : camera.ortho_height > 0.0 ? std::pair("ortho_height", number_text(camera.ortho_height))
                                  : std::pair("fov_y_deg", number_text(camera.fov_y_deg));
  Metadata metadata = {{"command_line", command_line(still_request(shot, camera))},
                       {"eye", number_text(camera.eye)},
                       {"target", number_text(camera.target)},
                       {"up", number_text(camera.up)},
                       projection,
                       {"diagonal_world", number_text(scene.diagonal_world())},
                       {"device", devices},
                       {"samples", std::to_string(shot.settings.samples)},
                       {"seed", std::to_string(shot.settings.seed)},
                       {"commit", COMMIT},
                       {"choices", choices_of(shot)}};
  if (!shot.lod_error.empty()) metadata.emplace_back("lod_error", shot.lod_error);
  return metadata;
}

DisplayImage shown_image(const Shot& shot, const Image& image) {
  DisplayImage shown = display_image(image, display_of(shot.request));
  if (shot.sheet() != nullptr) shown.dots_per_inch = shot.sheet()->asked.dpi;
  return shown;
}

void write_output(const Shot& shot, const Image& image, const Metadata& metadata,
                  const std::filesystem::path& path) {
  FileSet files;
  const std::vector<unsigned char> bytes = encode_picture(shot, image, metadata, path);
  files.add(path, bytes.data(), bytes.size());
  if (shot.sheet() != nullptr) add_sheet_places(shot, image, path, files);
  files.commit();
}

std::filesystem::path difference_file(std::filesystem::path picture) {
  return picture.replace_extension(".diff.png");
}

void require_match(const Shot& shot, const Image& image, const DisplayImage& reference) {
  const Request& request = shot.request;
  const Tolerance tolerance{request.output.reference_threshold, request.output.reference_share,
                            request.output.reference_limit};
  DisplayImage picture = shown_image(shot, image);
  if (is_display_format(request.output.path)) quantise(picture);
  const Comparison comparison = compare(picture, reference, tolerance);
  const std::string numbers = describe(comparison, tolerance);
  if (comparison.passed) {
    if (!request.output.quiet)
      std::fprintf(stderr, "splatray-render: matches the reference: %s\n", numbers.c_str());
    return;
  }
  const std::filesystem::path difference = difference_file(request.output.path);
  write_png(comparison.difference, {}, difference);
  throw Error(ExitCode::failed, "'" + request.output.path.string() + "' differs from '" +
                                    request.output.reference.string() + "': " + numbers + "; see '" +
                                    difference.string() + "'");
}

}  // namespace splatray
