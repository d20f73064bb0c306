#include "preprocess/read/ply/ply_vertices.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "engine/base/srgb.h"
#include "preprocess/base/quoted_list.h"
#include "preprocess/read/scan/column_names.h"
#include "preprocess/read/scan/narrow_column.h"
#include "preprocess/read/scan/scan_stations.h"
#include "preprocess/read/scan/stored_colors.h"

namespace splatray {
namespace {

using Triple = std::array<int, 3>;  ///< property indices, -1 = absent
constexpr Triple ABSENT{-1, -1, -1};

/// Which property feeds which attribute.
struct PlyColumns {
  Triple position = ABSENT;
  Triple normal = ABSENT;
  Triple color = ABSENT;
  int radius = -1;
  std::vector<std::pair<int, std::string>> attributes;  ///< with the names of their columns

  [[nodiscard]] bool uses(int property) const {
    const auto in = [&](const Triple& triple) {
      return std::find(triple.begin(), triple.end(), property) != triple.end();
    };
    return in(position) || in(normal) || in(color) || property == radius ||
           std::any_of(attributes.begin(), attributes.end(),
                       [&](const auto& attribute) { return attribute.first == property; });
  }
};

/// The properties that mean these, all three, or ABSENT.
Triple find_triple(const std::vector<std::string>& meanings, const std::string_view (&names)[3]) {
  Triple found{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto at = std::find(meanings.begin(), meanings.end(), names[i]);
    if (at == meanings.end()) return ABSENT;
    found[i] = static_cast<int>(at - meanings.begin());
  }
  return found;
}

/// Whether a known column is none of a position, normal or colour.
bool is_attribute(const std::string& known) {
  const auto is_it = [&](std::string_view name) { return name == known; };
  return !known.empty() && std::none_of(std::begin(COLUMN_AXES), std::end(COLUMN_AXES), is_it) &&
         std::none_of(std::begin(COLUMN_NORMALS), std::end(COLUMN_NORMALS), is_it) &&
         std::none_of(std::begin(COLUMN_COLORS), std::end(COLUMN_COLORS), is_it);
}

/// What each property means (known_columns); nothing of lists.
std::vector<std::string> meanings_of(const PlyElement& element) {
  std::vector<std::string> names;
  for (const PlyProperty& property : element.properties)
    names.push_back(property.is_list ? "" : property.name);
  return known_columns(names);
}

PlyColumns find_columns(const PlyBody& in, const PlyElement& element) {
  const std::vector<std::string> meanings = meanings_of(element);
  PlyColumns columns;
  columns.position = find_triple(meanings, COLUMN_AXES);
  if (columns.position == ABSENT) {
    in.fail("element 'vertex' has no properties x, y, z");
  }
  columns.normal = find_triple(meanings, COLUMN_NORMALS);
  columns.color = find_triple(meanings, COLUMN_COLORS);
  const int radius = element.find("radius");
  if (radius >= 0 && !element.properties[static_cast<std::size_t>(radius)].is_list) {
    columns.radius = radius;
  }
  return columns;
}

void find_attributes(const PlyElement& element, const std::vector<std::string>& wanted, PlyColumns& columns) {
  const std::vector<std::string> known = meanings_of(element);
  for (std::size_t i = 0; i < known.size(); ++i) {
    const std::string& name = element.properties[i].name;
    const auto is_it = [&](const std::string& one) { return plain_name(one) == plain_name(name); };
    const auto named = std::find_if(wanted.begin(), wanted.end(), is_it);
    std::string column = named != wanted.end() ? *named : is_attribute(known[i]) ? known[i] : "";
    if (column.empty() && plain_name(name) == "confidence") column = "confidence";
    const bool used = columns.uses(static_cast<int>(i)) || element.properties[i].is_list;
    if (!used && !column.empty()) columns.attributes.emplace_back(static_cast<int>(i), std::move(column));
  }
}

/// Rows of scalars in memory: where each property stands and how it is stored.
struct RowLayout {
  std::vector<std::size_t> offset;
  std::vector<PlyType> type;
  std::size_t stride = 0;
  bool swap = false;
};

/// Binary rows without lists are used as they stand in the file; all others are gathered as float64.
RowLayout make_layout(const PlyBody& in, const PlyElement& element, bool in_place) {
  RowLayout layout;
  layout.swap = in_place && in.swaps();
  for (const PlyProperty& property : element.properties) {
    layout.offset.push_back(layout.stride);
    layout.type.push_back(in_place ? property.type : PlyType::float64);
    layout.stride += ply_type_bytes(layout.type.back());
  }
  return layout;
}

/// Copies one property of `count` rows to out[0], out[out_stride], ...
template <class Out>
void copy_column(const unsigned char* rows, std::size_t count, const RowLayout& layout, int property,
                 Out* out, std::size_t out_stride) {
  const auto index = static_cast<std::size_t>(property);
  const unsigned char* value = rows + layout.offset[index];
  with_ply_type(layout.type[index], [&](auto kind) {
    for (std::size_t i = 0; i < count; ++i) {
      out[i * out_stride] =
          static_cast<Out>(load_ply_value<decltype(kind)>(value + i * layout.stride, layout.swap));
    }
  });
}

template <class Vector>
void copy_triple(const unsigned char* rows, std::size_t count, const RowLayout& layout, const Triple& triple,
                 std::vector<Vector>& out) {
  if (triple == ABSENT) {
    return;
  }
  const std::size_t begin = out.size();
  out.resize(begin + count);
  for (int axis = 0; axis < 3; ++axis) {
    copy_column(rows, count, layout, triple[static_cast<std::size_t>(axis)], &out[begin][axis], 3);
  }
}

void append_rows(const unsigned char* rows, std::size_t count, const RowLayout& layout,
                 const PlyColumns& columns, Points& points, std::vector<std::vector<double>>& values) {
  copy_triple(rows, count, layout, columns.position, points.position);
  copy_triple(rows, count, layout, columns.normal, points.normal);
  copy_triple(rows, count, layout, columns.color, points.color);
  if (columns.radius >= 0) {
    const std::size_t begin = points.radius.size();
    points.radius.resize(begin + count);
    copy_column(rows, count, layout, columns.radius, &points.radius[begin], 1);
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t begin = values[i].size();
    values[i].resize(begin + count);
    copy_column(rows, count, layout, columns.attributes[i].first, &values[i][begin], 1);
  }
}

void reserve(Points& points, std::uint64_t count, const PlyColumns& columns) {
  points.position.reserve(count);
  points.normal.reserve(columns.normal == ABSENT ? 0 : count);
  points.color.reserve(columns.color == ABSENT ? 0 : count);
  points.radius.reserve(columns.radius < 0 ? 0 : count);
}

/// The values of a row that are used, in the places of their properties.
void gather_row(PlyBody& in, const PlyElement& element, const PlyColumns& columns, double* row) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    if (columns.uses(static_cast<int>(i)))
      row[i] = in.number(element.properties[i].type);
    else
      in.skip(element.properties[i]);
  }
}

void take_attributes(const PlyColumns& columns, std::vector<std::vector<double>> values, Points& points) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string& name = columns.attributes[i].second;
    if (name == COLUMN_SCAN) static_cast<void>(make_stations(values[i], points));
    points.columns.push_back(narrow_column(name, std::move(values[i])));
  }
}

/// Takes points out of rows in memory, block by block.
class RowTaker {
 public:
  RowTaker(PlyBody& in, const PlyElement& element, const PlyColumns& columns, bool in_place)
      : in_(in),
        element_(element),
        columns_(columns),
        layout_(make_layout(in, element, in_place)),
        block_rows_(std::max<std::size_t>(1, ByteReader::BLOCK_BYTES / layout_.stride)),
        values_(columns.attributes.size()) {
    reserve(points_, in.most_rows(element), columns);
  }

  /// Binary rows without lists, as they stand in the file.
  void take_in_place() {
    const std::uint64_t count = in_.most_rows(element_);
    for (std::uint64_t done = 0; done < count;) {
      const auto step = static_cast<std::size_t>(std::min<std::uint64_t>(block_rows_, count - done));
      const unsigned char* rows = in_.bytes().take(step * layout_.stride);
      if (rows == nullptr) in_.fail("it could not be read to its end");
      append_rows(rows, step, layout_, columns_, points_, values_);
      done += step;
    }
  }

  /// Rows that are read value by value.
  void take_gathered() {
    const std::size_t width = element_.properties.size();
    const std::uint64_t count = in_.read_rows(element_, [&] {
      if (gathered_.size() == block_rows_ * width) append_gathered(block_rows_);
      gathered_.resize(gathered_.size() + width);
      gather_row(in_, element_, columns_, gathered_.data() + gathered_.size() - width);
    });
    append_gathered(static_cast<std::size_t>(count - points_.size()));
  }

  Points points() {
    take_attributes(columns_, std::move(values_), points_);
    return std::move(points_);
  }

 private:
  void append_gathered(std::size_t count) {
    if (count == 0) return;
    append_rows(reinterpret_cast<const unsigned char*>(gathered_.data()), count, layout_, columns_, points_,
                values_);
    gathered_.clear();
  }

  PlyBody& in_;
  const PlyElement& element_;
  const PlyColumns& columns_;
  RowLayout layout_;
  std::size_t block_rows_;
  std::vector<double> gathered_;
  Points points_;
  std::vector<std::vector<double>> values_;
};

Points read_rows(PlyBody& in, const PlyElement& element, const PlyColumns& columns) {
  const bool has_lists = std::any_of(element.properties.begin(), element.properties.end(),
                                     [](const PlyProperty& property) { return property.is_list; });
  const bool in_place = !in.is_ascii() && !has_lists;
  RowTaker taker(in, element, columns, in_place);
  if (in_place)
    taker.take_in_place();
  else
    taker.take_gathered();
  return taker.points();
}

/// The value that stands for full intensity: by type, unless the values themselves say otherwise.
float color_scale(const Points& points, PlyType type, const PlyBody& in, std::vector<std::string>& notes) {
  if (type == PlyType::uint8 || type == PlyType::int8) return 255.0F;
  const bool is_float = type >= PlyType::float16;
  ColorRange range(is_float);
  for (const glm::vec3& color : points.color)
    for (int channel = 0; channel < 3; ++channel) range.add(static_cast<double>(color[channel]));
  const bool is_short = type == PlyType::int16 || type == PlyType::uint16;
  const float usual = is_float ? 1.0F : is_short ? 65535.0F : 255.0F;
  const auto full =
      static_cast<float>(is_float || range.full() > 1.0 ? range.full() : static_cast<double>(usual));
  if (range.is_black() || (full == usual && range.outliers() == 0)) return full;
  std::string said = color_note(range);
  if (said.empty()) said = "colours are taken as of 0 to " + std::to_string(static_cast<int>(full));
  notes.push_back(in.path().string() + ": " + said);
  return full;
}

/// Raw file values to linear rgb; NaN becomes 0.
void linearise(std::vector<glm::vec3>& colors, float scale) {
  std::vector<float> table;
  if (scale >= 255.0F) {
    table.resize(static_cast<std::size_t>(scale) + 1);
    for (std::size_t i = 0; i < table.size(); ++i) {
      table[i] = srgb_to_linear(static_cast<float>(i) / scale);
    }
  }
  for (glm::vec3& color : colors) {
    for (int channel = 0; channel < 3; ++channel) {
      const float unit = std::max(0.0F, std::min(color[channel] / scale, 1.0F));
      color[channel] =
          table.empty() ? srgb_to_linear(unit) : table[static_cast<std::size_t>(unit * scale + 0.5F)];
    }
  }
}

}  // namespace

Points read_ply_vertices(PlyBody& in, const PlyElement& element, const std::vector<std::string>* attributes,
                         std::vector<std::string>& notes) {
  PlyColumns columns = find_columns(in, element);
  if (attributes != nullptr) find_attributes(element, *attributes, columns);
  Points points = read_rows(in, element, columns);
  std::vector<std::string> skipped;
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    if (!columns.uses(static_cast<int>(i))) {
      skipped.push_back(element.properties[i].name);
    }
  }
  if (!skipped.empty()) {
    notes.push_back(in.path().string() + ": skipped vertex properties " + quoted_list(skipped));
  }
  if (columns.color != ABSENT) {
    const PlyType type = element.properties[static_cast<std::size_t>(columns.color[0])].type;
    linearise(points.color, color_scale(points, type, in, notes));
  }
  return points;
}

}  // namespace splatray
