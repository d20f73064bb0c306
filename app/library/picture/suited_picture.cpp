// What a picture of a scan is like where its options leave that open.
#include <algorithm>
#include <array>
#include <cmath>

#include "app/library/picture/scene_source.h"
#include "engine/base/rank.h"
#include "engine/image/scan_kind.h"

namespace splatray {
namespace {

constexpr std::size_t SAMPLED = 1U << 16;  ///< values that decide whether an attribute says something
constexpr double OUTSIDE = 0.02;           ///< of the values at each end
constexpr std::uint8_t FEW_STEPS = 10;     ///< of 255 in each channel: one colour
constexpr double FEW_SHARE = 0.02;         ///< of the range, between the quartiles: one value

/// The values that leave a share out at each end.
template <class Value>
std::array<Value, 2> middle_of(std::vector<Value>& values, double outside) {
  return {value_at(values, outside), value_at(values, 1.0 - outside)};
}

bool has_colors(const Scene& scene) {
  if (scene.color_pool.empty()) return false;
  const std::size_t stride = scene.color_pool.size() / SAMPLED + 1;
  for (unsigned channel = 0; channel < 3; ++channel) {
    std::vector<std::uint8_t> values;
    for (std::size_t i = 0; i < scene.color_pool.size(); i += stride)
      values.push_back(static_cast<std::uint8_t>(scene.color_pool[i] >> (8 * channel)));
    const auto [low, high] = middle_of(values, OUTSIDE);
    if (high - low > FEW_STEPS) return true;
  }
  return false;
}

bool has_intensity(const Scene& scene) {
  const Column* column = find_column(scene.columns, COLUMN_INTENSITY);
  if (column == nullptr || column->size() == 0) return false;
  std::vector<double> values;
  for (std::size_t i = 0; i < column->size(); i += column->size() / SAMPLED + 1)
    if (std::isfinite(column->number(i))) values.push_back(column->number(i));
  if (values.empty()) return false;
  const auto [low, high] = middle_of(values, OUTSIDE);
  const auto [first, last] = middle_of(values, 0.25);
  return high > low && last - first > FEW_SHARE * (high - low);
}

const char* suited_colors(const Scene& scene, SceneKind kind, bool inside) {
  if (has_colors(scene)) return "rgb";
  const bool land =
      kind == SceneKind::site || kind == SceneKind::sweep || (kind == SceneKind::room && !inside);
  if (has_intensity(scene)) return land ? "height+intensity" : "intensity";
  return land || kind == SceneKind::room ? "height" : "plain";
}

}  // namespace

SuitedPicture suited_picture(const Scene& scene, const Request& asked) {
  SuitedPicture suited{asked, {}};
  Request& request = suited.request;
  request.settings.cutaway = request.view.look_in || request.view.viewpoint == Viewpoint::dollhouse;
  const SceneKind kind = kind_of_scan(scene);
  if (kind == SceneKind::none) return suited;
  const auto note = [&suited](const std::string& option) { suited.choices += " " + option; };
  if (!request.view.eye && !request.view.sheet && request.view.viewpoint == Viewpoint::automatic) {
    request.view.viewpoint = choose_viewpoint(scene);
    // An orbit is from outside.
    if (request.output.orbit_columns > 0 && request.view.viewpoint == Viewpoint::inside)
      request.view.viewpoint = Viewpoint::dollhouse;
    request.settings.cutaway = request.view.look_in || request.view.viewpoint == Viewpoint::dollhouse;
    note(std::string("--view ") + viewpoint_name(request.view.viewpoint));
  }
  const bool inside = kind == SceneKind::room && request.view.viewpoint == Viewpoint::inside;
  if (request.look.attributes.color_by.empty()) {
    request.look.attributes.color_by = suited_colors(scene, kind, inside);
    note("--color-by " + request.look.attributes.color_by);
  }
  if (!request.look.style && choose_look(scene, request) == LOOK_SCAN) {
    // A section lies in the shade of what is above it: the sky's light shows it, too.
    const bool all_lit = request.look.attributes.color_by == "rgb" || inside || request.view.sheet;
    request.look.style = all_lit ? LOOK_SCAN : LOOK_LIT;
    note(*request.look.style == LOOK_LIT ? "--look lit" : "--look scan");
  }
  if (!suited.choices.empty()) suited.choices = std::string(scan_kind_name(kind)) + ":" + suited.choices;
  return suited;
}

bool suits_denoising(const Scene& scene, const Request& asked) {
  const bool decided = asked.look.style || asked.output.keep_noise || asked.output.despeckle ||
                       asked.settings.has_goal() || !asked.output.reference.empty();
  return !scene.stations.empty() && !decided && asked.view.window().width == 0 &&
         asked.settings.sample_offset == 0 && asked.settings.samples >= 2;
}

bool suits_exposure(const Scene& scene, const Request& asked) {
  return !asked.look.exposure_ev && (asked.look.exposure_auto || !scene.stations.empty());
}

}  // namespace splatray
