/// What a scene is, as far as that decides how it is shown.
#pragma once
#include "app/library/attributes.h"
#include "engine/image/scan_kind.h"
#include "engine/image/view.h"
#include "engine/scene/scene.h"

namespace splatray {

struct SceneFacts {
  SceneKind kind = SceneKind::none;
  Viewpoint viewpoint = Viewpoint::front;  ///< that suits a scan
  bool has_colors = false;                 ///< of its own that are not all alike
  bool has_intensity = false;              ///< that varies
  std::string color_by{};  ///< the colours that it is shown in were chosen for it; empty: they are its own
  ColorLegend legend{};    ///< of the colours that it is shown in
};

/// Those of a scene that is shown in its own colours and has its pools.
[[nodiscard]] SceneFacts facts_of(const Scene& scene);

}  // namespace splatray
