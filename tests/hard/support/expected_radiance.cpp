#include "tests/hard/support/expected_radiance.h"

#include <cmath>
#include <limits>

namespace splatray::testing {
namespace {

using glm::dvec3;

constexpr double LEAST_SHARE = 1e-5;
constexpr std::size_t NO_BODY = std::numeric_limits<std::size_t>::max();

/// A path on its way.
struct Path {
  dvec3 origin;
  dvec3 dir;
  std::vector<bool> inside;    ///< beside the bodies
  std::size_t left = NO_BODY;  ///< the body whose boundary the path is on
  double share = 1.0;
};

class Walker {
 public:
  Walker(const std::vector<Body>& bodies, const std::function<dvec3(const dvec3&)>& environment)
      : bodies_(bodies), environment_(environment) {}

  [[nodiscard]] dvec3 radiance(const Path& path) const {
    if (path.share < LEAST_SHARE) return dvec3(0.0);
    const std::optional<Boundary> next = next_boundary(path);
    if (!next) return path.share * environment_(path.dir);
    Path mirrored = path;
    mirrored.origin = path.origin + next->t * path.dir;
    mirrored.left = next->body;
    Path passing = mirrored;
    passing.inside[next->body] = !path.inside[next->body];
    const double eta = ior_in(path.inside) / ior_in(passing.inside);
    if (eta == 1.0) return radiance(passing);
    const dvec3 normal = glm::dot(next->normal, path.dir) > 0.0 ? -next->normal : next->normal;
    const double cosine = -glm::dot(normal, path.dir);
    const double squared = 1.0 - eta * eta * (1.0 - cosine * cosine);
    mirrored.dir = glm::reflect(path.dir, normal);
    if (squared <= 0.0) return radiance(mirrored);
    const double behind = std::sqrt(squared);
    passing.dir = eta * path.dir + (eta * cosine - behind) * normal;
    const double along = (cosine - eta * behind) / (cosine + eta * behind);
    const double across = (eta * cosine - behind) / (eta * cosine + behind);
    const double reflectance = 0.5 * (along * along + across * across);
    mirrored.share *= reflectance;
    passing.share *= 1.0 - reflectance;
    return radiance(mirrored) + radiance(passing);
  }

 private:
  struct Boundary {
    std::size_t body;
    double t;
    dvec3 normal;
  };

  /// Convex bodies: from inside the next boundary is where the line leaves, from outside where it enters.
  [[nodiscard]] std::optional<Boundary> next_boundary(const Path& path) const {
    std::optional<Boundary> next;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const std::optional<Crossing> crossing = bodies_[i].cross(path.origin, path.dir);
      if (!crossing || (!path.inside[i] && (i == path.left || crossing->t_in <= 0.0))) continue;
      const double t = path.inside[i] ? crossing->t_out : crossing->t_in;
      if (!next || t < next->t) next = {i, t, path.inside[i] ? crossing->normal_out : crossing->normal_in};
    }
    return next;
  }

  [[nodiscard]] double ior_in(const std::vector<bool>& inside) const {
    double ior = 1.0;
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      if (inside[i]) ior = bodies_[i].ior;
    return ior;
  }

  const std::vector<Body>& bodies_;
  const std::function<dvec3(const dvec3&)>& environment_;
};

}  // namespace

Body sphere_body(const dvec3& center, double radius, double ior) {
  return {
      ior, [=](const dvec3& origin, const dvec3& dir) -> std::optional<Crossing> {
        const dvec3 to_origin = origin - center;
        const double along = glm::dot(to_origin, dir);
        const double left = along * along - glm::dot(to_origin, to_origin) + radius * radius;
        if (left <= 0.0) return std::nullopt;
        const double t_in = -along - std::sqrt(left);
        const double t_out = -along + std::sqrt(left);
        return Crossing{t_in, t_out, (to_origin + t_in * dir) / radius, (to_origin + t_out * dir) / radius};
      }};
}

Body convex_body(std::vector<HalfSpace> planes, double ior) {
  return {ior,
          [planes = std::move(planes)](const dvec3& origin, const dvec3& dir) -> std::optional<Crossing> {
            Crossing crossing{-INFINITY, INFINITY, dvec3(0.0), dvec3(0.0)};
            for (const HalfSpace& plane : planes) {
              const double cosine = glm::dot(plane.normal, dir);
              const double t = (plane.offset - glm::dot(plane.normal, origin)) / cosine;
              if (cosine < 0.0 && t > crossing.t_in) crossing.t_in = t, crossing.normal_in = plane.normal;
              if (cosine > 0.0 && t < crossing.t_out) crossing.t_out = t, crossing.normal_out = plane.normal;
            }
            if (crossing.t_in >= crossing.t_out) return std::nullopt;
            return crossing;
          }};
}

dvec3 expected_radiance(const std::vector<Body>& bodies, const dvec3& origin, const dvec3& dir,
                        const std::function<dvec3(const dvec3&)>& environment) {
  Path path{origin, dir, std::vector<bool>(bodies.size(), false)};
  return Walker(bodies, environment).radiance(path);
}

}  // namespace splatray::testing
