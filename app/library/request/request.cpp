#include "app/library/request/request.h"

#include <algorithm>
#include <cstdlib>

#include "app/library/codec/picture_format.h"
#include "engine/base/error.h"
#include "engine/image/sample_mean.h"
#include "preprocess/base/file_extension.h"

namespace splatray {
namespace {

[[noreturn]] void fail(const std::string& sentence) { throw Error(ExitCode::usage, sentence); }

void check_sample_range(const Request& request) {
  constexpr std::uint32_t MOST = 65536;
  const std::uint32_t samples = request.settings.samples, offset = request.settings.sample_offset;
  const std::string found =
      "found --sample-offset " + std::to_string(offset) + " with --samples " + std::to_string(samples);
  if (offset % whole_range(samples) != 0)
    fail(found + ", expected a multiple of " + std::to_string(whole_range(samples)));
  if (offset + samples > MOST) fail(found + ", expected at most " + std::to_string(MOST) + " in all");
  if (offset > 0 && needs_noise(request.output.aovs))
    fail("found --aov error with --sample-offset, expected it for all samples of a picture");
}

void check_part(const Request& request) {
  const Request::View& view = request.view;
  const PixelWindow window = view.window();
  const bool is_range = request.settings.sample_offset > 0;
  if (view.tiles == 0 && window.width == 0 && !is_range) return;
  check_sample_range(request);
  if (view.tiles > 0 && view.crop.width > 0) fail("found --crop and --tile, expected one of them");
  // How many pixels a sheet has, its scene says.
  const bool known = !view.sheet || view.made_sheet;
  if (known && view.tiles > view.height)
    fail("found --tile of " + std::to_string(view.tiles) + " parts, expected at most the picture's " +
         std::to_string(view.height) + " rows");
  if (known && (window.x + window.width > view.width || window.y + window.height > view.height))
    fail("found --crop beyond the picture's " + std::to_string(view.width) + "x" +
         std::to_string(view.height) + " pixels, expected a part of it (--resolution)");
  const std::string part = is_range ? "--sample-offset" : (view.tiles > 0 ? "--tile" : "--crop");
  if (request.settings.has_goal()) fail("found --error or --time with " + part + ", expected --samples");
  // A crop is a picture by itself; parts that are joined later keep their noise, which is taken out of the whole.
  const bool joined = view.tiles > 0 || is_range;
  if (joined && (request.output.denoise || request.output.despeckle))
    fail(std::string("found ") + (request.output.denoise ? "--denoise" : "--despeckle") + " with " + part +
         ", expected it for a whole picture or a --crop");
  if (!request.output.reference.empty())
    fail("found --reference with " + part + ", expected a whole picture");
}

void check_resume(const Request& request) {
  if (request.output.resume.empty()) return;
  if (request.settings.has_goal()) fail("found --resume with --error or --time, expected --samples");
  if (request.output.many()) fail("found --resume with a sequence of pictures, expected a single one");
}

/// Whether anything is said of the camera.
bool has_camera(const Request::View& view) {
  return view.eye || view.fov_y_deg || view.lens_shift != glm::dvec2(0.0) || view.pixel_aspect != 1.0;
}

void check_sequence(const Request& request) {
  const Request::Output& output = request.output;
  if (!output.frames.empty() && !output.many())
    fail("found --frames alone, expected --camera-path or --turntable beside it");
  if (output.turntable > 0 && !output.camera_path.empty())
    fail("found --turntable and --camera-path, expected one of them");
  if (!output.camera_path.empty() && has_camera(request.view))
    fail("found a camera beside --camera-path, expected only the path");
  if (output.many() && !output.reference.empty())
    fail("found --reference with a sequence of pictures, expected a single one");
  if (output.many() && !output.path.empty()) (void)frame_file(output.path, 0);
}

void check_camera(const Request::View& view) {
  if (view.target && !view.eye) fail("found --target without --eye, expected both");
  if (view.ortho_height > 0.0 && !view.eye) fail("found --ortho-height without --eye, expected both");
  if (view.camera_up && !view.eye) fail("found --camera-up without --eye, expected both");
}

void check_sheet(const Request& request) {
  const Request::View& view = request.view;
  if (!view.sheet) {
    if (view.ink || view.xray) fail("found --ink or --xray without --sheet, expected them with one");
    if (!request.output.measures.empty()) fail("found --measures without --sheet, expected it with one");
    if (!request.output.height_raster.empty())
      fail("found --height-raster without --sheet, expected it with one");
    return;
  }
  if (view.made_sheet) return;
  const Request::View unset;
  if (has_camera(view) || view.ortho_height > 0.0)
    fail("found a camera beside --sheet, expected only the sheet, which has one");
  if (view.width != unset.width || view.height != unset.height)
    fail("found --resolution beside --sheet, expected scale= and dpi= in the sheet, which make its size");
  if (request.output.many()) fail("found --sheet with a sequence of pictures, expected a single one");
  const std::string extension = lower_extension(request.output.path);
  if (!request.output.measures.empty() && extension != ".svg" && extension != ".pdf")
    fail("found --measures with an output other than .svg or .pdf, expected one of these");
  if (view.ink && view.xray) fail("found --ink and --xray, expected one of them");
}

void check_orbit(const Request& request) {
  const Request::Output& output = request.output;
  if (output.orbit_columns == 0) return;
  if (!output.path.empty() && lower_extension(output.path) != ".html")
    fail("found --orbit with output '" + output.path.string() + "', expected a name ending in .html");
  if (request.view.sheet || output.many() || request.view.window().width > 0 || !output.resume.empty() ||
      !output.reference.empty() || request.view.lens_shift != glm::dvec2(0.0) ||
      request.view.pixel_aspect != 1.0)
    fail(
        "found --orbit with --sheet, a sequence, a part of a picture, --resume, --reference, --lens-shift or "
        "--pixel-aspect, expected none of these");
}

void check_noise(const Request& request) {
  const Request::Output& output = request.output;
  const bool one_sample = !request.settings.has_goal() && request.settings.samples < 2;
  if (needs_noise(output.aovs) && one_sample)
    fail("found --aov error with one sample, expected at least two");
  if (!output.denoise && !output.despeckle) return;
  const std::string option = output.denoise ? "--denoise" : "--despeckle";
  if (output.denoise && output.despeckle) fail("found --denoise and --despeckle, expected one of them");
  if (output.keep_noise) fail("found " + option + " and --keep-noise, expected one of them");
  if (one_sample) fail("found " + option + " with one sample, expected at least two");
  if (request.look.style == LOOK_PAPER)
    fail("found " + option + " with --look paper, expected a look that has noise");
  if (!output.reference.empty())
    fail("found " + option + " with --reference, expected pictures compared as they were traced");
}

/// What the format of the picture's file cannot hold.
void check_format(const Request& request) {
  const std::filesystem::path& path = request.output.path;
  const std::string of = " with a " + lower_extension(path) + " output, expected ";
  if (is_jpeg(path) && request.settings.transparent)
    fail("found --background transparent" + of + ".png, .webp or .exr, which hold how much is covered");
  const PixelWindow made = request.view.made();
  if (const std::uint32_t most = most_side(path); std::max(made.width, made.height) > most)
    fail("found a picture of " + std::to_string(made.width) + "x" + std::to_string(made.height) + " pixels" +
         of + "at most " + std::to_string(most) + " a side, or another format");
  if (request.view.sheet && (is_jpeg(path) || is_webp(path)))
    fail("found --sheet" + of + ".png, .exr, .tif, .svg or .pdf, which say where their pixels lie");
}

}  // namespace

PixelWindow Request::View::window() const {
  if (tiles == 0) return crop;
  const auto row = [this](std::uint32_t part) {
    return static_cast<std::uint32_t>(std::uint64_t{height} * part / tiles);
  };
  return {0, row(tile - 1), width, row(tile) - row(tile - 1)};
}

void set_camera(Request::View& view, const Camera& camera) {
  view.eye = camera.eye;
  view.target = camera.target;
  view.camera_up = camera.up;
  view.fov_y_deg.reset();
  if (camera.ortho_height == 0.0) view.fov_y_deg = camera.fov_y_deg;
  view.ortho_height = camera.ortho_height;
  view.lens_shift = camera.lens_shift;
  view.pixel_aspect = camera.pixel_aspect;
}

Region region_of(const RegionRequest& asked, const glm::dvec3& up) {
  Region region;
  region.kept = asked.cuts;
  region.kept.insert(region.kept.end(), asked.of_sheet.begin(), asked.of_sheet.end());
  region.cuts_light = asked.light_kept.value_or(false);
  if (asked.keep_box)
    for (const HalfSpace& half : half_spaces(*asked.keep_box, up)) region.kept.push_back(half);
  if (asked.drop_box)
    for (const HalfSpace& half : half_spaces(*asked.drop_box, up)) region.dropped.push_back(half);
  return region;
}

void forget_sheet(Request::View& view) {
  if (!view.made_sheet) return;
  const Request::View unset;
  view.made_sheet.reset();
  view.region.of_sheet.clear();
  view.eye = view.target = view.camera_up = std::nullopt;
  view.fov_y_deg.reset();
  view.ortho_height = 0.0;
  view.width = unset.width;
  view.height = unset.height;
}

bool is_scene_file(const std::filesystem::path& path) { return lower_extension(path) == ".soct"; }

void require_scene_alone(const std::vector<std::filesystem::path>& inputs) {
  if (inputs.size() > 1 && std::any_of(inputs.begin(), inputs.end(), is_scene_file))
    fail("found a .soct beside other inputs, expected it alone");
}

void require_inputs(const Request::Source& source) {
  if (source.inputs.empty())
    fail("found no SCENE, expected a scene or model file (--help shows all options)");
  require_scene_alone(source.inputs);
}

void require_consistent(const Request& request) {
  const Request::Output& output = request.output;
  const std::string extension = lower_extension(output.path);
  const bool orbit = output.orbit_columns > 0;
  const bool on_sheet =
      request.view.sheet && (extension == ".tif" || extension == ".svg" || extension == ".pdf");
  if (!output.path.empty() && !is_picture_format(output.path) && !on_sheet &&
      !(orbit && extension == ".html"))
    fail("found output '" + output.path.string() + "', expected a name ending in " +
         (request.view.sheet ? ".png, .exr, .tif, .svg or .pdf" : PICTURE_NAMES));
  check_format(request);
  const bool aov = !request.view.sheet && request.settings.aov;
  if ((aov || output.aovs != 0) && !output.path.empty() && extension != ".exr")
    fail("found --aov with a " + extension + " output, expected .exr");
  check_camera(request.view);
  check_sheet(request);
  check_orbit(request);
  check_noise(request);
  check_sequence(request);
  check_resume(request);
  check_part(request);
}

std::vector<std::filesystem::path> model_folders(const Request::Source& source) {
  std::vector<std::filesystem::path> folders = source.data_paths;
  if (const char* folder = std::getenv("SPLATRAY_DATA_DIR")) folders.emplace_back(folder);
  return folders;
}

ReadOptions read_options(const Request::Source& source, const Progress& progress) {
  ReadOptions reading;
  reading.samples = source.params.samples;
  reading.seed = source.params.seed;
  reading.data_paths = model_folders(source);
  reading.threads = source.threads;
  reading.clip = source.params.clip;
  reading.crease_degrees = source.params.crease_degrees;
  reading.scans = source.scans;
  reading.progress = progress;
  return reading;
}

}  // namespace splatray
