/// Text of files, names and command lines as UTF-8, the one encoding within the program and in all that it writes.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace splatray {

/// Length of the well-formed UTF-8 sequence (RFC 3629) that the text begins with, 1 to 4; 0 = it begins with none.
[[nodiscard]] std::size_t utf8_length(std::string_view text);

[[nodiscard]] bool is_utf8(std::string_view text);

/// The text with each byte that is part of no well-formed UTF-8 sequence read as Latin-1 (ISO 8859-1): text of older programs
/// becomes readable, UTF-8 stays as it is, and what is mixed or cut off loses nothing else. Every text calls this where it enters.
[[nodiscard]] std::string to_utf8(std::string_view text);

/// A path for people and files' contents. Not to open it by: systems name files by bytes, which may be no UTF-8.
[[nodiscard]] std::string path_text(const std::filesystem::path& path);

/// Bytes at the text's end that may begin a sequence which goes on behind it: 0 to 3.
[[nodiscard]] std::size_t cut_utf8_bytes(std::string_view text);

}  // namespace splatray
