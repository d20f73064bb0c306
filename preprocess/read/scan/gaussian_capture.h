/// Captures of 3D Gaussians (Kerbl et al. 2023) are no points: how they are recognised.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace splatray {

/// Throws Error (input_unreadable) where the extension is one of their formats: SPZ, SOG, KSPLAT, SPLAT.
void refuse_gaussian_file(const std::filesystem::path& path);

/// Throws Error (input_unreadable) where a PLY's vertices have such properties, plain (f_dc_0, rot_0) or packed ones
/// (packed_position), and where a glTF's extensions or attributes are such (KHR_gaussian_splatting); in any case.
void refuse_gaussian_names(const std::filesystem::path& path, const std::vector<std::string>& names);

}  // namespace splatray
