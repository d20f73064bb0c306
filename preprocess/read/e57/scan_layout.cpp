#include "preprocess/read/e57/scan_layout.h"

#include <algorithm>

namespace splatray {
namespace {

using Names = std::array<const char*, 3>;

/// Looks up fields by their names.
class FieldFinder {
 public:
  FieldFinder(const E57Scan& scan, std::vector<std::string>& notes) : scan_(scan), notes_(notes) {}

  [[nodiscard]] const E57Field* named(const std::string& name) const {
    const auto found = std::find_if(scan_.fields.begin(), scan_.fields.end(),
                                    [&](const E57Field& field) { return field.name == name; });
    return found == scan_.fields.end() ? nullptr : &*found;
  }

  /// A field that can be decoded; notes why it cannot.
  [[nodiscard]] std::optional<FieldIndex> readable(const std::string& name) const {
    const E57Field* field = named(name);
    if (field == nullptr) return std::nullopt;
    if (!field->defect.empty()) {
      notes_.push_back("the field " + name + " " + field->defect + "; it is left out");
      return std::nullopt;
    }
    return static_cast<FieldIndex>(field - scan_.fields.data());
  }

  /// Fields that are read all or not at all.
  template <std::size_t COUNT>
  [[nodiscard]] std::optional<std::array<FieldIndex, COUNT>> all(
      const std::array<const char*, COUNT>& names) const {
    std::array<FieldIndex, COUNT> fields{};
    for (std::size_t i = 0; i < COUNT; ++i) {
      const std::optional<FieldIndex> field = readable(names[i]);
      if (!field) return std::nullopt;
      fields[i] = *field;
    }
    return fields;
  }

 private:
  const E57Scan& scan_;
  std::vector<std::string>& notes_;
};

void find_coordinates(ScanLayout& layout, const E57Scan& scan, const FieldFinder& find,
                      const std::filesystem::path& path) {
  constexpr Names CARTESIAN = {"cartesianX", "cartesianY", "cartesianZ"};
  constexpr Names SPHERICAL = {"sphericalRange", "sphericalAzimuth", "sphericalElevation"};
  const auto has_all = [&](const Names& names) {
    return std::all_of(names.begin(), names.end(),
                       [&](const char* name) { return find.named(name) != nullptr; });
  };
  layout.is_spherical = !has_all(CARTESIAN);
  const Names& names = layout.is_spherical ? SPHERICAL : CARTESIAN;
  const std::string where = "in the scan '" + scan.name + "', found ";
  if (!has_all(names))
    throw_unreadable(path, where +
                               "no coordinates, expected cartesianX, Y and Z or sphericalRange, Azimuth "
                               "and Elevation");
  for (std::size_t i = 0; i < names.size(); ++i) {
    const E57Field* field = find.named(names.at(i));
    if (!field->defect.empty())
      throw_unreadable(path, where + "the coordinate " + field->name + " which " + field->defect);
    layout.coordinates.at(i) = static_cast<FieldIndex>(field - scan.fields.data());
  }
  layout.invalid_state =
      find.readable(layout.is_spherical ? "sphericalInvalidState" : "cartesianInvalidState");
}

/// What full colour is where colorLimits does not say it: by the field's own range, which may be narrower.
double usual_most(const E57Field& field) {
  const double largest = field.largest.value_or(255.0);
  for (const double most : {1.0, 255.0, 65535.0})
    if (largest <= most && (most > 1.0 || field.kind != E57Field::Kind::integer)) return most;
  return largest;
}

void find_colors(ScanLayout& layout, const E57Scan& scan, const FieldFinder& find) {
  layout.colors = find.all<3>({"colorRed", "colorGreen", "colorBlue"});
  layout.color_invalid = find.readable("isColorInvalid");
  if (!layout.colors) return;
  ColorScale& scale = layout.color_scale;
  for (std::size_t i = 0; i < 3; ++i) {
    const E57Field& field = scan.fields[layout.colors->at(i)];
    const E57Limits& limits = scan.color_limits.at(i);
    const double low = limits.minimum.value_or(0.0);
    const double high = limits.maximum.value_or(0.0);
    const bool is_range = high > low && high - low < 1e300;
    scale.low.at(i) = is_range ? low : 0.0;
    scale.high.at(i) = is_range ? high : usual_most(field);
    scale.is_stated = scale.is_stated || is_range || field.largest;
    scale.is_float = scale.is_float || field.kind != E57Field::Kind::integer;
    scale.is_judged = scale.is_judged || scale.is_float || scale.high.at(i) > 255.0;
  }
}

void find_columns(ScanLayout& layout, const E57Scan& scan, const FieldFinder& find,
                  const std::vector<std::string>& attributes) {
  const auto add = [&](const std::string& field, const char* invalid, double more, Column empty) {
    const std::optional<FieldIndex> found = find.readable(field);
    if (!found) return;
    const std::optional<FieldIndex> state = invalid != nullptr ? find.readable(invalid) : std::nullopt;
    layout.columns.push_back({*found, state, more, std::move(empty)});
  };
  add("intensity", "isIntensityInvalid", 0.0, {std::string(COLUMN_INTENSITY), std::vector<float>{}});
  const E57Field* returns = find.named("returnCount");
  if (returns != nullptr && returns->bits > 0) {  // returnIndex is from 0
    add("returnIndex", nullptr, 1.0, {std::string(COLUMN_RETURN), std::vector<std::uint8_t>{}});
    add("returnCount", nullptr, 0.0, {std::string(COLUMN_RETURNS), std::vector<std::uint8_t>{}});
  }
  for (const std::string& name : attributes) {
    const auto is_kept = [&](const ColumnSource& column) { return scan.fields[column.field].name == name; };
    if (std::none_of(layout.columns.begin(), layout.columns.end(), is_kept))
      add(name, nullptr, 0.0, {name, std::vector<double>{}});
  }
}

}  // namespace

std::vector<FieldIndex> ScanLayout::fields() const {
  std::vector<FieldIndex> all(coordinates.begin(), coordinates.end());
  const auto add = [&all](const auto& some) {
    if (some) all.insert(all.end(), some->begin(), some->end());
  };
  const auto add_one = [&all](const std::optional<FieldIndex>& one) {
    if (one) all.push_back(*one);
  };
  add(colors);
  add(normals);
  add(cell);
  add_one(invalid_state);
  if (colors) add_one(color_invalid);
  for (const ColumnSource& column : columns) {
    all.push_back(column.field);
    add_one(column.invalid);
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

ScanLayout find_layout(const E57Scan& scan, const std::vector<std::string>& attributes,
                       const std::filesystem::path& path, std::vector<std::string>& notes) {
  const FieldFinder find(scan, notes);
  ScanLayout layout;
  find_coordinates(layout, scan, find, path);
  find_colors(layout, scan, find);
  layout.normals = find.all<3>({"nor:normalX", "nor:normalY", "nor:normalZ"});
  layout.cell = find.all<2>({"rowIndex", "columnIndex"});
  find_columns(layout, scan, find, attributes);
  return layout;
}

}  // namespace splatray
