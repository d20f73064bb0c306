#include "app/view/thread/point_sampler.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "app/library/palette.h"
#include "app/library/shot/resolve.h"
#include "app/view/model/document_request.h"
#include "engine/base/rank.h"
#include "engine/base/srgb.h"
#include "engine/scene/scene_splat.h"
#include "preprocess/base/usable_position.h"
#include "preprocess/build.h"

namespace splatray {
namespace {

constexpr std::size_t FEW = std::size_t{1} << 14U;  ///< points of the scene that decides how all are seen
/// Points of a scene that a picture is made of in no time.
constexpr std::size_t FEW_HUNDRED_THOUSAND = 400'000;
constexpr double OUTSIDE = 0.02;             ///< of the heights at each end, beyond the colours' range
constexpr std::uint32_t PLAIN = 0xFFC8CDD2;  ///< of points without colours, display-encoded
constexpr double CELLS_OF_SPACING = 2.0;     ///< edge of a cell in which one normal stands for all

/// The display-encoded 8 bits of a linear channel.
std::uint8_t encoded(float linear) {
  static const std::vector<std::uint8_t> TABLE = [] {
    std::vector<std::uint8_t> table(4096);
    for (std::size_t i = 0; i < table.size(); ++i) {
      const float root = static_cast<float>(i) / 4095.0F;  // even steps of what is seen, about
      table[i] = static_cast<std::uint8_t>(std::lround(255.0F * linear_to_srgb(root * root)));
    }
    return table;
  }();
  return TABLE[static_cast<std::size_t>(4095.0F * std::sqrt(std::clamp(linear, 0.0F, 1.0F)))];
}

std::uint32_t packed(glm::u16vec3 color) {
  return 0xFF000000U | std::uint32_t{color.z} << 16U | std::uint32_t{color.y} << 8U | color.x;
}

std::uint32_t packed(glm::vec3 encoded_color) { return packed(glm::u16vec3(255.0F * encoded_color + 0.5F)); }

/// Drops every second value.
template <class Value>
void halve(std::vector<Value>& values) {
  for (std::size_t i = 0; 2 * i < values.size(); ++i) values[i] = values[2 * i];
  values.resize((values.size() + 1) / 2);
}

/// A colour by height for each place, from the 2nd to the 98th of 100 parts of them.
std::vector<std::uint32_t> height_colors(const std::vector<glm::dvec3>& position, const glm::dvec3& up) {
  std::vector<double> height(position.size());
  std::transform(position.begin(), position.end(), height.begin(),
                 [&](const glm::dvec3& p) { return glm::dot(p, up); });
  std::vector<double> some;
  for (std::size_t i = 0; i < height.size(); i += height.size() / FEW + 1) some.push_back(height[i]);
  const double low = value_at(some, OUTSIDE), high = value_at(some, 1.0 - OUTSIDE);
  std::array<std::uint32_t, 256> ramp{};
  for (std::size_t i = 0; i < ramp.size(); ++i) ramp[i] = packed(land_color(static_cast<float>(i) / 255.0F));
  std::vector<std::uint32_t> colors(height.size());
  for (std::size_t i = 0; i < height.size(); ++i) {
    const double share = high > low ? (height[i] - low) / (high - low) : 0.5;
    colors[i] = ramp[static_cast<std::size_t>(255.0 * std::clamp(share, 0.0, 1.0))];
  }
  return colors;
}

/// Distance to the next of points that are spread over their surface as a scene's splats are.
double spacing_of(const Scene& scene) {
  std::vector<double> radius;
  for_each_splat(
      scene, [&](std::size_t, const SceneSplat& splat) { radius.push_back(splat.radius_world()); },
      splat_count(scene) / FEW + 1);
  return value_at(radius, 0.5);
}

/// For each place the normal of a splat in its cell; zero where there is none.
std::vector<glm::vec3> normals_near(const std::vector<glm::dvec3>& position, const Scene& scene,
                                    double cell_world) {
  const auto cell = [&](const glm::dvec3& p) {
    const glm::i64vec3 at(glm::floor((p - scene.root.origin_world) / cell_world));
    return static_cast<std::uint64_t>(at.x) * 0x9E3779B97F4A7C15U ^
           static_cast<std::uint64_t>(at.y) * 0xC2B2AE3D27D4EB4FU ^
           static_cast<std::uint64_t>(at.z) * 0x165667B19E3779F9U;
  };
  std::unordered_map<std::uint64_t, glm::vec3> in_cell;
  for_each_splat(scene, [&](std::size_t, const SceneSplat& splat) {
    in_cell.emplace(cell(splat.center_world()), glm::vec3(splat.normal()));
  });
  std::vector<glm::vec3> normal(position.size(), glm::vec3(0.0F));
  tbb::parallel_for(std::size_t{0}, position.size(), [&](std::size_t i) {
    const auto found = in_cell.find(cell(position[i]));
    if (found != in_cell.end()) normal[i] = found->second;
  });
  return normal;
}

/// Leaves out what a region does not hold.
void keep_region(const Region& region, PointCloud& cloud) {
  if (region.empty()) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < cloud.position.size(); ++i) {
    if (!region.holds(cloud.origin_world + glm::dvec3(cloud.position[i]))) continue;
    cloud.position[kept] = cloud.position[i];
    cloud.color[kept] = cloud.color[i];
    if (!cloud.normal.empty()) cloud.normal[kept] = cloud.normal[i];
    ++kept;
  }
  cloud.position.resize(kept);
  cloud.color.resize(kept);
  if (!cloud.normal.empty()) cloud.normal.resize(kept);
}

}  // namespace

PointCloud points_of(const Scene& scene, const Document& document) {
  const std::size_t stride = splat_count(scene) / FEW_HUNDRED_THOUSAND + 1;
  const Region region = region_of(document.request.view.region, up_of(document));
  const std::string& color_by = document.request.look.attributes.color_by;
  const bool own = !scene.color_pool.empty() && (color_by.empty() || color_by == "rgb");
  PointCloud cloud;
  cloud.origin_world = 0.5 * (scene.bounds_min_world + scene.bounds_max_world);
  cloud.spacing_world = spacing_of(scene) * std::sqrt(static_cast<double>(stride));
  std::vector<glm::dvec3> position;
  const auto add = [&](std::size_t i, const SceneSplat& splat) {
    position.push_back(splat.center_world());
    cloud.normal.emplace_back(splat.normal());
    const glm::vec3 linear = own ? unpack_color(scene.color_pool[i]) : glm::vec3(0.0F);
    cloud.color.push_back(own ? packed(glm::u16vec3(encoded(linear.x), encoded(linear.y), encoded(linear.z)))
                              : PLAIN);
  };
  for_each_splat(scene, add, stride);
  if (color_by.starts_with("height")) cloud.color = height_colors(position, up_of(document));
  for (const glm::dvec3& place : position) cloud.position.emplace_back(place - cloud.origin_world);
  keep_region(region, cloud);
  return cloud;
}

void PointSampler::add(const SeenPoints& seen) {
  const Points& points = seen.points;
  if (seen.first == 0) {
    first_station_ = kept_.stations.size();
    measured_ = measured_ && seen.measured;
    if (seen.measured) up_ = up_.value_or(seen.up);
  }
  kept_.stations.resize(first_station_);
  kept_.stations.insert(kept_.stations.end(), points.stations.begin(), points.stations.end());
  if (points.stations.empty()) kept_.stations.emplace_back();
  for (std::size_t i = seen.first; i < points.size(); ++i) {
    if (!is_usable_position(points.position[i]) || passed_++ % stride_ != 0) continue;
    keep(points, i);
    if (size() == MOST) thin_out();
  }
}

/// Arrays that are not yet as long as the positions do not know of the point; it is of the newest station then.
void PointSampler::keep(const Points& points, std::size_t i) {
  kept_.position.push_back(points.position[i]);
  kept_.position.back().z *= asked_.source.scans.z_scale;
  const std::size_t newest = kept_.stations.size() - 1;
  const std::size_t station = i < points.station.size() ? first_station_ + points.station[i] : newest;
  kept_.station.push_back(static_cast<std::uint16_t>(std::min<std::size_t>({station, newest, 0xFFFF})));
  kept_.normal.push_back(i < points.normal.size() ? points.normal[i] : glm::vec3(0.0F));
  std::uint8_t colored = 0;
  glm::u16vec3 color(0);
  if (i < points.stored_color.size()) {
    color = points.stored_color[i];
    colored = points.stored_color_most == 0 ? 2 : 1;
    if (colored == 1) color = glm::u16vec3(glm::uvec3(color) * 255U / unsigned{points.stored_color_most});
    if (colored == 2) largest_ = std::max({largest_, color.x, color.y, color.z});
  } else if (i < points.color.size()) {
    const glm::vec3& linear = points.color[i];
    color = {encoded(linear.x), encoded(linear.y), encoded(linear.z)};
    colored = 1;
  }
  stored_.push_back(color);
  colored_.push_back(colored);
}

void PointSampler::thin_out() {
  halve(kept_.position);
  halve(kept_.station);
  halve(kept_.normal);
  halve(stored_);
  halve(colored_);
  stride_ *= 2;
}

bool PointSampler::is_small() const { return size() <= FEW; }

bool PointSampler::has_colors() const {
  return std::any_of(colored_.begin(), colored_.end(),
                     [&](std::uint8_t kind) { return kind == 1 || (kind == 2 && largest_ > 0); });
}

std::vector<std::uint32_t> PointSampler::own_colors() const {
  std::vector<std::uint32_t> colors(size());
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const bool wide = colored_[i] == 2 && largest_ > 255;
    const bool has = colored_[i] == 1 || (colored_[i] == 2 && largest_ > 0);
    colors[i] = has ? packed(wide ? glm::u16vec3(stored_[i] >> std::uint16_t{8}) : stored_[i]) : PLAIN;
  }
  return colors;
}

/// Built as the scene will be, of every n-th point.
Scene PointSampler::small_scene() const {
  Input input;
  InputObject object;
  object.measured = measured_;
  const std::vector<std::uint32_t> colors = own_colors();
  const bool colored = has_colors();
  const bool normals = std::any_of(kept_.normal.begin(), kept_.normal.end(),
                                   [](const glm::vec3& n) { return n != glm::vec3(0.0F); });
  Points& points = object.points;
  points.stations = kept_.stations;
  for (std::size_t i = 0; i < size(); i += size() / FEW + 1) {
    points.position.push_back(kept_.position[i]);
    points.station.push_back(kept_.station[i]);
    if (normals) points.normal.push_back(kept_.normal[i]);
    if (colored) points.color.push_back(unpack_color(colors[i]));
  }
  if (!measured_) points.stations.clear(), points.station.clear();
  input.objects.push_back(std::move(object));
  input.up = up_;
  BuildParams params = asked_.source.params;
  params.normal_fields = params.clip = params.ground = false;
  params.smooth_world = 0.0;
  BuildStats stats;
  Scene scene = build_scene(std::move(input), params, asked_.source.threads, stats);
  scene.up = resolve_up(scene, asked_).up;
  return scene;
}

OpenedPoints PointSampler::make() const {
  const Scene scene = small_scene();
  Request asked = asked_;
  asked.look.material.clear();
  asked.look.objects.clear();
  OpenedPoints opened{nullptr, {}};
  // What the whole scene has and a few points may lack must not be refused.
  const std::string color_by = std::exchange(asked.look.attributes, {}).color_by;
  const SceneFacts facts = facts_of(scene);
  opened.document = first_document(scene, facts, asked);
  const std::string shown = color_by.empty() ? resolve_attributes(asked, facts).color_by : color_by;
  PointCloud cloud;
  cloud.origin_world = 0.5 * (scene.bounds_min_world + scene.bounds_max_world);
  cloud.spacing_world =
      spacing_of(scene) * std::sqrt(double(splat_count(scene)) / double(std::max<std::size_t>(size(), 1)));
  const bool as_stored = has_colors() && (shown.empty() || shown == "rgb" || shown == "plain");
  cloud.color = as_stored || !measured_ ? own_colors() : height_colors(kept_.position, scene.up);
  cloud.position.reserve(size());
  for (const glm::dvec3& position : kept_.position)
    cloud.position.emplace_back(position - cloud.origin_world);
  if (opened.document.request.view.look_in)
    cloud.normal = normals_near(kept_.position, scene, CELLS_OF_SPACING * spacing_of(scene));
  keep_region(region_of(asked_.view.region, scene.up), cloud);
  opened.document.materials = {};
  opened.points = std::make_shared<const PointCloud>(std::move(cloud));
  return opened;
}

}  // namespace splatray
