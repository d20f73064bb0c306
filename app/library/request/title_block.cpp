#include "app/library/request/title_block.h"

#include <algorithm>
#include <array>

#include "app/library/request/value_text.h"
#include "engine/base/utf8.h"

namespace splatray {
namespace {

struct BlockField {
  const char* key;
  std::string TitleBlock::*member;
};
constexpr std::array FIELDS = {
    BlockField{"project", &TitleBlock::project}, BlockField{"number", &TitleBlock::number},
    BlockField{"sheet", &TitleBlock::sheet},     BlockField{"revision", &TitleBlock::revision},
    BlockField{"author", &TitleBlock::author},   BlockField{"date", &TitleBlock::date}};
constexpr const char* EXPECTED =
    "KEY=TEXT with ; between them, keys project, number, sheet, revision, author and date, such as "
    "project=Town hall;number=A-101";

void read_part(const std::string& part, TitleBlock& block) {
  const std::size_t equals = part.find('=');
  const auto field = std::find_if(FIELDS.begin(), FIELDS.end(), [&](const BlockField& row) {
    return equals != std::string::npos && part.substr(0, equals) == row.key;
  });
  if (field == FIELDS.end() || equals + 1 == part.size()) throw Expected{EXPECTED};
  block.*field->member = to_utf8(part.substr(equals + 1));
}

}  // namespace

TitleBlock read_title_block(const std::string& text) {
  TitleBlock block;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(';', begin), text.size());
    read_part(text.substr(begin, end - begin), block);
    begin = end + 1;
  }
  return block;
}

std::string title_block_text(const TitleBlock& block) {
  std::string text;
  for (const BlockField& field : FIELDS)
    if (!(block.*field.member).empty())
      text += (text.empty() ? "" : ";") + std::string(field.key) + "=" + block.*field.member;
  return text;
}

}  // namespace splatray
