#include "app/library/sheet/text_block.h"

#include <algorithm>
#include <array>

#include "app/library/sheet/sheet_writer.h"

namespace splatray {
namespace {

constexpr double LINE_GAP = 0.15;  ///< between lines, of the letters' size

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words(1);
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte > ' ' && byte != 0x7F)
      words.back() += c;
    else if (!words.back().empty())
      words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

/// Bytes of the letter of UTF-8 that begins there.
std::size_t letter_bytes(const std::string& text, std::size_t at) {
  std::size_t end = at + 1;
  while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) ++end;
  return end - at;
}

/// The largest part of a word that is no wider, but one letter at least.
std::size_t fitting_bytes(const std::string& word, double size_mm, double width_mm) {
  std::size_t fits = letter_bytes(word, 0);
  for (std::size_t end = fits; end < word.size();) {
    end += letter_bytes(word, end);
    if (text_width(word.substr(0, end), size_mm) > width_mm) break;
    fits = end;
  }
  return fits;
}

}  // namespace

void add_block(const Drawing& block, const glm::dvec2& corner, Drawing& page) {
  for (DrawnLine line : block.lines) {
    line.from += corner;
    line.to += corner;
    page.lines.push_back(line);
  }
  for (DrawnBox box : block.boxes) {
    box.corner += corner;
    page.boxes.push_back(box);
  }
  for (DrawnRaster raster : block.rasters) {
    raster.corner += corner;
    for (DrawnPath& path : raster.paths)
      for (glm::dvec2& point : path.points) point += corner;
    page.rasters.push_back(std::move(raster));
  }
  for (DrawnText text : block.texts) {
    text.at += corner;
    page.texts.push_back(text);
  }
}

TextBox text_box(const DrawnText& text) {
  const TextExtents extents = sheet_codec().text_extents(text.text, text.size_mm);
  static constexpr std::array BEFORE = {0.0, 0.5, 1.0};  // TextAnchor
  const double begin = -BEFORE.at(static_cast<std::size_t>(text.anchor)) * extents.width;
  if (text.upwards)
    return {text.at + glm::dvec2(-extents.ascent, -begin - extents.width),
            text.at + glm::dvec2(extents.descent, -begin)};
  return {text.at + glm::dvec2(begin, -extents.ascent),
          text.at + glm::dvec2(begin + extents.width, extents.descent)};
}

double line_height(double size_mm) {
  const TextExtents extents = sheet_codec().text_extents("", size_mm);
  return extents.ascent + extents.descent + LINE_GAP * size_mm;
}

double text_width(const std::string& text, double size_mm) {
  return sheet_codec().text_extents(text, size_mm).width;
}

std::vector<std::string> wrapped(const std::string& text, double size_mm, double width_mm) {
  std::vector<std::string> lines(1);
  for (std::string word : words_of(text)) {
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (text_width(longer, size_mm) <= width_mm) {
      lines.back() = longer;
      continue;
    }
    if (!lines.back().empty()) lines.emplace_back();
    while (text_width(word, size_mm) > width_mm) {
      const std::size_t fits = fitting_bytes(word, size_mm, width_mm);
      if (fits == word.size()) break;
      lines.back() = word.substr(0, fits);
      lines.emplace_back();
      word.erase(0, fits);
    }
    lines.back() = word;
  }
  return lines;
}

double add_text(const std::string& text, double size_mm, double width_mm, const glm::dvec2& corner,
                Drawing& block) {
  const double ascent = sheet_codec().text_extents("", size_mm).ascent, step = line_height(size_mm);
  double y = corner.y;
  for (const std::string& line : wrapped(text, size_mm, width_mm)) {
    if (!line.empty()) block.texts.push_back({{corner.x, y + ascent}, size_mm, TextAnchor::begin, line});
    y += step;
  }
  return y - corner.y;
}

}  // namespace splatray
