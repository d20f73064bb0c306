#include "preprocess/read/pcd/pcd_points.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "engine/base/release.h"
#include "preprocess/base/little_endian.h"
#include "preprocess/base/quoted_list.h"
#include "preprocess/read/scan/column_names.h"
#include "preprocess/read/scan/narrow_column.h"
#include "preprocess/read/scan/stored_colors.h"

namespace splatray {
namespace {

static_assert(std::endian::native == std::endian::little, "PCD's values are little-endian");

/// What each field means (known_columns); nothing of those of several values.
std::vector<std::string> meanings_of(const PcdHeader& header) {
  std::vector<std::string> names;
  for (const PcdField& field : header.fields) names.push_back(field.count == 1 ? field.name : "");
  return known_columns(names);
}

const PcdField* find_meaning(const PcdHeader& header, std::string_view meaning) {
  const std::vector<std::string> meanings = meanings_of(header);
  const auto found = std::find(meanings.begin(), meanings.end(), meaning);
  return found == meanings.end() ? nullptr
                                 : &header.fields[static_cast<std::size_t>(found - meanings.begin())];
}

std::vector<const PcdField*> find_triple(const PcdHeader& header, const std::string_view (&names)[3]) {
  std::vector<const PcdField*> found;
  for (const std::string_view name : names) found.push_back(find_meaning(header, name));
  if (std::find(found.begin(), found.end(), nullptr) != found.end()) found.clear();
  return found;
}

bool is_color(const PcdField& field) {
  return field.type == PcdType::float32 || field.type == PcdType::uint32 || field.type == PcdType::int32;
}

/// Whether red and green are equal, to two steps, and blue jumps from one brightness to the next: greys whose packed bits were written as
/// a float of five digits, as PCL's text files have them, lose their last byte, blue.
bool have_lost_blue(const std::vector<glm::u16vec3>& colors) {
  constexpr double EQUAL_SHARE = 0.99, TOLD_SHARE = 0.5;
  // Deviation of blue from what it is at the next brightness; of random bytes 74. Of six digits it is 21, and changes slowly.
  constexpr double JUMP = 32.0;
  constexpr double TELLING = 16.0;  // points as bright as each other, which say what is usual of them
  std::array<std::array<double, 3>, 256> levels{};  // of green: the sums of 1, blue and its square
  std::size_t equal = 0;
  for (const glm::u16vec3& color : colors) {
    equal += std::abs(int{color.x} - int{color.y}) <= 2 ? 1 : 0;
    const double blue = color.z;
    std::array<double, 3>& level = levels[color.y];
    level[0] += 1.0, level[1] += blue, level[2] += blue * blue;
  }
  const auto all = static_cast<double>(colors.size());
  if (static_cast<double>(equal) < EQUAL_SHARE * all) return false;
  double told = 0.0, squares = 0.0;
  for (std::size_t green = 0; green + 1 < levels.size(); ++green) {
    const auto &level = levels[green], &next = levels[green + 1];
    if (level[0] < TELLING || next[0] < TELLING) continue;
    const double mean = level[1] / level[0], jump = next[1] / next[0] - mean;
    told += level[0];
    squares += level[2] - mean * level[1] + 0.5 * level[0] * jump * jump;
  }
  return told > TOLD_SHARE * all && squares > JUMP * JUMP * told;
}

}  // namespace

/// One field's values.
struct PcdPoints::View {
  const unsigned char* first;
  std::uint64_t stride;
  PcdType type;

  [[nodiscard]] const unsigned char* at(std::uint64_t i) const { return first + i * stride; }

  [[nodiscard]] double number(std::uint64_t i) const {
    const unsigned char* bytes = at(i);
    switch (type) {
      case PcdType::int8:
        return load<std::int8_t>(bytes);
      case PcdType::uint8:
        return load<std::uint8_t>(bytes);
      case PcdType::int16:
        return load<std::int16_t>(bytes);
      case PcdType::uint16:
        return load<std::uint16_t>(bytes);
      case PcdType::int32:
        return load<std::int32_t>(bytes);
      case PcdType::uint32:
        return load<std::uint32_t>(bytes);
      case PcdType::int64:
        return static_cast<double>(load<std::int64_t>(bytes));
      case PcdType::uint64:
        return static_cast<double>(load<std::uint64_t>(bytes));
      case PcdType::float32:
        return static_cast<double>(load<float>(bytes));
      case PcdType::float64:
        break;
    }
    return load<double>(bytes);
  }
};

PcdPoints::PcdPoints(const PcdHeader& header, const std::filesystem::path& path,
                     const std::vector<std::string>& attributes)
    : header_(header), position_(find_triple(header, COLUMN_AXES)) {
  if (position_.empty()) {
    std::vector<std::string> names;
    for (const PcdField& field : header.fields) names.push_back(field.name);
    throw_unreadable(path, "found the fields " + quoted_list(names) + ", expected x, y and z among them");
  }
  normal_ = find_triple(header, COLUMN_NORMALS);
  for (const char* name : {"rgba", "rgb"})
    if (const PcdField* field = header.find(name); field != nullptr && is_color(*field)) color_ = field;
  if (color_ == nullptr) channel_ = find_triple(header, COLUMN_COLORS);
  std::vector<std::string> names{std::string(COLUMN_INTENSITY)};
  names.insert(names.end(), attributes.begin(), attributes.end());
  for (const std::string& name : names) {
    const PcdField* field = name == COLUMN_INTENSITY ? find_meaning(header, name) : header.find(name);
    const bool known = std::any_of(attributes_.begin(), attributes_.end(),
                                   [field](const auto& attribute) { return attribute.second == field; });
    if (field != nullptr && !known) attributes_.emplace_back(name, field);
  }
  values_.resize(attributes_.size());
}

PcdPoints::View PcdPoints::view(const PcdField& field, const PcdRows& rows) const {
  switch (header_.data) {
    case PcdData::ascii:
      return {rows.bytes + sizeof(double) * field.cell, sizeof(double) * header_.row_cells, PcdType::float64};
    case PcdData::binary:
      return {rows.bytes + field.offset, header_.row_bytes, field.type};
    case PcdData::binary_compressed:
      break;
  }
  return {rows.bytes + field.offset * header_.points, field.bytes(), field.type};
}

/// Bits 0xAARRGGBB; a text of a field of type F is the number that these bits are as a float.
glm::u16vec3 PcdPoints::color(const View& view, std::uint64_t i) const {
  std::uint32_t bits = 0;
  if (header_.data != PcdData::ascii) {
    bits = load<std::uint32_t>(view.at(i));
  } else if (const double value = view.number(i); color_->type == PcdType::float32) {
    bits = std::isnan(value) ? 0 : std::bit_cast<std::uint32_t>(static_cast<float>(value));
  } else if (std::fabs(value) < 4294967296.0) {
    bits = static_cast<std::uint32_t>(static_cast<std::int64_t>(value));
  }
  return {bits >> 16U & 255U, bits >> 8U & 255U, bits & 255U};
}

void PcdPoints::append(const PcdRows& rows) {
  if (rows.count == 0) return;
  const View x = view(*position_[0], rows);
  const View y = view(*position_[1], rows);
  const View z = view(*position_[2], rows);
  for (std::uint64_t i = 0; i < rows.count; ++i, ++rows_) {
    const glm::dvec3 position(x.number(i), y.number(i), z.number(i));
    if (!std::isfinite(position.x + position.y + position.z)) {
      ++no_return_;
      continue;
    }
    points_.position.push_back(position);
    if (!normal_.empty()) {
      glm::vec3 normal;
      for (int axis = 0; axis < 3; ++axis)
        normal[axis] = static_cast<float>(view(*normal_[static_cast<std::size_t>(axis)], rows).number(i));
      points_.normal.push_back(normal);
    }
    if (color_ != nullptr) points_.stored_color.push_back(color(view(*color_, rows), i));
    for (std::size_t c = 0; c < channel_.size(); ++c)
      channels_[c].push_back(static_cast<float>(view(*channel_[c], rows).number(i)));
    for (std::size_t a = 0; a < attributes_.size(); ++a)
      values_[a].push_back(view(*attributes_[a].second, rows).number(i));
    if (header_.height > 1) points_.grid_cell.push_back(static_cast<std::uint32_t>(rows_));
  }
}

bool PcdPoints::uses(const PcdField& field) const {
  const auto is_it = [&](const PcdField* used) { return used == &field; };
  return std::any_of(position_.begin(), position_.end(), is_it) ||
         std::any_of(normal_.begin(), normal_.end(), is_it) ||
         std::any_of(channel_.begin(), channel_.end(), is_it) || color_ == &field ||
         std::any_of(attributes_.begin(), attributes_.end(),
                     [&](const auto& attribute) { return attribute.second == &field; });
}

std::uint64_t PcdPoints::whole_points(std::uint64_t bytes) const {
  std::uint64_t whole = header_.points;
  for (const PcdField& field : header_.fields) {
    const std::uint64_t begin = std::min(field.offset * header_.points, bytes);
    if (uses(field)) whole = std::min(whole, (bytes - begin) / field.bytes());
  }
  return whole;
}

std::vector<std::string> PcdPoints::unused() const {
  std::vector<std::string> names;
  for (const PcdField& field : header_.fields) {
    if (!uses(field) && field.name != "_") names.push_back(field.name);
  }
  return names;
}

Points PcdPoints::take(std::vector<std::string>& notes) {
  for (std::size_t a = 0; a < attributes_.size(); ++a)
    points_.columns.push_back(narrow_column(attributes_[a].first, std::move(values_[a])));
  if (!channel_.empty() && !channels_[0].empty()) {
    if (const std::string said = store_colors(std::move(channels_), points_); !said.empty())
      notes.push_back(said);
    return std::move(points_);
  }
  std::vector<glm::u16vec3>& colors = points_.stored_color;
  points_.stored_color_most = 255;
  if (std::all_of(colors.begin(), colors.end(), [](const glm::u16vec3& c) { return c == glm::u16vec3(0); }))
    release(colors);
  if (have_lost_blue(colors)) {
    for (glm::u16vec3& color : colors) {
      // Zero is exact in any number of digits: blue alone is white that was rounded up, beyond the last bit of red.
      const bool white = color.x == 0 && color.y == 0 && color.z != 0;
      color = white ? glm::u16vec3(255) : glm::u16vec3(color.x, color.y, color.y);
    }
    notes.emplace_back(
        "its colours are greys whose last byte, blue, was lost when they were written as rounded numbers; "
        "green takes its place");
  }
  return std::move(points_);
}

}  // namespace splatray
