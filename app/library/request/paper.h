/// Sizes of paper (ISO 216).
#pragma once
#include <array>
#include <string_view>

namespace splatray {

struct PaperSize {
  const char* name;
  double short_mm, long_mm;
};

/// The smallest first.
inline constexpr std::array PAPER_SIZES = {PaperSize{"A4", 210.0, 297.0}, PaperSize{"A3", 297.0, 420.0},
                                           PaperSize{"A2", 420.0, 594.0}, PaperSize{"A1", 594.0, 841.0},
                                           PaperSize{"A0", 841.0, 1189.0}};

/// Which way a page lies.
enum class PaperTurn { chosen, portrait, landscape };

/// The size of that name; null for others.
[[nodiscard]] constexpr const PaperSize* find_paper(std::string_view name) {
  for (const PaperSize& size : PAPER_SIZES)
    if (name == size.name) return &size;
  return nullptr;
}

}  // namespace splatray
