/// The camera as mouse and keys move it: float64, turntable about the document's up axis. The camera's target is the
/// pivot: it lies in the middle of the picture and is what orbits turn about. Positions in the picture are pixels from
/// its top left corner, y down; `size_px` is the picture's size, both >= 1. Input that is not finite changes nothing, and
/// no input makes a camera that make_frame_params refuses; moves that leave the scene far behind are not made. Orthographic
/// cameras are kept outside the scene, so that none of it lies behind them.
#pragma once
#include <glm/glm.hpp>
#include <optional>

#include "app/view/model/document.h"

namespace splatray {

/// From where an axis view looks, as named in upright_axes: front is where the default camera stands.
enum class AxisView { front, back, right, left, top, bottom };

/// Half the diagonal of the document's bounding box, world units; 1 for a single point, and never less than what float64
/// resolves there.
[[nodiscard]] double scene_radius_world(const Document& document);

/// The point under `position_px` in the plane of the pivot across the view direction.
[[nodiscard]] glm::dvec3 point_under(const Camera& camera, glm::dvec2 position_px, glm::dvec2 size_px);

/// Where a world point lies in the picture; nothing behind the eye.
[[nodiscard]] std::optional<glm::dvec2> place_in_picture(const Camera& camera, const glm::dvec3& point_world,
                                                         glm::dvec2 size_px);

/// Turns the camera about a point, unset = the pivot, half a turn for a drag over the smaller edge of the picture: to the right turns
/// the scene to the right, down shows more of its top. The point stays where it is in the picture. Stops exactly above and below. A
/// rolled camera is levelled.
void orbit(Document& document, glm::dvec2 drag_px, glm::dvec2 size_px,
           std::optional<glm::dvec3> about_world = {});
/// Moves camera and pivot across the view so that what lay under `from_px` at the pivot's depth lies under `to_px`.
void pan(Document& document, glm::dvec2 from_px, glm::dvec2 to_px, glm::dvec2 size_px);
/// Nearer (`notches` > 0, of a wheel) or farther; the point under `position_px` at the pivot's depth stays there.
void zoom(Document& document, double notches, glm::dvec2 position_px, glm::dvec2 size_px);
/// Turns the view about the eye as if the mouse pushed it: to the right looks right, down looks down. In orthographic
/// pictures, which have no eye, as orbit.
void look(Document& document, glm::dvec2 drag_px, glm::dvec2 size_px);
/// Moves camera and pivot for `seconds` with `direction` (right, up, forward; each -1..1, of the camera), at half
/// of scene_radius_world() a second, five times that when `fast`; at most a quarter of a second counts. In orthographic
/// pictures forward enlarges.
void fly(Document& document, glm::dvec3 direction, double seconds, bool fast);

/// Moves camera and pivot along the ground, level whichever way the camera looks, and up and down: `speed` times a tenth of
/// scene_radius_world() a second, else as fly.
void walk(Document& document, glm::dvec3 direction, double seconds, double speed);

/// Makes a world point the pivot: camera and pivot move across the view until it lies in the middle, as large as before.
/// Points that are not before the eye change nothing.
void set_pivot(Document& document, const glm::dvec3& point_world);
/// The whole scene from the direction the camera has, its bounding box filling the picture. `aspect` = width / height > 0.
void frame_all(Document& document, double aspect);
/// Along an axis of the scene, at the distance the camera has from the pivot.
void set_axis_view(Document& document, AxisView view);
/// Perspective to orthographic or back; what lies at the pivot's depth keeps its size in the picture.
void toggle_orthographic(Document& document);
/// Another up axis (length > 0) of the scene; the camera stays where it is and is levelled.
void set_up_axis(Document& document, const glm::dvec3& up);

/// Drags a light about the scene's centre, at its distance from there: towards where the ray under `position_px` touches
/// the sphere about the scene's bounding box, or passes nearest by it.
void drag_light(const Document& document, glm::dvec2 position_px, glm::dvec2 size_px, SceneLight& light);

}  // namespace splatray
