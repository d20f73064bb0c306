#include "preprocess/read/e57/scan_decoder.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <type_traits>

#include "engine/base/release.h"
#include "preprocess/base/point_arrays.h"

namespace splatray {
namespace {

constexpr std::size_t BATCH = 2048;
constexpr std::uint64_t REPORTED_PACKETS = 16;
constexpr std::uint64_t MOST_ORIGINS = 10;
constexpr std::uint64_t ORIGIN_SHARE = 1000;
constexpr std::uint64_t CELLS_A_RECORD = 64;  ///< of a grid that is believed
constexpr glm::u16vec3 WHITE_8_BIT{255, 255, 255};

/// A value as an attribute's type; what it cannot hold is 0 or its nearest.
template <typename Value>
Value attribute_of(double value) {
  if constexpr (std::is_integral_v<Value>) {
    const double most = std::numeric_limits<Value>::max();
    return value > 0.0 ? static_cast<Value>(std::min(value, most)) : Value{0};
  } else {
    return std::abs(value) <= static_cast<double>(std::numeric_limits<Value>::max())
               ? static_cast<Value>(value)
               : Value{0};
  }
}

/// A row or column; NO_CELL where it is none.
std::uint32_t index_of(double value) {
  return value >= 0.0 && value < double{NO_CELL} ? static_cast<std::uint32_t>(value) : NO_CELL;
}

/// The place of range, azimuth about z from x, and elevation above the xy plane.
glm::dvec3 cartesian(const glm::dvec3& spherical) {
  const double across = spherical.x * std::cos(spherical.z);
  return {across * std::cos(spherical.y), across * std::sin(spherical.y),
          spherical.x * std::sin(spherical.z)};
}

/// Fills the list up to this scan's first point and makes room for all of the file's points.
template <typename Value>
void begin_list(std::vector<Value>& list, const Points& points, const Value& absent) {
  list.reserve(points.position.capacity());
  list.resize(points.size(), absent);
}

/// The number of the column that is named like `empty`, which is added where there is none.
std::size_t column_number(Points& points, const Column& empty) {
  std::vector<Column>& columns = points.columns;
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [&](const Column& column) { return column.name == empty.name; });
  const auto number = static_cast<std::size_t>(found - columns.begin());
  if (number == columns.size()) columns.push_back(empty);
  edit_values(columns[number], [&points](auto& list) {
    begin_list(list, points, typename std::decay_t<decltype(list)>::value_type{});
  });
  return number;
}

/// Appends `count` values; returns the first of them.
template <typename Value>
Value* grow(std::vector<Value>& list, std::size_t count) {
  list.resize(list.size() + count);
  return list.data() + (list.size() - count);
}

/// Removes the values whose points are marked; `marks` begins at `first`.
template <typename Value>
void erase_marked(std::vector<Value>& list, std::size_t first, const std::vector<bool>& marks) {
  if (list.size() != first + marks.size()) return;  // this scan has none
  std::size_t to = first;
  for (std::size_t i = 0; i < marks.size(); ++i)
    if (!marks[i]) list[to++] = list[first + i];
  list.resize(to);
}

}  // namespace

ScanDecoder::ScanDecoder(const E57Scan& scan, const ScanLayout& layout, ScanColors& colors, ScanFile& file)
    : scan_(scan),
      layout_(layout),
      colors_(colors),
      file_(file),
      first_(file.points.size()),
      rotation_(glm::mat3_cast(scan.rotation)),
      source_of_(scan.fields.size()),
      kept_(BATCH) {
  for (const FieldIndex field : layout.fields()) {
    source_of_[field] = sources_.size();
    sources_.push_back(
        {FieldStream(scan.fields[field]), std::vector<double>(BATCH), scan.fields[field].bits == 0});
    if (sources_.back().is_constant) sources_.back().stream.decode(BATCH, sources_.back().values.data());
  }
  Points& points = file.points;
  if (layout.colors) begin_list(points.stored_color, points, WHITE_8_BIT);
  if (layout.color_scale.is_judged) colors.begin(first_, layout.color_scale);
  if (layout.normals) begin_list(points.normal, points, glm::vec3(0.0F));
  if (layout.cell) begin_list(points.grid_cell, points, NO_CELL);
  for (const ColumnSource& column : layout.columns) columns_.push_back(column_number(points, column.empty));
}

void ScanDecoder::decode(PagedFile& pages, const E57Section& section, const ReadListener& listener) {
  PacketReader packets(pages, section, scan_.fields.size());
  const std::vector<FieldIndex> fields = layout_.fields();
  FieldBytes bytes;
  // Records without bits take no bytes: no more of them are believed than if each had one, or than a batch.
  const std::uint64_t section_bytes = section.end - std::min(section.begin, section.end);
  const std::uint64_t most = std::min(scan_.records, std::max<std::uint64_t>(8 * section_bytes, BATCH));
  decode_ready(most);
  for (std::uint64_t packet = 0; decoded_ < most && packets.next(bytes); ++packet) {
    if (packet % REPORTED_PACKETS == 0)
      listener.report(static_cast<double>(decoded_) / static_cast<double>(most));
    for (const FieldIndex field : fields) {
      Source& source = sources_[source_of_[field]];
      if (!source.is_constant) source.stream.append(bytes[field]);
    }
    decode_ready(most);
  }
}

/// Decodes the records of which all fields are there, up to record `most`.
void ScanDecoder::decode_ready(std::uint64_t most) {
  std::uint64_t left = most - decoded_;
  for (const Source& source : sources_)
    if (!source.is_constant) left = std::min(left, source.stream.available());
  while (left > 0) {
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(left, BATCH));
    decode_batch(count);
    left -= count;
  }
}

void ScanDecoder::decode_batch(std::size_t count) {
  for (Source& source : sources_)
    if (!source.is_constant) source.stream.decode(count, source.values.data());
  kept_.resize(BATCH);
  find_positions(count);
  std::vector<glm::dvec3>& positions = file_.points.position;
  positions.insert(positions.end(), world_.begin(), world_.end());
  if (layout_.colors) append_colors();
  if (layout_.normals) append_normals();
  if (layout_.cell) append_cells(count);
  append_columns();
  decoded_ += count;
  file_.counts.no_return += count - kept_.size();
}

void ScanDecoder::find_positions(std::size_t count) {
  const double* state = layout_.invalid_state ? values(*layout_.invalid_state) : nullptr;
  const double* x = values(layout_.coordinates[0]);
  const double* y = values(layout_.coordinates[1]);
  const double* z = values(layout_.coordinates[2]);
  world_.resize(count);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (state != nullptr && state[i] != 0.0) continue;
    const glm::dvec3 stored(x[i], y[i], z[i]);
    const glm::dvec3 local = layout_.is_spherical ? cartesian(stored) : stored;
    const glm::dvec3 world = rotation_ * local + scan_.translation;
    if (!(glm::dot(local, local) < INFINITY && glm::dot(world, world) < INFINITY)) continue;
    if (local == glm::dvec3(0.0)) {
      ++origins_;
    } else {
      box_.add(local);
    }
    kept_[kept] = static_cast<std::uint32_t>(i);
    world_[kept++] = world;
  }
  kept_.resize(kept);
  world_.resize(kept);
}

void ScanDecoder::append_colors() {
  const double* invalid = layout_.color_invalid ? values(*layout_.color_invalid) : nullptr;
  const auto& [low, high, is_stated, is_float, is_judged] = layout_.color_scale;
  std::array<const double*, 3> channel{};
  std::array<double, 3> scale{};
  for (std::size_t c = 0; c < 3; ++c) {
    channel[c] = values(layout_.colors->at(c));
    scale[c] = 255.0 / (high[c] - low[c]);
  }
  glm::u16vec3* to = grow(file_.points.stored_color, kept_.size());
  for (const std::uint32_t i : kept_) {
    glm::u16vec3 color = WHITE_8_BIT;
    glm::dvec3 stored(NAN);
    for (std::size_t c = 0; c < 3 && (invalid == nullptr || invalid[i] == 0.0); ++c) {
      const int axis = static_cast<int>(c);
      color[axis] = attribute_of<std::uint8_t>((channel[c][i] - low[c]) * scale[c] + 0.5);
      stored[axis] = attribute_of<float>(channel[c][i]);
    }
    if (is_judged) colors_.add(stored);
    *to++ = color;
  }
}

void ScanDecoder::append_normals() {
  const auto& [x, y, z] = *layout_.normals;
  const auto finite = [](double value) { return double{attribute_of<float>(value)}; };
  glm::vec3* to = grow(file_.points.normal, kept_.size());
  for (const std::uint32_t i : kept_) {
    const glm::dvec3 local(finite(values(x)[i]), finite(values(y)[i]), finite(values(z)[i]));
    *to++ = glm::vec3(rotation_ * local);
  }
}

void ScanDecoder::append_columns() {
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const ColumnSource& source = layout_.columns[c];
    const double* from = values(source.field);
    const double* invalid = source.invalid ? values(*source.invalid) : nullptr;
    edit_values(file_.points.columns[columns_[c]], [&](auto& list) {
      using Value = typename std::decay_t<decltype(list)>::value_type;
      Value* to = grow(list, kept_.size());
      for (const std::uint32_t i : kept_)
        *to++ =
            invalid == nullptr || invalid[i] == 0.0 ? attribute_of<Value>(from[i] + source.add) : Value{0};
    });
  }
}

void ScanDecoder::append_cells(std::size_t count) {
  const double* row = values(layout_.cell->at(0));
  const double* column = values(layout_.cell->at(1));
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t r = index_of(row[i]);
    const std::uint32_t c = index_of(column[i]);
    if (r == NO_CELL || c == NO_CELL) continue;
    row_maximum_ = std::max(row_maximum_, r);
    column_maximum_ = std::max(column_maximum_, c);
  }
  std::uint32_t* to_row = grow(file_.points.grid_cell, kept_.size());
  std::uint32_t* to_column = grow(column_, kept_.size());
  for (const std::uint32_t i : kept_) {
    *to_row++ = index_of(row[i]);
    *to_column++ = index_of(column[i]);
  }
}

void ScanDecoder::finish(std::vector<std::string>& notes) {
  file_.counts.stored += scan_.records;
  file_.counts.missing += scan_.records - decoded_;
  if (origins_ > MOST_ORIGINS && origins_ > decoded_ / ORIGIN_SHARE) drop_origins();
  Station station;
  station.name = scan_.name;
  set_grid(station, notes);
  if (is_sensor_at_origin(scan_, layout_.is_spherical || station.rows > 0, box_))
    station.sensor_world = scan_.translation;
  file_.points.stations.push_back(std::move(station));
}

void ScanDecoder::drop_origins() {
  Points& points = file_.points;
  std::vector<bool> marks(points.size() - first_);
  for (std::size_t i = 0; i < marks.size(); ++i) marks[i] = points.position[first_ + i] == scan_.translation;
  const std::size_t before = points.size();
  erase_marked(colors_.stored(), first_, marks);
  erase_marked(column_, 0, marks);
  for_each_array(points, [&](auto& values) { erase_marked(values, first_, marks); });
  file_.counts.no_return += before - points.size();
}

/// Rows and columns are counted from 0, whatever the least is, up to what indexBounds or a record says.
void ScanDecoder::set_grid(Station& station, std::vector<std::string>& notes) {
  std::vector<std::uint32_t>& cells = file_.points.grid_cell;
  const std::uint64_t most = std::min<std::uint64_t>(NO_CELL - 1, CELLS_A_RECORD * decoded_);
  const auto fits = [most](std::uint64_t rows, std::uint64_t columns) { return columns <= most / rows; };
  std::uint64_t rows = std::max<std::uint64_t>(row_maximum_, scan_.row_maximum) + 1;
  std::uint64_t columns = std::max<std::uint64_t>(column_maximum_, scan_.column_maximum) + 1;
  if (!fits(rows, columns)) {
    rows = std::uint64_t{row_maximum_} + 1;
    columns = std::uint64_t{column_maximum_} + 1;
  }
  const bool is_grid = row_maximum_ > 0 && column_maximum_ > 0;
  if (!is_grid || !fits(rows, columns)) {
    if (cells.size() > first_) cells.resize(first_);
    if (is_grid)
      notes.push_back("a grid of " + std::to_string(rows) + " rows and " + std::to_string(columns) +
                      " columns for " + std::to_string(decoded_) + " records is not used");
    return;
  }
  station.rows = static_cast<std::uint32_t>(rows);
  station.columns = static_cast<std::uint32_t>(columns);
  for (std::size_t i = 0; i < column_.size(); ++i) {
    std::uint32_t& cell = cells[first_ + i];
    const bool is_cell = cell != NO_CELL && column_[i] != NO_CELL;
    cell = is_cell ? cell * station.columns + column_[i] : NO_CELL;
  }
}

void finish_scans(Points& points, const std::vector<std::size_t>& last_of_scan) {
  const std::size_t size = points.size();
  if (!points.stored_color.empty()) {
    points.stored_color.resize(size, WHITE_8_BIT);
    points.stored_color_most = 255;
  }
  if (!points.normal.empty()) points.normal.resize(size, glm::vec3(0.0F));
  const bool has_grid = std::any_of(points.stations.begin(), points.stations.end(),
                                    [](const Station& station) { return station.rows > 0; });
  if (has_grid) points.grid_cell.resize(size, NO_CELL);
  if (!has_grid) release(points.grid_cell);
  for (Column& column : points.columns) edit_values(column, [size](auto& list) { list.resize(size); });
  if (points.stations.size() < 2) return;
  points.station.reserve(size);
  for (std::size_t i = 0; i < last_of_scan.size(); ++i)
    points.station.resize(last_of_scan[i], static_cast<std::uint16_t>(i));
}

}  // namespace splatray
