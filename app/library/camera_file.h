/// Cameras in JSON files, whatever the size of the picture. World space, numbers exact in float64:
///   camera: {"eye": [x, y, z], "target": [x, y, z], "up": [x, y, z], "fov_y_deg": 30}
///           with "ortho_height" (world units) in place of "fov_y_deg" for an orthographic one, "panorama": true for a panorama, and with
///           "lens_shift": [x, y] and "pixel_aspect" (Camera) where they are not 0, 0 and 1
///   path:   {"keys": [camera, ...]}, each with "frame": whole number, ascending; a key without one stands
///           KEY_FRAMES after the key before it, the first at 0
/// Other members are not looked at.
#pragma once
#include <filesystem>

#include "app/library/camera_path.h"

namespace splatray {

/// Frames between keys that name none: a second of film.
inline constexpr std::uint32_t KEY_FRAMES = 24;

/// Throws Error (input_unreadable) with file, found and expected.
[[nodiscard]] Camera read_camera(const std::filesystem::path& path);
[[nodiscard]] CameraPath read_camera_path(const std::filesystem::path& path);

/// Throws Error (failed); leaves no partial file.
void write_camera(const Camera& camera, const std::filesystem::path& path);
void write_camera_path(const CameraPath& keys, const std::filesystem::path& path);

}  // namespace splatray
