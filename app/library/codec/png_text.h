/// What a PNG's file says beside its pixels (PNG specification, third edition, 2025, sections 5.3, 11.3.3 and 11.3.4.3).
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

/// Adds to a whole PNG in memory that its colours are sRGB, how large its pixels are on paper unless `dots_per_inch` is 0, and text
/// chunks of the pairs whose names begin with "splatray.".
void add_png_chunks(std::vector<unsigned char>& bytes, const PngText& text, double dots_per_inch);

}  // namespace splatray
