/// Meshes, attributes and cameras of poses.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

/// What is wrong with objects given as arrays, compared with the same in files, which are written to `folder`, and with cameras made of
/// poses; a sentence each.
std::vector<std::string> find_array_defects(const std::filesystem::path& folder);
