#include "app/view/model/region_edit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/view/model/navigation.h"
#include "engine/scene/splat.h"

namespace splatray {
namespace {

constexpr double HANDLES_APART = 0.1;     ///< of planes, of the scene's radius
constexpr double MARGIN = 0.02;           ///< of box_of_all, of the scene's size
constexpr double LEAST_EDGE = 1e-3;       ///< of a box that is dragged, of the scene's radius
constexpr double THICKNESS = 0.05;        ///< of a first slice, of the scene's size across it
constexpr double NOTCH = 0.01;            ///< of the scene's radius
constexpr double OPPOSITE = -1.0 + 1e-9;  ///< cosine of the normals of a slice

glm::dvec3 middle_of(const Document& document) {
  return 0.5 * (document.bounds_min_world + document.bounds_max_world);
}

void add_box(const std::optional<TurnedBox>& box, GripOf of, const Document& document,
             std::vector<Grip>& handles) {
  if (!box) return;
  std::size_t number = 0;
  for (const HalfSpace& half : half_spaces(*box, up_of(document)))
    handles.push_back({of, number++, half.point, -glm::normalize(half.normal)});
}

/// How far along a handle's normal lies what is nearest to the ray under a place in the picture, from the handle's place.
double travel(const Document& document, const Grip& handle, glm::dvec2 px, glm::dvec2 size_px) {
  const glm::dvec3 under = point_under(document.camera, px, size_px);
  const bool ortho = document.camera.ortho_height > 0.0;
  const glm::dvec3 dir =
      glm::normalize(ortho ? document.camera.target - document.camera.eye : under - document.camera.eye);
  const glm::dvec3 origin = ortho ? under : document.camera.eye;
  const double along = glm::dot(handle.normal, dir), across = 1.0 - along * along;
  const glm::dvec3 between = handle.place_world - origin;
  if (across < 1e-6) return 0.0;  // looked at from its end
  return (along * glm::dot(dir, between) - glm::dot(handle.normal, between)) / across;
}

void move_face(TurnedBox& box, std::size_t number, double distance, double least, const glm::dvec3& up) {
  const auto axis = static_cast<glm::length_t>(number / 2);
  const bool high = number % 2 == 1;
  const std::array<glm::dvec3, 8> before = corners_of(box, up);
  if (high)
    box.high[axis] = std::max(box.high[axis] + distance, box.low[axis] + least);
  else
    box.low[axis] = std::min(box.low[axis] - distance, box.high[axis] - least);
  // A turned box turns about its middle, which has moved: the face across stays.
  const std::size_t fixed = high ? 0 : 7;
  const glm::dvec3 shift = before[fixed] - corners_of(box, up)[fixed];
  box.low += shift;
  box.high += shift;
}

}  // namespace

std::vector<Grip> handles_of(const Document& document) {
  std::vector<Grip> handles;
  add_box(document.request.view.region.keep_box, GripOf::keep_box, document, handles);
  add_box(document.request.view.region.drop_box, GripOf::drop_box, document, handles);
  const double apart = HANDLES_APART * scene_radius_world(document);
  for (std::size_t i = 0; i < document.request.view.region.cuts.size(); ++i) {
    const HalfSpace& cut = document.request.view.region.cuts[i];
    const glm::dvec3 normal = glm::normalize(cut.normal);
    // Side by side: those of a thin slice are not one above the other.
    const glm::dvec3 middle = middle_of(document) + static_cast<double>(i) * apart * TangentFrame(normal).u;
    handles.push_back({GripOf::cut, i, middle + glm::dot(cut.point - middle, normal) * normal, normal});
  }
  return handles;
}

std::optional<Grip> handle_at(const Document& document, glm::dvec2 position_px, glm::dvec2 size_px,
                              double near_px) {
  std::optional<Grip> nearest;
  for (const Grip& handle : handles_of(document)) {
    const auto place = place_in_picture(document.camera, handle.place_world, size_px);
    if (!place || glm::distance(*place, position_px) > near_px) continue;
    near_px = glm::distance(*place, position_px);
    nearest = handle;
  }
  return nearest;
}

void drag_handle(Document& document, const Grip& handle, glm::dvec2 from_px, glm::dvec2 to_px,
                 glm::dvec2 size_px) {
  const double distance =
      travel(document, handle, to_px, size_px) - travel(document, handle, from_px, size_px);
  if (!std::isfinite(distance)) return;
  const double least = LEAST_EDGE * scene_radius_world(document);
  RegionRequest& region = document.request.view.region;
  if (handle.of == GripOf::cut) {
    if (handle.number < region.cuts.size()) region.cuts[handle.number].point += distance * handle.normal;
    return;
  }
  std::optional<TurnedBox>& box = handle.of == GripOf::keep_box ? region.keep_box : region.drop_box;
  if (box) move_face(*box, handle.number, distance, least, up_of(document));
}

std::array<glm::dvec3, 8> corners_of(const TurnedBox& box, const glm::dvec3& up) {
  const std::array<HalfSpace, REGION_BOX_PLANES> planes = half_spaces(box, up);
  const glm::dvec3 middle = 0.5 * (box.low + box.high);
  std::array<glm::dvec3, 8> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    corners[i] = middle;
    for (std::size_t axis = 0; axis < 3; ++axis)
      corners[i] += planes[2 * axis + (i >> axis & 1U)].point - middle;
  }
  return corners;
}

TurnedBox box_of_all(const Document& document) {
  const double margin = MARGIN * scene_radius_world(document);
  return {document.bounds_min_world - margin, document.bounds_max_world + margin};
}

std::optional<Slice> slice_of(const RegionRequest& region) {
  const std::size_t count = region.cuts.size();
  if (count < 2) return {};
  const HalfSpace &from = region.cuts[count - 2], &to = region.cuts[count - 1];
  const glm::dvec3 normal = glm::normalize(from.normal);
  const double thickness = glm::dot(to.point - from.point, normal);
  if (glm::dot(normal, glm::normalize(to.normal)) > OPPOSITE || !(thickness > 0.0)) return {};
  return Slice{from.point + 0.5 * thickness * normal, normal, thickness};
}

void set_slice(RegionRequest& region, const Slice& slice) {
  remove_slice(region);
  const glm::dvec3 half = 0.5 * slice.thickness * slice.normal;
  region.cuts.push_back({slice.point - half, slice.normal});
  region.cuts.push_back({slice.point + half, -slice.normal});
}

void remove_slice(RegionRequest& region) {
  if (slice_of(region)) region.cuts.resize(region.cuts.size() - 2);
}

Slice first_slice(const Document& document, int axis) {
  const glm::dvec3 normal = upright_axes(up_of(document))[axis];
  const double size = glm::dot(glm::abs(normal), document.bounds_max_world - document.bounds_min_world);
  const double least = LEAST_EDGE * scene_radius_world(document);
  return {middle_of(document), normal, std::max(THICKNESS * size, least)};
}

bool move_slice(Document& document, double notches) {
  std::optional<Slice> slice = slice_of(document.request.view.region);
  if (!slice || !std::isfinite(notches)) return slice.has_value();
  const glm::dvec3 moved = slice->point + notches * NOTCH * scene_radius_world(document) * slice->normal;
  slice->point = moved;
  set_slice(document.request.view.region, *slice);
  return true;
}

}  // namespace splatray
