#include "app/library/picture/series/orbit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/library/codec/orbit_page.h"
#include "app/library/image_file.h"
#include "app/library/picture/picture_file.h"
#include "engine/base/crs.h"
#include "engine/base/error.h"
#include "engine/base/interrupt.h"
#include "engine/base/utf8.h"
#include "engine/file/atomic_file.h"

namespace splatray {
namespace {

/// Pixels of a square that has one depth; odd, so that its middle is a pixel's.
constexpr std::uint32_t DEPTH_STEP = 3;

/// The distances of an image, a square of pixels each.
std::vector<float> depths_of(const Image& image) {
  std::vector<float> depths;
  for (std::uint32_t y = DEPTH_STEP / 2; y + DEPTH_STEP / 2 < image.height; y += DEPTH_STEP)
    for (std::uint32_t x = DEPTH_STEP / 2; x + DEPTH_STEP / 2 < image.width; x += DEPTH_STEP)
      depths.push_back(image.aov[std::size_t{y} * image.width + x].z);
  return depths;
}

std::vector<unsigned char> depth_png(const std::vector<float>& depths, const OrbitPage& page) {
  DisplayImage steps{page.width / DEPTH_STEP, page.height / DEPTH_STEP, {}};
  for (const float depth : depths) {
    std::uint32_t step = 0;
    if (std::isfinite(depth)) {
      const double share = (static_cast<double>(depth) - page.near) / (page.far - page.near);
      step = static_cast<std::uint32_t>(std::lround(std::clamp(share, 0.0, 1.0) * (DEPTH_STEPS - 1))) + 1;
    }
    steps.rgb.emplace_back(static_cast<float>(step / 256) / 255.0F, static_cast<float>(step % 256) / 255.0F,
                           0.0F);
  }
  return encode_png(steps, {});
}

/// Some way around a picture's depths, so that both ends are within.
void set_range(const std::vector<std::vector<float>>& depths, OrbitPage& page) {
  double near = std::numeric_limits<double>::infinity(), far = 0.0;
  for (const std::vector<float>& picture : depths)
    for (const float depth : picture)
      if (std::isfinite(depth)) {
        near = std::min(near, static_cast<double>(depth));
        far = std::max(far, static_cast<double>(depth));
      }
  if (!(near < far)) return;
  page.near = near;
  page.far = far;
}

std::string title_of(const Request& request) {
  if (!request.output.title.empty() || request.source.inputs.empty()) return request.output.title;
  return path_text(request.source.inputs.front().stem());
}

}  // namespace

SequenceRecord make_orbit(const Shot& shot, SceneOnDevice& shown, const SequenceListener& listener) {
  const auto& orbit = std::get<Orbit>(shot.output);
  const std::filesystem::path& path = shot.request.output.path;
  const Crs crs = describe_crs(shown.scene().crs);
  OrbitPage page;
  page.title = title_of(shot.request);
  page.width = shot.view.width;
  page.height = shot.view.height;
  page.depth_step = DEPTH_STEP;
  page.unit_metres = different_units(crs).empty() ? crs.horizontal_metres : 0.0;
  page.columns = orbit.columns;
  SequenceRecord record;
  std::vector<std::vector<float>> depths;
  const std::vector<Camera> cameras = all_cameras(shot, shown.scene());
  for (const Camera& camera : cameras) {
    stop_if_interrupted();
    constexpr int QUALITY = 88;  // of JPEGs, of which a page has many
    const SequenceFrame frame{static_cast<std::uint32_t>(depths.size()), path};
    MadePicture made = make_picture(
        shot, shown, camera,
        [&](double share) { return listener.progress(frame, depths.size(), share) && !interrupted(); },
        Stopped::dropped);
    if (depths.empty())
      for (const std::string& note : made.notes) listener.note("note: " + note);
    page.pictures.push_back({camera, encode_jpeg(shown_image(shot, made.image), {}, QUALITY), {}});
    depths.push_back(depths_of(made.image));
    record.made.push_back({frame, made.lights, made.stats, 0.0, made.denoise_ms});
    record.last = std::move(made.image);
  }
  set_range(depths, page);
  for (std::size_t i = 0; i < depths.size(); ++i) page.pictures[i].depth_png = depth_png(depths[i], page);
  write_text_file(orbit_html(page), path);
  return record;
}

}  // namespace splatray
