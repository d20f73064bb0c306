#include "tests/trace/reference_path.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <thread>

namespace splatray::testing {
namespace {

using glm::dvec2;
using glm::dvec3;
using std::numbers::pi;

/// 32-bit fixed point -> [0, 1), as both renderers define it (24 bits).
double fraction_of(std::uint32_t fixed) { return double(fixed >> 8) / 16777216.0; }

std::uint32_t mixed(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352dU;
  x = (x ^ (x >> 15)) * 0x846ca68bU;
  return x ^ (x >> 16);
}

double choice_of(std::uint32_t pixel, std::uint32_t sample, std::uint32_t bounce, std::uint32_t seed) {
  return fraction_of(mixed(pixel ^ mixed(bounce + 0x9e3779b9U * seed)) + sample * 2654435769U);
}

/// Reflectance for both polarisations by Fresnel's equations in the angles; 1 beyond the critical angle.
double reflectance(double ior_here, double ior_behind, double cosine) {
  const double angle = std::acos(std::clamp(cosine, 0.0, 1.0));
  const double sine_behind = ior_here / ior_behind * std::sin(angle);
  if (sine_behind >= 1.0) return 1.0;
  const double behind = std::asin(sine_behind);
  if (angle + behind < 1e-9) return std::pow((ior_here - ior_behind) / (ior_here + ior_behind), 2.0);
  const double across = std::sin(angle - behind) / std::sin(angle + behind);
  const double along = std::tan(angle - behind) / std::tan(angle + behind);
  return 0.5 * (across * across + along * along);
}

class Renderer {
 public:
  Renderer(const Scene& scene, const BruteForce& brute, const View& view, const Settings& settings,
           const Environment& environment, const dvec3& nudge)
      : scene_(scene), brute_(brute), settings_(settings), environment_(environment), nudge_(nudge) {
    const Camera& camera = view.camera;
    forward_ = glm::normalize(camera.target - camera.eye);
    right_ = glm::normalize(glm::cross(forward_, camera.up));
    up_ = glm::cross(right_, forward_);
    half_height_ = std::tan(camera.fov_y_deg * pi / 360.0);
    eye_root_ = scene.root.to_root(camera.eye);
    size_ = dvec2(view.width, view.height);
    lights_ = lights_in_root(scene, scene.lights);
    irradiance_ = irradiance_coefficients(environment);
    const FrameParams frame = make_frame_params(scene, view, settings);
    environment_up_ = frame.environment_up;
    environment_right_ = frame.environment_right;
  }

  [[nodiscard]] glm::vec4 pixel(std::uint32_t x, std::uint32_t y) const {
    dvec3 sum(0.0);
    double coverage = 0.0;
    for (std::uint32_t sample = 0; sample < settings_.samples; ++sample) {
      const dvec2 at(x + fraction_of(0x80000000U + sample * 3242174889U),
                     y + fraction_of(0x80000000U + sample * 2447445414U));
      bool covered = false;
      sum += radiance(primary(at), y * std::uint32_t(size_.x) + x, sample, covered);
      coverage += covered ? 1.0 : 0.0;
    }
    return {glm::vec3(sum / double(settings_.samples)), float(coverage / settings_.samples)};
  }

 private:
  [[nodiscard]] RayQuery primary(dvec2 at) const {
    const dvec2 ndc = (at / size_ * 2.0 - 1.0) * half_height_;
    RayQuery query{};
    query.origin = vec3(eye_root_);
    query.dir = vec3(glm::normalize(forward_ + right_ * (ndc.x * size_.x / size_.y) - up_ * ndc.y));
    query.from_object = NO_OBJECT;
    return query;
  }

  [[nodiscard]] dvec3 in_environment(const dvec3& dir) const {
    return {glm::dot(dir, environment_right_), glm::dot(dir, environment_up_),
            glm::dot(dir, glm::cross(environment_right_, environment_up_))};
  }

  [[nodiscard]] dvec3 texel(std::int64_t x, std::int64_t y) const {
    const std::int64_t width = environment_.width;
    const std::int64_t row = std::clamp<std::int64_t>(y, 0, environment_.height - 1);
    return environment_.texels[std::size_t(row * width + (x % width + width) % width)];
  }

  /// Bilinear.
  [[nodiscard]] dvec3 sky(const dvec3& dir_root) const {
    if (environment_.width == 0) return double(settings_.environment_strength) * dvec3(environment_.constant);
    const dvec3 dir = in_environment(dir_root);
    const double x = (std::atan2(dir.x, -dir.z) / (2.0 * pi) + 0.5) * environment_.width - 0.5;
    const double y = std::acos(std::clamp(dir.y, -1.0, 1.0)) / pi * environment_.height - 0.5;
    const double column = std::floor(x);
    const double row = std::floor(y);
    const dvec3 above = glm::mix(texel(std::int64_t(column), std::int64_t(row)),
                                 texel(std::int64_t(column) + 1, std::int64_t(row)), x - column);
    const dvec3 below = glm::mix(texel(std::int64_t(column), std::int64_t(row) + 1),
                                 texel(std::int64_t(column) + 1, std::int64_t(row) + 1), x - column);
    return double(settings_.environment_strength) * glm::mix(above, below, y - row);
  }

  [[nodiscard]] dvec3 sky_diffuse(const dvec3& normal_root) const {
    const dvec3 n = in_environment(normal_root);
    const std::array<double, 9> basis{
        1.0, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3 * n.z * n.z - 1, n.x * n.z, n.x * n.x - n.y * n.y};
    dvec3 sum(0.0);
    for (std::size_t i = 0; i < basis.size(); ++i) sum += basis[i] * dvec3(irradiance_[i]);
    return double(settings_.environment_strength) * glm::max(sum, dvec3(0.0));
  }

  [[nodiscard]] RayQuery leaving(const RayQuery& ray, const TrueHit& hit, const dvec3& dir,
                                 std::uint32_t inside) const {
    RayQuery query{};
    query.origin = vec3(dvec3(ray.origin) + hit.t * dvec3(ray.dir));
    query.dir = vec3(glm::normalize(dir + nudge_));
    query.inside = inside;
    query.from_normal = vec3(hit.front ? hit.normal : -hit.normal);
    query.from_object = hit.object;
    return query;
  }

  /// Glass objects tint, once each and squared (in and out); anything else blocks.
  [[nodiscard]] dvec3 light_through(const RayQuery& ray, double t_max) const {
    dvec3 light(1.0);
    std::vector<bool> passed(scene_.materials.size(), false);
    for (const std::uint32_t object : brute_.objects_met(ray, settings_, t_max)) {
      const Material& material = scene_.materials[object];
      if ((material.flags & MATERIAL_DIELECTRIC) == 0) return dvec3(0.0);
      if (!passed[object]) light *= dvec3(material.phong.tint) * dvec3(material.phong.tint);
      passed[object] = true;
    }
    return light;
  }

  [[nodiscard]] dvec3 local(const RayQuery& ray, const TrueHit& hit, const Material& material) const {
    const bool glass = (material.flags & MATERIAL_DIELECTRIC) != 0;
    const dvec3 diffuse = glass ? dvec3(0.0) : dvec3(material.phong.diffuse) * hit.color;
    dvec3 sum = diffuse * sky_diffuse(hit.normal);
    const dvec3 position = dvec3(ray.origin) + hit.t * dvec3(ray.dir);
    const dvec3 mirrored = glm::reflect(dvec3(ray.dir), hit.normal);
    for (const Light& light : lights_) {
      const bool point = light.kind == LIGHT_POINT;
      const dvec3 to_light = point ? dvec3(light.position) - position : dvec3(light.position);
      const double distance = point ? glm::length(to_light) : 1.0;
      const dvec3 dir = to_light / distance;
      const double cosine = glm::dot(hit.normal, dir);
      if (cosine <= 0.0) continue;
      dvec3 visible(1.0);
      if (settings_.shadows)
        visible = light_through(leaving(ray, hit, dir, ray.inside), point ? distance : INFINITY);
      const double lobe = std::pow(std::max(glm::dot(mirrored, dir), 0.0), double(material.phong.shininess)) *
                          (double(material.phong.shininess) + 2.0) / 2.0;
      sum += visible * dvec3(light.power) * (cosine / (distance * distance)) *
             (diffuse + double(material.phong.specular) * lobe) / pi;
    }
    return sum;
  }

  /// Index of refraction of what the ray is in: the dielectric with the highest of these bits, `own` if it is its.
  [[nodiscard]] double medium(std::uint32_t inside, const Material& own) const {
    if (inside >> own.mask_bit == 1U) return double(own.ior);
    double ior = 1.0;
    std::uint32_t highest = 0;
    for (const Material& material : scene_.materials) {
      const std::uint32_t bit = 1U << material.mask_bit;
      if ((material.flags & MATERIAL_DIELECTRIC) == 0 || (inside & bit) == 0 || bit < highest) continue;
      highest = bit;
      ior = double(material.ior);
    }
    return ior;
  }

  /// The branch followed at glass, and what it carries.
  [[nodiscard]] RayQuery through_glass(const RayQuery& ray, const TrueHit& hit, const Material& material,
                                       double choice, dvec3& throughput) const {
    const double outer = medium(ray.inside & ~(1U << material.mask_bit), material);
    const double inner = medium(ray.inside | 1U << material.mask_bit, material);
    const double here = hit.front ? outer : inner;
    const double behind = hit.front ? inner : outer;
    const dvec3 dir(ray.dir);
    const double cosine = std::clamp(-glm::dot(dir, hit.normal), 0.0, 1.0);
    if (choice < reflectance(here, behind, cosine))
      return leaving(ray, hit, glm::reflect(dir, hit.normal), ray.inside);
    throughput *= dvec3(material.phong.tint);
    return leaving(ray, hit, glm::refract(dir, hit.normal, here / behind),
                   ray.inside ^ (1U << material.mask_bit));
  }

  [[nodiscard]] dvec3 radiance(RayQuery ray, std::uint32_t pixel_number, std::uint32_t sample,
                               bool& covered) const {
    dvec3 throughput(1.0);
    dvec3 sum(0.0);
    for (std::uint32_t bounce = 0;; ++bounce) {
      const TrueHit hit = brute_.nearest(ray, settings_);
      if (!hit.found) return sum + throughput * sky(dvec3(ray.dir));
      covered = true;
      const Material& material = scene_.materials[hit.object];
      const bool glass = (material.flags & MATERIAL_DIELECTRIC) != 0;
      const double mirror = glass ? 0.0 : double(material.phong.mirror);
      sum += throughput * local(ray, hit, material) * (1.0 - mirror);
      if (glass) {
        const double choice = choice_of(pixel_number, sample, bounce, settings_.seed);
        ray = through_glass(ray, hit, material, choice, throughput);
      } else {
        throughput *= dvec3(material.phong.tint) * mirror;
        ray = leaving(ray, hit, glm::reflect(dvec3(ray.dir), hit.normal), ray.inside);
      }
      const double brightest = std::max({throughput.x, throughput.y, throughput.z});
      if (bounce >= settings_.max_bounces || brightest < 1.0 / 512.0) return sum;
    }
  }

  const Scene& scene_;
  const BruteForce& brute_;
  Settings settings_;
  const Environment& environment_;
  dvec3 nudge_;
  dvec3 forward_, right_, up_, eye_root_;
  dvec2 size_;
  double half_height_ = 0.0;
  std::vector<Light> lights_;
  std::array<glm::vec3, 9> irradiance_{};
  dvec3 environment_up_, environment_right_;
};

}  // namespace

Image reference_picture(const Scene& scene, const BruteForce& brute, const View& view,
                        const Settings& settings, const Environment& environment, const dvec3& nudge) {
  assert(view.camera.ortho_height == 0.0);
  const Renderer renderer(scene, brute, view, settings, environment, nudge);
  Image image{view.width, view.height, std::vector<vec4>(std::size_t(view.width) * view.height), {}};
  const std::uint32_t workers = std::max(1U, std::thread::hardware_concurrency());
  std::vector<std::jthread> threads;
  for (std::uint32_t worker = 0; worker < workers; ++worker) {
    threads.emplace_back([&, worker] {
      for (std::uint32_t y = worker; y < view.height; y += workers)
        for (std::uint32_t x = 0; x < view.width; ++x)
          image.rgba[std::size_t(y) * view.width + x] = renderer.pixel(x, y);
    });
  }
  threads.clear();
  return image;
}

}  // namespace splatray::testing
