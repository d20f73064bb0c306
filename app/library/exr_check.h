/// A look at an OpenEXR file before OpenEXR believes it.
#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace splatray {

/// OpenEXR takes memory for whatever sizes a header's attributes state, and for a table of offsets that follows from the
/// window and tiles they state. What of a file that begins as OpenEXR's do is larger than the file itself; nothing for a file
/// that keeps to its size, or that is of another format (OpenEXR File Layout, openexr.com, "Header", "Chunk Offset Table").
[[nodiscard]] std::optional<std::string> find_exr_defect(const std::filesystem::path& path);

}  // namespace splatray
