#include "app/library/shot/level_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace splatray {
namespace {

struct Box {
  glm::dvec3 low{0.0}, high{0.0};
};

Box box_of(const Levels& levels, const LevelNode& node, double z_scale) {
  const double edge = std::ldexp(levels.edge, -static_cast<int>(node.level));
  const glm::dvec3 low = levels.low + edge * glm::dvec3(node.cell), scale(1.0, 1.0, z_scale);
  return {low * scale, (low + edge) * scale};
}

/// The pixels of a picture as seen from a box.
class PixelsOfView {
 public:
  explicit PixelsOfView(const View& view)
      : plane_(image_plane(RootTransform{}, view)),
        is_ortho_(view.camera.ortho_height > 0.0),
        sees_all_(view.camera.panorama) {
    const PixelWindow made = view.made();
    const glm::dvec3 corner = plane_.corner + double(made.x) * plane_.dx + double(made.y) * plane_.dy;
    const glm::dvec3 across = double(made.width) * plane_.dx, down = double(made.height) * plane_.dy;
    const std::array<glm::dvec3, 4> corners = {corner, corner + across, corner + across + down,
                                               corner + down};
    const glm::dvec3 middle = corner + 0.5 * (across + down);
    for (std::size_t i = 0; i < 4; ++i) {
      const glm::dvec3 &a = corners[i], &b = corners[(i + 1) % 4];
      Side& side = sides_[i];
      side.at = is_ortho_ ? plane_.eye + a : plane_.eye;
      side.inwards =
          is_ortho_ ? glm::cross(plane_.forward, b - a) : glm::cross(plane_.forward + a, plane_.forward + b);
      const glm::dvec3 within = is_ortho_ ? middle - a : plane_.forward + middle;
      if (glm::dot(side.inwards, within) < 0.0) side.inwards = -side.inwards;
    }
  }

  [[nodiscard]] bool sees(const Box& box) const {
    return sees_all_ || std::all_of(sides_.begin(), sides_.end(), [&](const Side& side) {
             const glm::dvec3 furthest =
                 glm::mix(box.low, box.high, glm::greaterThan(side.inwards, glm::dvec3(0.0)));
             return glm::dot(side.inwards, furthest - side.at) >= 0.0;
           });
  }

  /// The edge of a pixel, world units, at the box's nearest point; 0 around the eye.
  [[nodiscard]] double pixel_at(const Box& box) const {
    const double pixel = std::sqrt(glm::length(plane_.dx) * glm::length(plane_.dy));
    return is_ortho_ ? pixel : pixel * glm::distance(plane_.eye, glm::clamp(plane_.eye, box.low, box.high));
  }

 private:
  struct Side {
    glm::dvec3 at{0.0}, inwards{0.0};
  };
  ImagePlane plane_;
  bool is_ortho_, sees_all_;
  std::array<Side, 4> sides_;
};

/// A node that the spacing asks for.
struct Wanted {
  std::uint32_t file = 0, node = 0;
  /// The points' that the picture has there without it, or that of the nodes above it where these are nearer to each other.
  double spacing_px = 0.0;
};

class Chooser {
 public:
  Chooser(const LevelCut& cut, std::vector<Wanted>& wanted) : cut_(cut), wanted_(wanted) {
    for (const View& view : cut.views) views_.emplace_back(view);
  }

  void add(const Levels& levels, std::uint32_t file) {
    const std::vector<LevelNode>& nodes = levels.nodes;
    std::vector<double> children(nodes.size()), points_above(nodes.size()), spacing_px(nodes.size());
    for (const LevelNode& node : nodes)
      if (node.parent != LevelNode::NO_PARENT) children[node.parent] += 1.0;
    for (std::uint32_t i = 0; i < nodes.size(); ++i) {
      double parents = std::numeric_limits<double>::infinity();
      if (const std::uint32_t parent = nodes[i].parent; parent != LevelNode::NO_PARENT) {
        parents = spacing_px[parent];
        if (!(parents > cut_.spacing_px)) continue;
        points_above[i] =
            (points_above[parent] + static_cast<double>(nodes[parent].points)) / children[parent];
      }
      spacing_px[i] = std::min(parents, spacing_above(levels, nodes[i], points_above[i]));
      if (spacing_px[i] > cut_.spacing_px) wanted_.push_back({file, i, spacing_px[i]});
    }
  }

 private:
  /// The spacing of so many points that lie about in a square of the node's edge.
  [[nodiscard]] double spacing_above(const Levels& levels, const LevelNode& node, double points) const {
    const Box box = box_of(levels, node, cut_.z_scale);
    if (std::isinf(cut_.unseen_factor) &&
        std::none_of(views_.begin(), views_.end(), [&](const PixelsOfView& view) { return view.sees(box); }))
      return 0.0;
    const double spacing_world = (box.high.x - box.low.x) / std::sqrt(points);
    double widest_px = 0.0;
    for (const PixelsOfView& view : views_)
      widest_px = std::max(widest_px,
                           spacing_world / view.pixel_at(box) / (view.sees(box) ? 1.0 : cut_.unseen_factor));
    return widest_px;
  }

  const LevelCut& cut_;
  std::vector<Wanted>& wanted_;
  std::vector<PixelsOfView> views_;
};

}  // namespace

CutLevels cut_levels(const std::vector<Levels>& files, const LevelCut& cut) {
  std::vector<Wanted> wanted;
  Chooser chooser(cut, wanted);
  for (std::uint32_t file = 0; file < files.size(); ++file) chooser.add(files[file], file);
  // Parents stay before their children, which do not have a wider spacing.
  std::stable_sort(wanted.begin(), wanted.end(),
                   [](const Wanted& a, const Wanted& b) { return a.spacing_px > b.spacing_px; });
  CutLevels chosen{std::vector<std::vector<std::uint32_t>>(files.size()), cut.spacing_px};
  std::vector<LoadCount> loaded(files.begin(), files.end());
  std::uint64_t points = 0;
  for (const Wanted& one : wanted) {
    LoadCount& of_file = loaded[one.file];
    points -= of_file.sum();
    of_file.add(one.node);
    points += of_file.sum();
    if (points <= cut.most_points || std::isinf(one.spacing_px)) continue;
    chosen.spacing_px = one.spacing_px;
    break;
  }
  for (const Wanted& one : wanted)
    if (one.spacing_px > chosen.spacing_px) chosen.nodes[one.file].push_back(one.node);
  for (std::vector<std::uint32_t>& nodes : chosen.nodes) std::sort(nodes.begin(), nodes.end());
  return chosen;
}

}  // namespace splatray
