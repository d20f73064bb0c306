#include "app/view/thread/point_picture.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "app/view/display/eye_dome.h"

namespace splatray {
namespace {

constexpr int MOST_PX = 9;  ///< edge of a square

/// A pixel's nearest point: its depth's bits, which grow with it, above its number.
using Nearest = std::uint64_t;
constexpr Nearest NOTHING = std::numeric_limits<Nearest>::max();

/// From places to pixels, float32 about the points' origin.
struct Projection {
  glm::vec3 eye, forward, right, down;  ///< the last two per pixel
  float right_0, down_0;                ///< pixel = dot - this
  float size_px;                        ///< of a square: at depth 1, or at all in orthographic pictures
  bool ortho;

  Projection(const PointCloud& points, const View& view, double size) {
    RootTransform about;
    about.origin_world = points.origin_world;
    const ImagePlane plane = image_plane(about, view);
    const glm::dvec3 x = plane.dx / glm::dot(plane.dx, plane.dx), y = plane.dy / glm::dot(plane.dy, plane.dy);
    eye = plane.eye;
    forward = plane.forward;
    right = x;
    down = y;
    right_0 = static_cast<float>(glm::dot(plane.corner, x));
    down_0 = static_cast<float>(glm::dot(plane.corner, y));
    size_px = static_cast<float>(size * points.spacing_world / glm::length(plane.dy));
    ortho = view.camera.ortho_height > 0.0;
  }
};

/// The point nearest to the eye in each pixel.
std::vector<Nearest> nearest_points(const PointCloud& points, const View& view, const PointStyle& style) {
  const Projection to(points, view, style.size);
  const int width = static_cast<int>(view.width), height = static_cast<int>(view.height);
  const float wide = static_cast<float>(width) + MOST_PX, high = static_cast<float>(height) + MOST_PX;
  const bool faces = style.cutaway && !points.normal.empty();
  std::vector<Nearest> nearest(std::size_t{view.width} * view.height, NOTHING);
  for (std::size_t i = 0; i < points.position.size(); ++i) {
    const glm::vec3 from_eye = points.position[i] - to.eye;
    const float depth = glm::dot(from_eye, to.forward);
    if (!(depth > 0.0F)) continue;
    if (faces && !(glm::dot(points.normal[i], to.ortho ? to.forward : from_eye) < 0.0F)) continue;
    const float scale = to.ortho ? 1.0F : 1.0F / depth;
    const float x = glm::dot(from_eye, to.right) * scale - to.right_0;
    const float y = glm::dot(from_eye, to.down) * scale - to.down_0;
    if (!(x > -MOST_PX && y > -MOST_PX && x < wide && y < high)) continue;
    const int edge = static_cast<int>(std::clamp(std::ceil(to.size_px * scale), 1.0F, float{MOST_PX}));
    const float half = 0.5F * static_cast<float>(edge - 1);
    const int x0 = static_cast<int>(std::floor(x - half)), y0 = static_cast<int>(std::floor(y - half));
    const Nearest key = Nearest{std::bit_cast<std::uint32_t>(depth)} << 32U | i;
    for (int row = std::max(y0, 0); row < std::min(y0 + edge, height); ++row)
      for (int column = std::max(x0, 0); column < std::min(x0 + edge, width); ++column) {
        Nearest& pixel =
            nearest[static_cast<std::size_t>(row) * view.width + static_cast<std::size_t>(column)];
        pixel = std::min(pixel, key);
      }
  }
  return nearest;
}

}  // namespace

PointPicture draw_points(const PointCloud& points, const View& view, const PointStyle& style) {
  const std::vector<Nearest> nearest = nearest_points(points, view, style);
  PointPicture picture;
  picture.depth_world.resize(nearest.size());
  for (std::size_t i = 0; i < nearest.size(); ++i)
    picture.depth_world[i] = nearest[i] == NOTHING
                                 ? std::numeric_limits<float>::infinity()
                                 : std::bit_cast<float>(static_cast<std::uint32_t>(nearest[i] >> 32U));
  const std::vector<float> shade = eye_dome(picture.depth_world, view, style.eye_dome);
  picture.rgba.resize(4 * nearest.size(), 255);
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    const std::uint32_t color = nearest[i] == NOTHING ? 0 : points.color[nearest[i] & 0xFFFFFFFFU];
    for (unsigned channel = 0; channel < 3; ++channel)
      picture.rgba[4 * i + channel] =
          nearest[i] == NOTHING
              ? style.background[static_cast<int>(channel)]
              : static_cast<std::uint8_t>(static_cast<float>(color >> (8 * channel) & 255U) * shade[i]);
  }
  return picture;
}

}  // namespace splatray
