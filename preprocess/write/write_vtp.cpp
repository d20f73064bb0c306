#include <algorithm>
#include <map>

#include "preprocess/base/splat_marks.h"
#include "preprocess/write/point_output.h"

namespace splatray {
namespace {

/// An array of one or three values a point.
struct VtpArray {
  std::string name;
  ValueType type;
  std::vector<std::function<double(std::size_t)>> parts;
};

/// The properties, with those of a normal and of a colour together.
std::vector<VtpArray> point_arrays(const std::vector<PointProperty>& properties) {
  std::vector<VtpArray> arrays;
  for (const PointProperty& property : properties) {
    const bool is_more =
        property.name == "ny" || property.name == "nz" || property.name == "green" || property.name == "blue";
    const std::string name = property.name == "nx"    ? "Normals"
                             : property.name == "red" ? "RGB"
                                                      : property.name;
    if (!is_more) arrays.push_back({name, property.type, {}});
    arrays.back().parts.push_back(property.value);
  }
  return arrays;
}

/// The header's lines of arrays, and where each lies in the bytes behind it.
class ArrayLines {
 public:
  explicit ArrayLines(std::size_t points) : points_(points) {}

  [[nodiscard]] std::string line(const VtpArray& array) {
    const char* const TYPES[] = {"UInt8", "UInt16", "UInt32", "Float32", "Float64"};
    const std::string text = std::string("<DataArray type=\"") + TYPES[static_cast<std::size_t>(array.type)] +
                             "\" Name=\"" + array.name + "\" NumberOfComponents=\"" +
                             std::to_string(array.parts.size()) + "\" format=\"appended\" offset=\"" +
                             std::to_string(offset_) + "\"/>\n";
    offset_ += sizeof(std::uint64_t) + bytes(array);
    return text;
  }
  [[nodiscard]] std::uint64_t bytes(const VtpArray& array) const {
    return points_ * array.parts.size() * bytes_of(array.type);
  }

 private:
  std::uint64_t points_;
  std::uint64_t offset_ = 0;
};

/// The marks as lists of texts by their keys, letters as numbers, as VTK has them in ASCII: none ends the XML.
std::string field_data(const std::vector<SplatMark>& marks) {
  std::map<std::string, std::vector<std::string>> lists;
  for (const SplatMark& mark : marks) lists[mark.key].push_back(mark.text);
  std::string xml = "<FieldData>\n";
  for (const auto& [key, texts] : lists) {
    xml += "<Array type=\"String\" Name=\"" + key + "\" NumberOfTuples=\"" + std::to_string(texts.size()) +
           "\" format=\"ascii\">\n";
    for (const std::string& text : texts) {
      for (const unsigned char letter : text) xml += std::to_string(letter) + ' ';
      xml += "0\n";
    }
    xml += "</Array>\n";
  }
  return xml + "</FieldData>\n";
}

}  // namespace

void write_vtp(const PointTable& table, PointOutput& out) {
  VtpArray places{"Points", ValueType::float64, {}};
  for (int axis = 0; axis < 3; ++axis)
    places.parts.emplace_back([&table, axis](std::size_t i) { return table.position(i)[axis]; });
  std::vector<VtpArray> arrays = {
      places,
      {"connectivity", ValueType::uint32, {[](std::size_t i) { return double(i); }}},
      {"offsets", ValueType::uint32, {[](std::size_t i) { return double(i + 1); }}}};
  std::vector<PointProperty> properties = table.properties;
  properties.insert(properties.end(), table.words.begin(), table.words.end());
  const std::vector<VtpArray> data = point_arrays(properties);
  arrays.insert(arrays.end(), data.begin(), data.end());
  const std::string count = std::to_string(table.size);
  ArrayLines lines(table.size);
  std::string header =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n" +
      field_data(splat_marks(table.scene, table.splats_alone)) + "<Piece NumberOfPoints=\"" + count +
      "\" NumberOfVerts=\"" + count +
      "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<Points>\n";
  header += lines.line(arrays[0]) + "</Points>\n<Verts>\n";
  header += lines.line(arrays[1]) + lines.line(arrays[2]) + "</Verts>\n<PointData Normals=\"Normals\"";
  const bool has_colors =
      std::any_of(data.begin(), data.end(), [](const VtpArray& array) { return array.name == "RGB"; });
  header += has_colors ? " Scalars=\"RGB\">\n" : ">\n";
  for (const VtpArray& array : data) header += lines.line(array);
  out.write(header + "</PointData>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_");
  const auto share = [&](std::size_t n) {
    return static_cast<double>(n) / static_cast<double>(arrays.size());
  };
  for (std::size_t n = 0; n < arrays.size(); ++n) {
    const std::uint64_t bytes = lines.bytes(arrays[n]);
    out.write({reinterpret_cast<const char*>(&bytes), sizeof bytes});
    out.write_rows(
        [&, &array = arrays[n]](std::size_t i, std::string& row) {
          for (const auto& part : array.parts) append_value(array.type, part(i), row);
        },
        share(n), share(n + 1));
  }
  out.write("\n</AppendedData>\n</VTKFile>\n");
}

}  // namespace splatray
