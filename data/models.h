/// What splatray-generate can make, by name.
#pragma once
#include <map>
#include <string>

#include "data/shapes.h"

namespace splatray {

struct ModelOptions {
  double angle_deg = 60.0;  ///< opening angle of the wedge, (0, 180)
};

/// The still life before a ring of light of data/scenes/demo.gltf.
[[nodiscard]] Model demo_model();

/// The closed box room of data/scenes/room.gltf (Goradia et al. 2010, Fig. 14 b: a room with matte, mirror
/// and glass spheres).
[[nodiscard]] Model room_model();

using ModelMaker = std::function<Model(const ModelOptions& options)>;

/// All models, scenes and single shapes (unit size, about the origin).
[[nodiscard]] const std::map<std::string, ModelMaker>& models();

/// Samples the model with about sampling.count points, shared out by area times density; one cloud per
/// object.
[[nodiscard]] std::map<std::string, OrientedPoints> sample(const Model& model, const Sampling& sampling);

}  // namespace splatray
