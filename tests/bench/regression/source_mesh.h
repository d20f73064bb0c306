/// The mesh that a case is measured against.
#pragma once
#include <array>
#include <filesystem>

#include "preprocess/points.h"

namespace splatray::testing {

/// A file's triangles. Throws Error as read_input does, and (input_unreadable) where it has none.
[[nodiscard]] Mesh source_mesh(const std::filesystem::path& path);

/// The lowest and highest corner of what the triangles have.
[[nodiscard]] std::array<glm::dvec3, 2> box_of(const Mesh& mesh);

}  // namespace splatray::testing
