/// What files of points say of all points together: one definition for those who write it (preprocess/write) and who read it.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "preprocess/points.h"

namespace splatray {

/// The columns of splats' words of normal fields and clip lines, which are read as Points::field_words and clip_words.
inline constexpr std::array<std::string_view, 2> SPLAT_WORDS{"splat_field", "splat_clip"};

/// One sentence: "splatray up" and "0 0 1". Its file has both in one comment (PLY) or a list of texts by this name (VTP).
struct SplatMark {
  std::string key;
  std::string text;  ///< one line
};

/// What a file of a scene's points says: the up direction, scans, the coordinate system, and of splats alone their lattice.
[[nodiscard]] std::vector<SplatMark> splat_marks(const Scene& scene, bool splats_alone);

/// Whether a text of this key is a mark.
[[nodiscard]] bool is_mark_key(std::string_view key);

/// The mark that a comment holds; nothing where it is a comment of another kind.
[[nodiscard]] std::optional<SplatMark> mark_of(std::string_view comment);

/// Whether a file with these marks holds splats.
[[nodiscard]] bool has_splats(const std::vector<SplatMark>& marks);

/// Takes what the marks say; of splats also the words of normal fields and clip lines, which are no columns then.
void take_marks(const std::vector<SplatMark>& marks, Points& points);

}  // namespace splatray
