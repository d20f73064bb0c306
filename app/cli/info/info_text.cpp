#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/cli/info/file_info.h"
#include "app/library/attributes.h"
#include "engine/base/crs.h"
#include "engine/base/json_text.h"
#include "engine/base/length_unit.h"
#include "engine/base/number_text.h"
#include "engine/base/one_line.h"
#include "engine/base/utf8.h"
#include "preprocess/base/counted_list.h"

namespace splatray {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t SHOWN_PARTS = 20;  // scans and objects, of which a file may have thousands

std::string short_text(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.10g", value);
  return text.data();
}

std::string grouped(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, 1, ' ');
  return text;
}

/// Lines of a name and a text, the texts below one another.
class Lines {
 public:
  void add(const std::string& name, const std::string& text) {
    constexpr std::size_t WIDTH = 14;
    text_ +=
        "  " + name + std::string(name.size() < WIDTH ? WIDTH - name.size() : 1, ' ') + one_line(text) + '\n';
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string crs_text(const std::string& text) {
  if (text.empty()) return "not named";
  const Crs crs = describe_crs(text);
  std::string line = crs.name.empty() ? text : crs.name;
  const std::string number = "EPSG:" + std::to_string(crs.epsg);
  if (crs.epsg != 0 && line != number) line += " (" + number + ")";
  if (crs.is_degrees) line += "; x and y are degrees";
  if (crs.horizontal_metres > 0.0) line += "; x and y in " + length_name(crs.horizontal_metres);
  if (crs.vertical_metres > 0.0) line += "; z in " + length_name(crs.vertical_metres);
  return line;
}

/// What reading left out of a scan; empty where it left out nothing.
std::string left_out(const ScanCounts& counts) {
  const std::pair<std::uint64_t, const char*> lost[] = {{counts.withheld, "withheld"},
                                                        {counts.noise, "of the classes of noise"},
                                                        {counts.no_return, "without a position"},
                                                        {counts.missing, "missing or damaged"}};
  return counted_list(lost);
}

std::string box_text(const Bounds& box) {
  std::string text;
  for (int axis = 0; axis < 3; ++axis)
    text += (axis > 0 ? std::string(", ") : "") + "xyz"[axis] + " " + short_text(box.low[axis]) + " to " +
            short_text(box.high[axis]);
  const glm::dvec3 size = box.high - box.low;
  return text + "; " + short_text(size.x) + " x " + short_text(size.y) + " x " + short_text(size.z);
}

std::string place_text(const glm::dvec3& place) {
  return short_text(place.x) + ' ' + short_text(place.y) + ' ' + short_text(place.z);
}

std::string part_text(const PartInfo& part, bool counted) {
  std::string text = part.name.empty() ? "without a name" : "'" + part.name + "'";
  if (counted) text += ": " + grouped(part.points) + " points";
  if (part.triangles > 0) text += ", " + grouped(part.triangles) + " triangles";
  if (!part.station) return text;
  const Station& station = *part.station;
  if (station.sensor_world) text += ", from " + place_text(*station.sensor_world);
  if (station.rows > 0)
    text += ", grid of " + std::to_string(station.rows) + " x " + std::to_string(station.columns);
  if (station.noise_world > 0.0) text += ", noise " + short_text(station.noise_world);
  if (station.step_world > 0.0) text += ", steps of " + short_text(station.step_world);
  return text;
}

void add_parts(const std::string& name, const std::vector<PartInfo>& parts, bool counted, Lines& lines) {
  for (std::size_t i = 0; i < std::min(parts.size(), SHOWN_PARTS); ++i)
    lines.add(i == 0 ? name : "", part_text(parts[i], counted));
  if (parts.size() > SHOWN_PARTS) lines.add("", "and " + grouped(parts.size() - SHOWN_PARTS) + " more");
}

Json parts_json(const std::vector<PartInfo>& parts, bool counted) {
  Json list = Json::array();
  for (const PartInfo& part : parts) {
    Json json = {{"name", part.name}};
    if (counted) json["points"] = part.points;
    if (part.triangles > 0) json["triangles"] = part.triangles;
    if (part.station) {
      const Station& station = *part.station;
      if (station.sensor_world)
        json["sensor"] = {station.sensor_world->x, station.sensor_world->y, station.sensor_world->z};
      if (station.rows > 0) json["grid"] = {station.rows, station.columns};
      if (station.noise_world > 0.0) json["noise"] = station.noise_world;
      if (station.step_world > 0.0) json["step"] = station.step_world;
    }
    list.push_back(std::move(json));
  }
  return list;
}

Json crs_json(const std::string& text) {
  if (text.empty()) return nullptr;
  const Crs crs = describe_crs(text);
  Json json = {{"text", text}, {"name", crs.name}};
  if (crs.epsg != 0) json["epsg"] = crs.epsg;
  if (crs.is_degrees) json["degrees"] = true;
  if (crs.horizontal_metres > 0.0) json["horizontal_metres"] = crs.horizontal_metres;
  if (crs.vertical_metres > 0.0) json["vertical_metres"] = crs.vertical_metres;
  return json;
}

Json file_json(const FileInfo& info) {
  Json json = {{"file", path_text(info.path)}, {"points", info.points}, {"triangles", info.triangles}};
  json["from_head"] = info.from_head;
  const auto& [low, high] = info.box;
  if (low.x <= high.x)
    json["box"] = Json::array({Json::array({low.x, low.y, low.z}), Json::array({high.x, high.y, high.z})});
  else
    json["box"] = nullptr;
  json["crs"] = crs_json(info.crs);
  json["head"] = Json::object();
  for (const FileFact& fact : info.facts) json["head"][fact.name] = fact.text;
  json["left_out"] = {{"withheld", info.counts.withheld},
                      {"noise", info.counts.noise},
                      {"no_return", info.counts.no_return},
                      {"missing", info.counts.missing}};
  json["attributes"] = Json::object();
  for (const AttributeInfo& attribute : info.attributes)
    json["attributes"][attribute.name] = {
        {"type", attribute.type}, {"low", attribute.low}, {"high", attribute.high}};
  json["classes"] = Json::object();
  for (const auto& [value, count] : info.classes) json["classes"][std::to_string(value)] = count;
  json["scans"] = parts_json(info.scans, !info.from_head);
  json["objects"] = parts_json(info.objects, true);
  json["lights"] = info.lights;
  json["camera"] = info.has_camera;
  json["notes"] = info.notes;
  return json;
}

}  // namespace

std::string info_text(const FileInfo& info) {
  Lines lines;
  for (const FileFact& fact : info.facts) lines.add(fact.name, fact.text);
  lines.add("points", grouped(info.points) + (info.from_head ? ", as the head says" : ""));
  if (info.triangles > 0) lines.add("triangles", grouped(info.triangles));
  if (const std::string lost = left_out(info.counts); !lost.empty()) lines.add("left out", lost);
  if (info.box.low.x <= info.box.high.x) lines.add("box", box_text(info.box));
  lines.add("coordinates", crs_text(info.crs));
  for (const AttributeInfo& attribute : info.attributes)
    lines.add(attribute.name,
              attribute.name == "normal"
                  ? "of length " + short_text(attribute.low) + " to " + short_text(attribute.high)
                  : short_text(attribute.low) + " to " + short_text(attribute.high) + ", " + attribute.type);
  for (const auto& [value, count] : info.classes) {
    const std::string name = class_name(value);
    lines.add("class " + std::to_string(value), grouped(count) + (name.empty() ? "" : " " + name));
  }
  add_parts("scans", info.scans, !info.from_head, lines);
  add_parts("objects", info.objects, true, lines);
  if (info.lights > 0) lines.add("lights", std::to_string(info.lights));
  if (info.has_camera) lines.add("camera", "yes");
  return one_line(info.path.string()) + '\n' + lines.text();
}

std::string info_json(const std::vector<FileInfo>& infos) {
  Json list = Json::array();
  for (const FileInfo& info : infos) list.push_back(file_json(info));
  return json_text(list, 2);
}

}  // namespace splatray
