#include "preprocess/read/las/las_columns.h"

#include <algorithm>
#include <utility>

#include "engine/base/release.h"
#include "preprocess/base/little_endian.h"
#include "preprocess/read/scan/missing_attributes.h"

namespace splatray {
namespace {

/// Where the fixed attributes stand in Points::columns; extra bytes follow.
enum FixedColumn : std::size_t {
  INTENSITY_COLUMN,
  CLASS_COLUMN,
  RETURN_COLUMN,
  RETURNS_COLUMN,
  SOURCE_COLUMN,
  TIME_COLUMN,
  FIXED_COLUMNS
};

/// The fields of a record that both kinds have, each in its own way.
struct Marks {
  unsigned classification;
  unsigned return_number;
  unsigned returns;
  unsigned source;
  bool is_withheld;
};

Marks marks_of(const unsigned char* record, bool is_extended) {
  const unsigned returns = record[14];
  if (is_extended)
    return {record[16], returns & 15U, returns >> 4U, load<std::uint16_t>(record + 20),
            (record[15] & 4U) != 0};
  const unsigned classification = record[15];
  return {classification & 31U, returns & 7U, (returns >> 3U) & 7U, load<std::uint16_t>(record + 18),
          (classification & 128U) != 0};
}

bool is_noise(unsigned classification) {
  constexpr unsigned LOW_NOISE = 7;
  constexpr unsigned HIGH_NOISE = 18;
  return classification == LOW_NOISE || classification == HIGH_NOISE;
}

glm::dvec3 stored_position(const unsigned char* record) {
  return {load<std::int32_t>(record), load<std::int32_t>(record + 4), load<std::int32_t>(record + 8)};
}

bool is_zero(const Column& column) {
  return std::visit(
      [](const auto& list) { return std::all_of(list.begin(), list.end(), [](auto v) { return v == 0; }); },
      column.values);
}

}  // namespace

LasColumns::LasColumns(const LasHeader& header, LasExtras extra, const ScanOptions& options)
    : header_(header),
      fields_(las_fields(header.point_format)),
      extra_{{}, std::move(extra.normal), std::move(extra.radius)},
      keep_all_(options.keep_withheld),
      asked_(options.attributes) {
  points_.columns = {{std::string(COLUMN_INTENSITY), std::vector<std::uint16_t>{}},
                     {std::string(COLUMN_CLASS), std::vector<std::uint8_t>{}},
                     {std::string(COLUMN_RETURN), std::vector<std::uint8_t>{}},
                     {std::string(COLUMN_RETURNS), std::vector<std::uint8_t>{}},
                     {std::string(COLUMN_SOURCE), std::vector<std::uint16_t>{}},
                     {std::string(COLUMN_TIME), std::vector<double>{}}};
  for (LasExtraBytes& one : extra.columns) {
    if (find_column(points_.columns, one.name) != nullptr) continue;
    points_.columns.push_back({one.name, one.fits_float() ? Column::Values(Pool<float>()) : Pool<double>()});
    extra_.columns.push_back(std::move(one));
  }
}

std::vector<bool> LasColumns::used_bytes() const {
  std::vector<bool> used(header_.record_bytes, false);
  const auto mark = [&used](std::size_t at, std::size_t count, bool is_used) {
    std::fill_n(used.begin() + static_cast<std::ptrdiff_t>(at), count, is_used);
  };
  mark(0, fields_.bytes, true);
  constexpr std::size_t USER_DATA = 17, USER_DATA_AND_ANGLE_BYTES = 3;
  if (header_.is_extended()) mark(USER_DATA, USER_DATA_AND_ANGLE_BYTES, false);
  if (fields_.infrared != 0) mark(fields_.infrared, sizeof(std::uint16_t), false);
  const auto use = [&mark](const LasExtraBytes& one) { mark(one.at, one.bytes(), true); };
  std::for_each(extra_.columns.begin(), extra_.columns.end(), use);
  if (extra_.normal) std::for_each(extra_.normal->begin(), extra_.normal->end(), use);
  if (extra_.radius) use(*extra_.radius);
  return used;
}

template <class F>
void LasColumns::for_each_array(F f) {
  f(points_.position);
  if (fields_.color != 0) f(points_.stored_color);
  if (extra_.normal) f(points_.normal);
  if (extra_.radius) f(points_.radius);
  for (std::size_t i = 0; i < points_.columns.size(); ++i)
    if (i != TIME_COLUMN || fields_.time != 0) edit_values(points_.columns[i], f);
}

void LasColumns::reserve(std::size_t count) {
  for_each_array([count](auto& list) { list.reserve(count); });
}

std::size_t LasColumns::grow(std::size_t count) {
  const std::size_t at = size();
  for_each_array([size = at + count](auto& list) { list.resize(size); });
  return at;
}

void LasColumns::cut(std::size_t count) {
  for_each_array([count](auto& list) { list.resize(count); });
}

void LasColumns::move(std::size_t from, std::size_t count, std::size_t to) {
  if (from == to) return;
  for_each_array([=](auto& list) { std::copy_n(list.data() + from, count, list.data() + to); });
}

LasColumns::Filled LasColumns::fill(const unsigned char* records, std::size_t count, std::size_t at) {
  const auto array = [this]<class T>(FixedColumn place, T) {
    return std::get<Pool<T>>(points_.columns[place].values).edit().data();
  };
  std::uint16_t* const intensity = array(INTENSITY_COLUMN, std::uint16_t{});
  std::uint8_t* const classification = array(CLASS_COLUMN, std::uint8_t{});
  std::uint8_t* const return_number = array(RETURN_COLUMN, std::uint8_t{});
  std::uint8_t* const returns = array(RETURNS_COLUMN, std::uint8_t{});
  std::uint16_t* const source = array(SOURCE_COLUMN, std::uint16_t{});
  double* const time = array(TIME_COLUMN, double{});
  const bool has_extra = !extra_.columns.empty() || extra_.normal || extra_.radius;
  const std::size_t begin = at;
  Filled filled;
  for (std::size_t i = 0; i < count; ++i) {
    const unsigned char* record = records + i * header_.record_bytes;
    const Marks marks = marks_of(record, header_.is_extended());
    if (!keep_all_ && (marks.is_withheld || is_noise(marks.classification))) {
      ++(marks.is_withheld ? filled.withheld : filled.noise);
      continue;
    }
    points_.position[at] = header_.scale * stored_position(record) + header_.offset;
    intensity[at] = load<std::uint16_t>(record + 12);
    classification[at] = static_cast<std::uint8_t>(marks.classification);
    return_number[at] = static_cast<std::uint8_t>(marks.return_number);
    returns[at] = static_cast<std::uint8_t>(marks.returns);
    source[at] = static_cast<std::uint16_t>(marks.source);
    if (fields_.time != 0) time[at] = load<double>(record + fields_.time);
    if (fields_.color != 0) points_.stored_color[at] = load<glm::u16vec3>(record + fields_.color);
    if (has_extra) fill_extra(record, at);
    ++at;
  }
  filled.kept = at - begin;
  return filled;
}

void LasColumns::fill_extra(const unsigned char* record, std::size_t at) {
  for (std::size_t e = 0; e < extra_.columns.size(); ++e)
    edit_values(points_.columns[FIXED_COLUMNS + e], [&](auto& list) {
      list[at] = static_cast<std::remove_reference_t<decltype(list[0])>>(extra_.columns[e].value(record));
    });
  if (extra_.normal)
    for (int axis = 0; axis < 3; ++axis)
      points_.normal[at][axis] =
          static_cast<float>((*extra_.normal)[static_cast<std::size_t>(axis)].value(record));
  if (extra_.radius) points_.radius[at] = static_cast<float>(extra_.radius->value(record));
}

std::vector<std::string> LasColumns::rounded() const {
  std::vector<std::string> names;
  for (std::size_t e = 0; e < extra_.columns.size(); ++e) {
    const Column& column = points_.columns[FIXED_COLUMNS + e];
    const auto* const values = std::get_if<Pool<double>>(&column.values);
    if (values != nullptr && std::any_of(values->begin(), values->end(), [&](double value) {
          return extra_.columns[e].may_be_rounded(value);
        }))
      names.push_back(column.name);
  }
  return names;
}

Points LasColumns::take() {
  std::erase_if(points_.columns, [this](const Column& column) {
    return column.size() != size() || (is_zero(column) && !is_asked_for(asked_, column.name));
  });
  const auto drop_zeros = [](auto& list) {
    if (std::all_of(list.begin(), list.end(), [](const auto& value) { return value == decltype(value){}; }))
      release(list);
  };
  drop_zeros(points_.normal);
  drop_zeros(points_.radius);
  return std::move(points_);
}

}  // namespace splatray
