/// The texts that a picture keeps of its making, in JPEG and WebP, which have no place of their own for names and values; PNG's are
/// in png_text.h.
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace splatray {

using KeptText = std::vector<std::pair<std::string, std::string>>;

/// Adds the pairs whose names begin with "splatray." to a whole JPEG in memory, each as a comment (ITU-T T.81, B.2.4.5) of name, zero
/// and value. One that is longer than a comment can be, 65 533 bytes, is left out.
void add_jpeg_text(std::vector<unsigned char>& bytes, const KeptText& text);
/// The same of a WebP of the extended format or not (RFC 9649, section 2.7), in a chunk "SPLT", which other readers pass over.
void add_webp_text(std::vector<unsigned char>& bytes, const KeptText& text, int width, int height,
                   bool has_alpha);

/// What was added; empty for files of others, and for those that are neither.
[[nodiscard]] KeptText read_kept_text(const std::string& path);

}  // namespace splatray
