/// Boxes and planes of a region, taken hold of in the picture, and slices.
#pragma once
#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "app/view/model/document.h"

namespace splatray {

/// What of a region a handle moves.
enum class GripOf { keep_box, drop_box, cut };

/// A face of a box or a plane that can be moved along its normal.
struct Grip {
  GripOf of = GripOf::keep_box;
  std::size_t number = 0;       ///< of a box: 2 * axis + 1 for its upper face; else of the cut
  glm::dvec3 place_world{0.0};  ///< where it is drawn
  glm::dvec3 normal{0.0};       ///< unit, along which it moves; out of a box, to the kept side of a cut
};

/// Those of the document's region; cuts have theirs near the middle of what is there.
[[nodiscard]] std::vector<Grip> handles_of(const Document& document);
/// The handle within `near_px` of a place in the picture, the nearest of them.
[[nodiscard]] std::optional<Grip> handle_at(const Document& document, glm::dvec2 position_px,
                                            glm::dvec2 size_px, double near_px);
/// Moves what a handle is of so that the handle follows the cursor from one place in the picture to another, pixels; a box keeps its
/// low below its high.
void drag_handle(Document& document, const Grip& handle, glm::dvec2 from_px, glm::dvec2 to_px,
                 glm::dvec2 size_px);

/// Corners of a box, world: corner i is high along axis a where bit a of i is set.
[[nodiscard]] std::array<glm::dvec3, 8> corners_of(const TurnedBox& box, const glm::dvec3& up);
/// A box about all there is, and a little more.
[[nodiscard]] TurnedBox box_of_all(const Document& document);

/// A slice: two cuts of opposite normals, the last ones of the region.
struct Slice {
  glm::dvec3 point{0.0};   ///< in the middle
  glm::dvec3 normal{0.0};  ///< unit
  double thickness = 0.0;
};
[[nodiscard]] std::optional<Slice> slice_of(const RegionRequest& region);
/// Replaces the slice, or adds one.
void set_slice(RegionRequest& region, const Slice& slice);
void remove_slice(RegionRequest& region);
/// A slice through the middle across an axis of the scene (0 right, 1 up, 2 front; upright_axes), a twentieth of it thick.
[[nodiscard]] Slice first_slice(const Document& document, int axis);
/// Moves the slice by `notches` of a wheel, a hundredth of the scene each; returns whether there is one.
bool move_slice(Document& document, double notches);

}  // namespace splatray
