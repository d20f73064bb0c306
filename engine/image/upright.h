/// Which way a scan stands.
#pragma once
#include <optional>
#include <string>

#include "engine/image/point_sample.h"
#include "engine/scene/scene.h"

namespace splatray {

/// What decided which way a scene stands.
enum class UpEvidence {
  asked,    ///< a request
  format,   ///< what the format promises, or y where it promises nothing: no shape says otherwise
  camera,   ///< a camera's frame
  ring,     ///< stations around the points
  sweep,    ///< lower than wide, around a scanner
  survey,   ///< coordinates of a survey
  sheet,    ///< terrain: lower than wide
  feet,     ///< what it stands on
  opening,  ///< where it is open
  base,     ///< what is flat at an end
};
/// "format" and so on.
[[nodiscard]] const char* up_evidence_name(UpEvidence evidence);

/// An up direction, and what decided it.
struct UpFound {
  glm::dvec3 up{0.0, 1.0, 0.0};
  UpEvidence by = UpEvidence::format;
  /// The number that the rule compares: of a ring and of sweeps and sheets height over width, of surveys the distance to the origin in
  /// sizes, of feet stands_on, of an opening the mean normal along the axis, of a base the share of its points; else 0.
  double figure = 0.0;
};

/// The up direction of a scan: the scene's own, which is what its format promises, but for scans that plainly lie on
/// their side. The rules, the first that holds; of those without stations none does:
/// - A camera's frame (is_camera_frame) has y down.
/// - Stations in a ring around all points, as of a turntable, stand level: up is the ring's axis, on the side that most
///   normals look to.
/// - Of a sweep whose station's place is unknown up is the axis along which it is less than half as long as along the
///   others: formats of models promise y.
/// - Surveys and terrain have z up (up_of_survey) where y is promised.
/// - Things stand on their lower end (stands_on): of an object whose format promises y up is z, where it promises z up is y.
/// - Things are open below, where no scanner sees them: of an object up is the axis that the normals look to on the
///   mean, by 0.06 to 0.25, three times as much as to any other.
/// - Things stand on what is flat: of a room or an object up is the axis at whose lower end, within 3 % of the height,
///   most points lie with normals within 15 degrees of it, 3 % of all and three times as many as at the lower end of
///   the scene's own; not one along which an object is flat, as a wall is no floor, and not -z: no program has z down.
/// By the last three nothing is stood on its head: scans lie on their backs, but hardly any hangs from a ceiling; sides that
/// are found by votes may be wrong, and a room's ceiling is larger than what furniture leaves of its floor.
[[nodiscard]] UpFound upright(const Scene& scene);

/// Up of a scan of which nothing is said, by its places alone: that of a sweep about the origin, unless the places of scanners are known, z
/// where up_of_survey or stands_on says so, as above, else y. Normals, of which no side is known yet, are not looked at.
[[nodiscard]] UpFound upright_places(const PointSample& sample, bool place_known);

/// The up direction of a model whose format says none: y, which most programs write, but z, which is the others', where the model
/// plainly stands on that end (stands_on) and not on the other.
[[nodiscard]] glm::dvec3 upright_model(const PointSample& sample);

/// z, for points that lie as surveys and terrain do, else nothing. Survey: their middle is 10 000 and 10 sizes from the origin, and along z
/// a tenth of that, as eastings and northings are; nobody models there. Terrain: along z they are less than 0.3 as long as along x and
/// y, and the origin is not on one side of them along z by more than that, as it is of what a camera or a range finder saw along it.
[[nodiscard]] std::optional<UpFound> up_of_survey(const PointSample& sample);

/// A sentence that says which way a scene is shown that was stood up.
[[nodiscard]] std::string up_note(const glm::dvec3& up);

/// The share of a thing's outline from above that it stands on: the convex hull of the points within 5 % of the height of its lower
/// end, over that of all points; 0 where the middle of the points is not above that hull, so that it
/// would fall over (static stability: Fu et al. 2008, "Upright Orientation of Man-Made Objects", section 4). `up`: an axis or its
/// opposite.
[[nodiscard]] double stands_on(const PointSample& sample, const glm::dvec3& up);

}  // namespace splatray
