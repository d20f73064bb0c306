/// Tiles that Zstandard has packed (RFC 8878; the data type "zstandard" of Entwine Point Tile 1.0).
#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

namespace splatray {

/// What a file's frames hold. Throws Error (input_unreadable), one sentence, for damaged and unfinished frames, and for more than `most`
/// bytes in them: a few bytes can unpack to very many.
[[nodiscard]] std::vector<unsigned char> read_zstandard(const std::filesystem::path& path,
                                                        std::uint64_t most);

}  // namespace splatray
