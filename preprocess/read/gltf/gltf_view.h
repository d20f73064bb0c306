/// What glTF nodes carry besides meshes: transforms, lights, cameras.
#pragma once
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/points.h"
#include "preprocess/read/gltf/gltf_file.h"

namespace splatray {

/// The node's transform to its parent: its matrix, or translation * rotation * scale. Throws Error
/// (input_unreadable) for arrays of the wrong length and numbers that are not finite.
[[nodiscard]] glm::dmat4 node_transform(const GltfFile& file, const tinygltf::Node& node);

/// The light of KHR_lights_punctual on this node, if any. Intensities (lux, candela) are taken as they are.
/// The node's extras may give it a size: "size" is a point light's radius, world units, or the angle that a
/// directional one seems to have, degrees; "width" and "height", world units, make a rectangle that shines along the node's -z.
[[nodiscard]] std::optional<SceneLight> read_light(const GltfFile& file, const tinygltf::Node& node,
                                                   const glm::dmat4& to_world);

/// The camera of this node, if any: it looks along the node's -z, up is +y. The target lies one unit ahead.
[[nodiscard]] std::optional<Camera> read_camera(const GltfFile& file, const tinygltf::Node& node,
                                                const glm::dmat4& to_world);

}  // namespace splatray
