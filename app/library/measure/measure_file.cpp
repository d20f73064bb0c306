#include "app/library/measure/measure_file.h"

#include <nlohmann/json.hpp>

#include "app/library/codec/dxf.h"
#include "app/library/codec/json_file.h"
#include "app/library/codec/json_vector.h"
#include "app/library/request/value_text.h"
#include "engine/base/crs.h"
#include "engine/base/error.h"
#include "engine/base/json_text.h"
#include "engine/base/utf8.h"
#include "engine/file/atomic_file.h"
#include "preprocess/base/file_extension.h"

namespace splatray {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* MEASURES_LAYER = "MEASURES";

Json geometry_of(const Measure& measure) {
  Json places = Json::array();
  for (const SurfacePoint& point : measure.points) places.push_back(json_vector(point.place));
  if (measure.points.size() == 1) return {{"type", "Point"}, {"coordinates", places[0]}};
  if (!is_outline(measure.kind)) return {{"type", "LineString"}, {"coordinates", places}};
  places.push_back(places[0]);
  return {{"type", "Polygon"}, {"coordinates", Json::array({places})}};
}

/// The number that a text says.
Json number_of(const std::string& text) { return Json::parse(text); }

Json properties_of(const Measure& measure, std::size_t id, const MeasureFrame& frame) {
  Json properties{{"id", id}, {"name", measure.name}, {"kind", measure_name(measure.kind)}};
  for (const MeasureValue& value : values_of(measure, frame.up)) {
    const ValueWords words = value_words(value, unit_metres(frame));
    properties[value.name] = number_of(words.value);
    if (!words.within.empty()) properties[value.name + "_within_95"] = number_of(words.within);
    properties[value.name + "_unit"] = words.unit;
  }
  Json errors = Json::array(), sideways = Json::array();
  for (const SurfacePoint& point : measure.points) {
    errors.push_back(json_vector(point.error));
    sideways.push_back(json_vector(point.sideways));
  }
  if (const std::optional<VolumeFound>& found = measure.volume)
    properties["volume_found"] = {{"cut", found->cut},
                                  {"fill", found->fill},
                                  {"cut_within", found->cut_within},
                                  {"fill_within", found->fill_within},
                                  {"net_within", found->net_within},
                                  {"covered", found->area},
                                  {"uncovered", found->uncovered}};
  properties["errors"] = errors;
  properties["errors_sideways"] = sideways;
  if (measure.plane) {
    properties["normal"] = json_vector(measure.plane->normal);
    properties["turn_error"] = measure.plane->turn_error;
    properties["fitted_residual"] = measure.plane->residual;
    properties["middle"] = json_vector(measure.plane->middle);
    properties["fitted_points"] = measure.plane->points;
  }
  if (!measure.fit) return properties;
  properties["fitted_radius"] = measure.fit->radius;
  properties["radius_error"] = measure.fit->radius_error;
  properties["fitted_residual"] = measure.fit->residual;
  properties["center"] = json_vector(measure.fit->center);
  properties["axis"] = json_vector(measure.fit->axis);
  properties["fitted_points"] = measure.fit->points;
  return properties;
}

double letter_height(std::span<const Measure> measures) {
  double longest = 0.0;
  for (const Measure& measure : measures)
    for (const SurfacePoint& point : measure.points)
      longest = std::max(longest, glm::distance(point.place, measure.points.front().place));
  constexpr double SHARE = 0.03;
  return longest > 0.0 ? SHARE * longest : SHARE;
}

/// A vector of three numbers, or a place of two at height 0.
glm::dvec3 vector_of(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(),
          json.size() > 2 ? json.at(2).get<double>() : 0.0};
}

/// A property; null where there is none. Some programs keep lists and objects as texts of JSON.
Json property(const Json& feature, const char* name) {
  const Json& properties = feature.at("properties");
  if (!properties.is_object() || !properties.contains(name)) return nullptr;
  const Json& value = properties.at(name);
  const std::string text = value.is_string() ? value.get<std::string>() : std::string();
  return text.starts_with('[') || text.starts_with('{') ? Json::parse(text) : value;
}

struct Geometry {
  std::string type;  ///< of one part: Point, LineString or Polygon
  Json places;       ///< a list, a polygon's last place not as its first
};

Geometry geometry_in(const Json& feature) {
  constexpr std::string_view MULTI = "Multi";
  const Json& geometry = feature.at("geometry");
  Geometry found{geometry.at("type"), geometry.at("coordinates")};
  if (found.type.starts_with(MULTI)) {
    if (found.places.size() != 1)
      throw Expected{"one part in each, not " + std::to_string(found.places.size())};
    found.type.erase(0, MULTI.size());
    found.places = Json(found.places.at(0));
  }
  if (found.type == "Point") found.places = Json::array({found.places});
  if (found.type != "Polygon") return found;
  found.places = Json(found.places.at(0));
  if (!found.places.empty()) found.places.erase(found.places.size() - 1);
  return found;
}

/// The kind that a feature names.
std::optional<MeasureKind> named_kind(const Json& feature) {
  const Json name = property(feature, "kind");
  if (name.is_null()) return {};
  if (const std::optional<MeasureKind> kind = measure_kind(name)) return kind;
  throw Expected{"a kind that splatray-measure has, not '" + name.get<std::string>() + "'"};
}

MeasureKind kind_of_geometry(const std::string& geometry) {
  if (geometry == "Polygon") return MeasureKind::area;
  if (geometry == "LineString") return MeasureKind::distance;
  if (geometry == "Point") return MeasureKind::point;
  throw Expected{"a point, a line or a polygon, not '" + geometry + "'"};
}

Measure measure_of(const Json& feature) {
  const std::optional<MeasureKind> kind = named_kind(feature);
  const Geometry geometry = geometry_in(feature);
  Measure measure{kind ? *kind : kind_of_geometry(geometry.type), {}};
  const Json name = property(feature, "name"), errors = property(feature, "errors"),
             sideways = property(feature, "errors_sideways");
  if (name.is_string()) measure.name = to_utf8(name.get<std::string>());
  for (std::size_t i = 0; i < geometry.places.size(); ++i)
    measure.points.push_back({vector_of(geometry.places[i]),
                              errors.is_null() ? glm::dvec3(0.0) : vector_of(errors.at(i)),
                              sideways.is_null() ? glm::dvec3(0.0) : vector_of(sideways.at(i))});
  if (measure.kind == MeasureKind::plane && !property(feature, "normal").is_null())
    measure.plane = PlaneFit{vector_of(property(feature, "middle")), vector_of(property(feature, "normal")),
                             property(feature, "fitted_residual"), property(feature, "turn_error"),
                             property(feature, "fitted_points")};
  if (const Json found = property(feature, "volume_found"); found.is_object())
    measure.volume = VolumeFound{found.at("cut"),         found.at("fill"),       found.at("cut_within"),
                                 found.at("fill_within"), found.at("net_within"), found.at("covered"),
                                 found.at("uncovered")};
  const Json center = property(feature, "center");
  if (center.is_null()) return measure;
  const auto number = [&feature](const char* first, const char* old) {
    const Json value = property(feature, first);
    return value.is_null() ? property(feature, old) : value;
  };
  measure.fit = RadiusFit{number("fitted_radius", "radius"),     property(feature, "radius_error"),
                          number("fitted_residual", "residual"), vector_of(center),
                          vector_of(property(feature, "axis")),  property(feature, "fitted_points")};
  return measure;
}

/// The system that a collection names; empty where it names none.
std::string crs_of(const Json& collection) {
  if (!collection.contains("crs") || !collection["crs"].is_object()) return {};
  const std::string name = collection["crs"].at("properties").at("name");
  constexpr std::string_view EPSG = "urn:ogc:def:crs:EPSG:";
  if (name.ends_with("CRS84")) return "EPSG:4326";  // but for the order of its axes
  return name.starts_with(EPSG) ? "EPSG:" + name.substr(name.rfind(':') + 1) : name;
}

}  // namespace

std::string geojson_text(std::span<const Measure> measures, const MeasureFrame& frame) {
  Json features = Json::array();
  for (std::size_t i = 0; i < measures.size(); ++i)
    features.push_back({{"type", "Feature"},
                        {"properties", properties_of(measures[i], i + 1, frame)},
                        {"geometry", geometry_of(measures[i])}});
  Json collection{{"type", "FeatureCollection"}};
  if (const Crs crs = describe_crs(frame.crs); !frame.crs.empty()) {
    const std::string name = crs.epsg > 0 ? "urn:ogc:def:crs:EPSG::" + std::to_string(crs.epsg) : crs.name;
    collection["crs"] = {{"type", "name"}, {"properties", {{"name", name}}}};
  }
  collection["up"] = json_vector(frame.up);
  collection["features"] = features;
  return json_text(collection, 1) + "\n";
}

std::string dxf_text(std::span<const Measure> measures, const MeasureFrame& frame) {
  DxfWriter dxf(unit_metres(frame), {{MEASURES_LAYER}});
  const double height = letter_height(measures);
  for (const Measure& measure : measures) {
    const std::vector<SurfacePoint>& points = measure.points;
    glm::dvec3 middle(0.0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      middle += points[i].place / static_cast<double>(points.size());
      dxf.point(MEASURES_LAYER, points[i].place);
      if (i > 0) dxf.line(MEASURES_LAYER, points[i - 1].place, points[i].place);
    }
    if (is_outline(measure.kind) && points.size() > 2)
      dxf.line(MEASURES_LAYER, points.back().place, points.front().place);
    if (measure.fit) dxf.circle(MEASURES_LAYER, measure.fit->center, measure.fit->radius, measure.fit->axis);
    dxf.text(MEASURES_LAYER, middle, height, labelled_text(measure, frame));
  }
  return dxf.str();
}

void require_measures_name(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  if (extension != ".geojson" && extension != ".dxf" && extension != ".csv")
    throw Error(ExitCode::usage,
                "found output '" + path.string() + "', expected a name ending in .geojson, .dxf or .csv");
}

void write_measures(std::span<const Measure> measures, const MeasureFrame& frame,
                    const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  if (extension == ".geojson") return write_text_file(geojson_text(measures, frame), path);
  if (extension == ".dxf") return write_text_file(dxf_text(measures, frame), path);
  if (extension == ".csv") return write_text_file(csv_text(measures, frame), path);
  require_measures_name(path);
}

std::vector<Measure> read_measures(const std::filesystem::path& path, const std::string& crs) {
  const auto refuse = [&path](const std::string& found, const std::string& expected) {
    throw Error(ExitCode::input_unreadable,
                "cannot read measures '" + path.string() + "': found " + found + ", expected " + expected);
  };
  const Json collection = read_json_file(path, refuse);
  const std::string expected = "a .geojson of measures";
  if (!collection.is_object() || !collection.contains("features") || !collection["features"].is_array())
    refuse("no list 'features'", expected);
  try {
    const std::string named = crs_of(collection);
    const unsigned found = describe_crs(named).epsg, wanted = describe_crs(crs).epsg;
    if (found > 0 && wanted > 0 && found != wanted)
      refuse("coordinates in EPSG:" + std::to_string(found),
             "those of the scan, in EPSG:" + std::to_string(wanted));
  } catch (const Json::exception&) {
    refuse("a member 'crs' without a name", expected);
  }
  std::vector<Measure> measures;
  for (const Json& feature : collection["features"]) {
    const std::string name = "feature " + std::to_string(measures.size() + 1);
    try {
      measures.push_back(measure_of(feature));
    } catch (const Expected& other) {
      refuse(name + " of another kind", other.what);
    } catch (const Json::exception&) {
      refuse(name + " without all that a measure has", expected);
    }
  }
  return measures;
}

}  // namespace splatray
