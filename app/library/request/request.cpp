#include "app/library/request/request.h"

#include <algorithm>
#include <cstdlib>

#include "engine/base/error.h"
#include "preprocess/base/file_extension.h"

namespace splatray {
namespace {

[[noreturn]] void fail(const std::string& sentence) { throw Error(ExitCode::usage, sentence); }

}  // namespace

glm::uvec2 picture_size(const Request::View& view) {
  if (!view.panorama) return {view.width, view.height};
  const std::uint32_t height = std::max(1U, std::min(view.width / 2, view.height));
  return {2 * height, height};
}

PixelWindow window_of(const Request::View& view, std::uint32_t width, std::uint32_t height) {
  if (view.tiles == 0) return view.crop;
  const auto row = [&](std::uint32_t part) {
    return static_cast<std::uint32_t>(std::uint64_t{height} * part / view.tiles);
  };
  return {0, row(view.tile - 1), width, row(view.tile) - row(view.tile - 1)};
}

PixelWindow made_pixels(const Request::View& view) {
  const glm::uvec2 size = picture_size(view);
  return View{{}, size.x, size.y, window_of(view, size.x, size.y)}.made();
}

bool asks_for_materials(const Request::Look& look) {
  return !look.material.empty() || std::any_of(look.objects.begin(), look.objects.end(), changes_look);
}

void set_camera(Request::View& view, const Camera& camera) {
  view.eye = camera.eye;
  view.target = camera.target;
  view.camera_up = camera.up;
  view.panorama = camera.panorama;
  const Camera lens = camera.panorama ? Camera{} : camera;
  view.fov_y_deg.reset();
  if (!camera.panorama && lens.ortho_height == 0.0) view.fov_y_deg = lens.fov_y_deg;
  view.ortho_height = lens.ortho_height;
  view.lens_shift = lens.lens_shift;
  view.pixel_aspect = lens.pixel_aspect;
}

Region region_of(const RegionRequest& asked, const glm::dvec3& up) {
  Region region;
  region.kept = asked.cuts;
  region.cuts_light = asked.light_kept.value_or(false);
  if (asked.keep_box)
    for (const HalfSpace& half : half_spaces(*asked.keep_box, up)) region.kept.push_back(half);
  if (asked.drop_box)
    for (const HalfSpace& half : half_spaces(*asked.drop_box, up)) region.dropped.push_back(half);
  return region;
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
