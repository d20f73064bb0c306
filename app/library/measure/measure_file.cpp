#include "app/library/measure/measure_file.h"

#include <nlohmann/json.hpp>

#include "app/library/codec/dxf.h"
#include "app/library/codec/json_file.h"
#include "app/library/codec/json_vector.h"
#include "app/library/request/value_text.h"
#include "engine/base/crs.h"
#include "engine/base/error.h"
#include "engine/base/json_text.h"
#include "engine/base/number_text.h"
#include "engine/file/atomic_file.h"
#include "preprocess/base/file_extension.h"

namespace splatray {
namespace {

using Json = nlohmann::ordered_json;

const char* unit_name(MeasureUnit unit) {
  return unit == MeasureUnit::degrees ? "degree" : (unit == MeasureUnit::area ? "unit^2" : "unit");
}

Json geometry_of(const Measure& measure) {
  Json places = Json::array();
  for (const SurfacePoint& point : measure.points) places.push_back(json_vector(point.place));
  if (measure.points.size() == 1) return {{"type", "Point"}, {"coordinates", places[0]}};
  if (measure.kind != MeasureKind::area) return {{"type", "LineString"}, {"coordinates", places}};
  places.push_back(places[0]);
  return {{"type", "Polygon"}, {"coordinates", Json::array({places})}};
}

Json properties_of(const Measure& measure, const glm::dvec3& up) {
  Json properties{{"kind", measure_name(measure.kind)}};
  for (const MeasureValue& value : values_of(measure, up)) {
    properties[value.name] = value.value;
    properties[value.name + "_within_95"] = value.within;
  }
  Json errors = Json::array(), sideways = Json::array();
  for (const SurfacePoint& point : measure.points) {
    errors.push_back(json_vector(point.error));
    sideways.push_back(json_vector(point.sideways));
  }
  properties["errors"] = errors;
  properties["errors_sideways"] = sideways;
  if (!measure.fit) return properties;
  properties["radius_error"] = measure.fit->radius_error;
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

glm::dvec3 vector_of(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

Measure measure_of(const Json& feature) {
  const Json& properties = feature.at("properties");
  const Json& geometry = feature.at("geometry");
  const std::string name = properties.at("kind");
  const std::optional<MeasureKind> kind = measure_kind(name);
  if (!kind) throw Expected{"a kind that splatray-measure has, not '" + name + "'"};
  Measure measure{*kind, {}};
  Json places = geometry.at("coordinates");
  if (geometry.at("type") == "Point") places = Json::array({places});
  if (geometry.at("type") == "Polygon") {
    places = Json(places.at(0));
    if (!places.empty()) places.erase(places.size() - 1);
  }
  const bool has_sideways = properties.contains("errors_sideways");  // files of older versions have none
  for (std::size_t i = 0; i < places.size(); ++i)
    measure.points.push_back(
        {vector_of(places[i]), vector_of(properties.at("errors").at(i)),
         has_sideways ? vector_of(properties.at("errors_sideways").at(i)) : glm::dvec3(0.0)});
  if (!properties.contains("center")) return measure;
  measure.fit = RadiusFit{properties.at("radius"),          properties.at("radius_error"),
                          properties.at("residual"),        vector_of(properties.at("center")),
                          vector_of(properties.at("axis")), properties.at("fitted_points")};
  return measure;
}

}  // namespace

std::string geojson_text(std::span<const Measure> measures, const MeasureFrame& frame) {
  Json features = Json::array();
  for (const Measure& measure : measures)
    features.push_back({{"type", "Feature"},
                        {"properties", properties_of(measure, frame.up)},
                        {"geometry", geometry_of(measure)}});
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
  std::vector<DxfLayer> layers;
  for (int kind = 0; kind < MEASURE_KINDS; ++kind)
    layers.push_back({measure_name(static_cast<MeasureKind>(kind))});
  DxfWriter dxf(describe_crs(frame.crs).horizontal_metres, layers);
  const double height = letter_height(measures);
  for (const Measure& measure : measures) {
    const char* layer = measure_name(measure.kind);
    const std::vector<SurfacePoint>& points = measure.points;
    glm::dvec3 middle(0.0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      middle += points[i].place / static_cast<double>(points.size());
      dxf.point(layer, points[i].place);
      if (i > 0) dxf.line(layer, points[i - 1].place, points[i].place);
    }
    if (measure.kind == MeasureKind::area && points.size() > 2)
      dxf.line(layer, points.back().place, points.front().place);
    if (measure.fit) dxf.circle(layer, measure.fit->center, measure.fit->radius, measure.fit->axis);
    dxf.text(layer, middle, height, short_text(measure, frame.up));
  }
  return dxf.str();
}

std::string csv_text(std::span<const Measure> measures, const MeasureFrame& frame) {
  std::string text = "number,kind,name,value,within_95,unit\n";
  for (std::size_t i = 0; i < measures.size(); ++i)
    for (const MeasureValue& value : values_of(measures[i], frame.up))
      text += std::to_string(i + 1) + "," + measure_name(measures[i].kind) + "," + value.name + "," +
              number_text(value.value) + "," + number_text(value.within) + "," + unit_name(value.unit) + "\n";
  return text;
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

std::vector<Measure> read_measures(const std::filesystem::path& path) {
  const auto refuse = [&path](const std::string& found, const std::string& expected) {
    throw Error(ExitCode::input_unreadable,
                "cannot read measures '" + path.string() + "': found " + found + ", expected " + expected);
  };
  const Json collection = read_json_file(path, refuse);
  const std::string expected = "a .geojson of splatray-measure";
  if (!collection.is_object() || !collection.contains("features") || !collection["features"].is_array())
    refuse("no list 'features'", expected);
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
