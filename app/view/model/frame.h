/// What the render thread hands to the window.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/library/attributes.h"
#include "app/library/shot/scene_on_device.h"
#include "app/view/model/false_color.h"
#include "engine/image/image.h"
#include "engine/image/view.h"

namespace splatray {

struct DevicePicture;

/// One state of the picture, complete or still growing.
struct Frame {
  /// Its size is the traced one; rgba of ViewMode::shaded, else aov, where they were brought to the host: not of what `shown` has.
  Image image;
  View view;  ///< of the image
  ViewMode mode = ViewMode::shaded;
  /// What a screen shows: sRGB 8 bit rgba, r first; empty where `shown` has it.
  std::vector<std::uint8_t> display;
  /// The same on the device that shows it; null: it is on the host.
  std::shared_ptr<const DevicePicture> shown;
  std::uint32_t samples = 0;  ///< in every pixel
  ColorRange range;           ///< of the colours of `mode`
  bool of_points = false;     ///< points stand in for the scene, which is not there yet: `image` is empty
  bool is_seen = false;       ///< it is of LOOK_SEEN
  bool denoised = false;      ///< all samples are in, and their noise is out
  bool moving = false;        ///< coarse: what is shown changes
  double scale = 1.0;         ///< traced pixels / window pixels, along an edge; below 1 while moving
  double ms = 0.0;            ///< wall time of the last whole pass over the picture
  RenderStats stats;          ///< of all of the picture so far
  ColorLegend legend;         ///< of the points' colours
  PoolBytes pool_bytes;
  std::uint32_t pools_uploaded = 0;  ///< since start
  std::string device;
};

/// The splat under the cursor, and where the ray through it meets the blended surface.
struct Inspected {
  std::uint32_t object = 0;
  std::string object_name;
  glm::dvec3 center_world{0.0};  ///< float64
  glm::dvec3 normal{0.0};        ///< unit
  double radius_world = 0.0;
  std::uint32_t leaf_depth = 0;  ///< of the leaf that holds the centre; root = 0
  std::uint32_t leaf_references = 0;
  glm::dvec3 hit_world{0.0};    ///< blended
  double distance_world = 0.0;  ///< from the eye to hit_world
  std::vector<AttributeValue> attributes{};
};

}  // namespace splatray
