/// What a scan is of, as its points show: by it a picture of which nothing is said gets its view, colours and light.
#pragma once
#include <optional>

#include "engine/image/point_sample.h"
#include "engine/scene/scene.h"

namespace splatray {

enum class SceneKind {
  none,    ///< no scan: a mesh, or points of a scene with its camera or lights
  object,  ///< a thing, seen from outside
  site,    ///< terrain, streets, what a survey or a flight brings
  sweep,   ///< turns of a lidar on the ground: the further away, the fewer points
  room,    ///< walls on all sides that face in, and a ceiling
  camera,  ///< what a depth camera, or a scanner with a narrow field, saw from one place
};

/// The kind of a scene. The rules, the first that holds:
/// - none: it has no stations or no points.
/// - camera: it has a camera of its own, or seeing_place finds one, or its frame is a camera's (is_camera_frame).
/// - room: is_within holds at a station, or at the middle of the points, and most normals face that place, overhead too.
/// - sweep: points lie all around a station or, where no place is known, the origin, in 12 of 12 sectors of azimuth,
///   and half of them within 0.6 of the reach of 90 % and in less than 0.45 of the space that these fill: ever further apart.
/// - site: less than 0.3 times as high as wide.
/// - object: else.
[[nodiscard]] SceneKind kind_of_scan(const Scene& scene);
/// "a room" and so on; of none "a model".
[[nodiscard]] const char* scan_kind_name(SceneKind kind);

/// Whether a scene that is no scan and has no camera is a room's inside, which from outside shows nothing: what makes a scan a room holds
/// at the middle of the points, and more than half of the normals are upright or level, as floors and walls have them; of a round thing
/// whose faces are turned inside out a fifth is.
[[nodiscard]] bool is_model_of_room(const Scene& scene);

/// Whether more than half of the normals are within 10 degrees of upright or level, as those of walls, floors and ceilings are; of a
/// round thing a fifth is. `axes` as upright_axes has them.
[[nodiscard]] bool is_built(const PointSample& sample, const glm::dmat3& axes);

/// Whether a scan without a known place is in the frame of a camera, x to the right, y down and z ahead: it was seen
/// from the origin along z (is_seen_along_z); or it has one layer along z, near the origin, whose normals look
/// to -z on the mean, by more than 0.3: no scan from above or around does.
[[nodiscard]] bool is_camera_frame(const Scene& scene, const PointSample& sample);
/// The one place from which all was seen, where there is such a place: that of the only station, if all lies in a camera's field from
/// there (is_in_field_of), or the origin of a camera's frame, if all was seen from there (is_seen_from).
[[nodiscard]] std::optional<glm::dvec3> seeing_place(const Scene& scene, const PointSample& sample);
/// Whether points surround a place on all sides and above: in 12 of 12 sectors of azimuth some lie
/// within 30 degrees of level, and in 18 of 24 parts of equal area of the sky above 45 degrees. Not by shares of all
/// points: of a room that was thinned out evenly 2 % may lie that high, of the same as scanned 30 %. `axes` as
/// upright_axes has them.
[[nodiscard]] bool is_within(const PointSample& sample, const glm::dvec3& place, const glm::dmat3& axes);
/// Whether points lie all around a place in 12 of 12 sectors of azimuth, and crowd about it.
[[nodiscard]] bool is_sweep(const PointSample& sample, const glm::dvec3& place, const glm::dmat3& axes);
/// The first station in free space with points all around and overhead.
[[nodiscard]] std::optional<glm::dvec3> station_within(const Scene& scene, const PointSample& sample);
/// Where the scene's first station with a known place is.
[[nodiscard]] std::optional<glm::dvec3> first_sensor(const Scene& scene);

}  // namespace splatray
