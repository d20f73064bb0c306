/// What the title block of a drawing's page says beside its title (ISO 7200).
#pragma once
#include <string>

namespace splatray {

/// Fields that stay empty are left to be filled in by hand.
struct TitleBlock {
  std::string project, number, sheet, revision, author, date;

  bool operator==(const TitleBlock&) const = default;
};

/// What --title-block takes: KEY=TEXT;..., such as project=Town hall;number=A-101;date=2026-11-28. Throws Expected.
[[nodiscard]] TitleBlock read_title_block(const std::string& text);
/// The text that read_title_block makes the same of; empty where all fields are.
[[nodiscard]] std::string title_block_text(const TitleBlock& block);

}  // namespace splatray
