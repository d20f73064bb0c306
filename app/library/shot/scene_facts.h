/// What a scene is, as far as that decides how it is shown.
#pragma once
#include <memory>
#include <vector>

#include "app/library/attributes.h"
#include "engine/image/scan_kind.h"
#include "engine/image/upright.h"
#include "engine/image/view.h"
#include "engine/image/view_check.h"
#include "engine/scene/scene.h"

namespace splatray {

struct SceneFacts {
  SceneKind kind = SceneKind::none;
  UpFound up{};                            ///< the way that it stands, and what decided it
  Viewpoint viewpoint = Viewpoint::front;  ///< that suits it
  std::vector<CheckedView> views{};        ///< that were tried (check_views), the last of which is shown
  bool sees_land = false;                  ///< a sweep, or land that one sensor saw along it
  bool has_colors = false;                 ///< of its own that are not all alike, nor its normals
  bool shows_normals = false;              ///< its colours are its normals, which say nothing of its surface
  bool has_intensity = false;              ///< that varies
  std::string color_by{};  ///< the colours that it is shown in were chosen for it; empty: they are its own
  ColorLegend legend{};    ///< of the colours that it is shown in
  /// The first levels of a scan of which the scene has what one request's pictures need, else null: what is chosen of a scene's
  /// shape and size is chosen of these, whatever was read.
  std::shared_ptr<const Scene> overview{};
  double lod = 0.0;  ///< spacing of the scene's points in these pictures, pixels; 0: all of the scan was read
};

/// Those of a scene that is shown in its own colours and has its pools.
[[nodiscard]] SceneFacts facts_of(const Scene& scene);

}  // namespace splatray
