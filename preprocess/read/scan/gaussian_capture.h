/// Captures of 3D Gaussians (Kerbl et al. 2023) in formats that are not read: how they are recognised.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace splatray {

/// Throws Error (input_unreadable) where the extension is one of their formats: SPZ, SOG, KSPLAT, SPLAT.
void refuse_gaussian_file(const std::filesystem::path& path);

/// Throws Error (input_unreadable) where a glTF's extensions or attributes are such (KHR_gaussian_splatting), in any case.
void refuse_gaussian_names(const std::filesystem::path& path, const std::vector<std::string>& names);

}  // namespace splatray
