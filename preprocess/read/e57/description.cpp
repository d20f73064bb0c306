#include "preprocess/read/e57/description.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "preprocess/read/e57/parse_number.h"
#include "preprocess/read/e57/prototype_field.h"
#include "preprocess/read/e57/xml_stream.h"

namespace splatray {
namespace {

constexpr std::uint64_t MOST_RECORDS = std::uint64_t{1} << 47U;  ///< sums over all scans stay in 64 bits

/// Depths of the path e57Root/data3D/vectorChild/points/prototype/FIELD.
constexpr std::size_t SCAN_DEPTH = 3;
constexpr std::size_t FIELD_DEPTH = 6;

/// Collects scans while the XML goes by.
class DescriptionReader : public XmlReceiver {
 public:
  explicit DescriptionReader(const std::filesystem::path& path) : path_(path) {}

  void begin(const XmlPath& at, const XmlAttributes& attributes) override {
    if (!is_in_scan(at)) return;
    if (at.size() == SCAN_DEPTH) {
      if (scans_.size() == E57_MOST_SCANS)
        throw_unreadable(
            path_, "found more than " + std::to_string(E57_MOST_SCANS) + " scans, expected at most that");
      scans_.emplace_back();
      quaternion_ = {};
    } else if (at[SCAN_DEPTH] == "points") {
      begin_points(at, attributes);
    } else {
      // Limits are written as their fields are, so some are scaled integers.
      number_type_ = attributes.value("type") == "ScaledInteger"
                         ? prototype_field(at.back(), attributes, path_)
                         : E57Field{};
    }
  }

  void end(const XmlPath& at, const std::string& text) override {
    if (at.size() == 2 && at[0] == "e57Root" && at[1] == "coordinateMetadata") crs_ = trimmed(text);
    if (at.size() == 2 && at[0] == "e57Root" && at[1] == "e57LibraryVersion") library_ = trimmed(text);
    if (!is_in_scan(at)) return;
    if (at.size() == SCAN_DEPTH) {
      end_scan();
    } else if (at[SCAN_DEPTH] == "pose" && at.size() == SCAN_DEPTH + 3) {
      set_pose(at[SCAN_DEPTH + 1], at[SCAN_DEPTH + 2], text);
    } else if (at.size() == SCAN_DEPTH + 1 && at[SCAN_DEPTH] == "name") {
      scans_.back().name = trimmed(text);
    } else if (at.size() == SCAN_DEPTH + 2) {
      set_bound(at[SCAN_DEPTH], at[SCAN_DEPTH + 1], text);
    }
  }

  E57Description take() {
    const bool differ = std::any_of(scans_.begin(), scans_.end(), [&](const E57Scan& scan) {
      return scan.translation != scans_.front().translation;
    });
    for (E57Scan& scan : scans_) scan.is_shifted_alone = differ;
    return {std::move(scans_), std::move(crs_), std::move(library_)};
  }

 private:
  static bool is_in_scan(const XmlPath& at) {
    return at.size() >= SCAN_DEPTH && at[0] == "e57Root" && at[1] == "data3D";
  }

  void begin_points(const XmlPath& at, const XmlAttributes& attributes) {
    E57Scan& scan = scans_.back();
    if (at.size() == SCAN_DEPTH + 1) {
      scan.physical_offset = count_of(attributes, "fileOffset");
      scan.records = count_of(attributes, "recordCount");
      if (scan.records > MOST_RECORDS)
        throw_unreadable(path_,
                         "found recordCount " + std::to_string(scan.records) + ", expected at most 2^47");
    } else if (at[SCAN_DEPTH + 1] == "prototype" && at.size() >= FIELD_DEPTH) {
      if (at.size() > FIELD_DEPTH)
        throw_unreadable(path_, "found fields within the field '" + at[FIELD_DEPTH - 1] +
                                    "' of a prototype, expected a flat record");
      scan.fields.push_back(prototype_field(at.back(), attributes, path_));
    } else if (at[SCAN_DEPTH + 1] == "codecs" && at.size() == SCAN_DEPTH + 4 && at.back() != "inputs" &&
               at.back() != "bitPackCodec") {
      throw_unreadable(path_, "found points packed with '" + at.back() + "', expected bitPackCodec");
    }
  }

  [[nodiscard]] std::uint64_t count_of(const XmlAttributes& attributes, const std::string& name) const {
    const std::string text = attributes.value(name);
    const std::optional<std::uint64_t> count = parse_number<std::uint64_t>(text);
    if (!count) throw_unreadable(path_, "found " + name + " '" + text + "', expected a whole number");
    return *count;
  }

  /// The number that the element is which ends, nullopt where it is none. Without text it is 0 by the standard.
  [[nodiscard]] std::optional<double> number_of(const std::string& text) const {
    const std::optional<double> number = trimmed(text).empty() ? 0.0 : parse_number<double>(text);
    if (!number) return std::nullopt;
    const double scaled = *number * number_type_.scale + number_type_.offset;
    return std::isfinite(scaled) ? std::optional(scaled) : std::nullopt;
  }

  void set_pose(const std::string& part, const std::string& axis, const std::string& text) {
    const std::size_t i = std::string_view("xyzw").find(axis);
    if (axis.size() != 1 || i == std::string_view::npos) return;
    const std::optional<double> number = number_of(text);
    if (!number) throw_unreadable(path_, "found " + axis + " '" + text + "' in a pose, expected a number");
    if (part == "rotation") quaternion_.at(i) = *number;
    if (part == "translation" && i < 3) scans_.back().translation[static_cast<int>(i)] = *number;
  }

  void set_bound(const std::string& structure, const std::string& name, const std::string& text) {
    E57Scan& scan = scans_.back();
    const std::optional<double> value = number_of(text);
    if (structure == "indexBounds" && value && *value >= 0.0 && *value < 4294967296.0) {
      if (name == "rowMaximum") scan.row_maximum = static_cast<std::uint64_t>(*value);
      if (name == "columnMaximum") scan.column_maximum = static_cast<std::uint64_t>(*value);
    } else if (structure == "colorLimits") {
      static const std::array<std::string, 3> CHANNELS = {"colorRed", "colorGreen", "colorBlue"};
      for (std::size_t i = 0; i < CHANNELS.size(); ++i) {
        if (name == CHANNELS.at(i) + "Minimum") scan.color_limits.at(i).minimum = value;
        if (name == CHANNELS.at(i) + "Maximum") scan.color_limits.at(i).maximum = value;
      }
    }
  }

  void end_scan() {
    const glm::dquat rotation(quaternion_[3], quaternion_[0], quaternion_[1], quaternion_[2]);
    const double length = glm::length(rotation);
    if (length > 1e-9 && std::isfinite(length)) scans_.back().rotation = rotation / length;
  }

  const std::filesystem::path& path_;
  std::vector<E57Scan> scans_;
  std::string crs_, library_;
  E57Field number_type_;  ///< of the innermost element that began: its scale and offset
  /// x, y, z, w of the scan that is being read; all zero where there is none.
  std::array<double, 4> quaternion_{};
};

}  // namespace

E57Description read_e57_description(PagedFile& file) {
  const E57Header& header = file.header();
  const std::uint64_t begin = file.content_offset(header.xml_physical_offset, "the XML section");
  if (begin > file.size() || header.xml_bytes > file.size() - begin)
    throw_unreadable(
        file.path(),
        "found " + std::to_string(file.physical_size()) + " bytes, expected " +
            std::to_string(header.file_bytes) +
            ": the file is cut off, and with it the XML section without which no scan can be read");
  DescriptionReader reader(file.path());
  file.seek(begin);
  stream_xml(file, header.xml_bytes, reader);
  return reader.take();
}

}  // namespace splatray
