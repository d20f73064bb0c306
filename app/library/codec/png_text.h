/// What a PNG's file says beside its pixels (PNG specification, third edition, 2025, sections 5.3 and 11.3.3).
#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace splatray {

using PngText = std::vector<std::pair<std::string, std::string>>;

/// Bits of a pixel by a PNG's header; 1 if that has no known kind or the file is no PNG.
[[nodiscard]] std::uint64_t png_bits(const std::string& path);

/// The keywords and texts of a PNG's plain text chunks; empty for files that are none.
[[nodiscard]] PngText read_png_text(const std::string& path);

}  // namespace splatray
