// Values of measures, how errors propagate to them, and the files they are kept in.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/library/codec/dxf.h"
#include "app/library/measure/measure_file.h"
#include "app/library/measure/measure_text.h"
#include "app/library/measure/measure_words.h"
#include "app/library/measure/surface_point.h"
#include "app/library/picture/measuring.h"
#include "app/library/request/value_text.h"
#include "data/shapes.h"
#include "engine/base/error.h"
#include "tests/scan_sim/built_scan.h"
#include "tests/temp_folder.h"
#include "tests/trace/scenes.h"

namespace splatray {
namespace {

const glm::dvec3 UP(0.0, 0.0, 1.0);
const glm::dvec3 FAR_AWAY(431250.0, 5412360.0, 217.0);

Measure measure_of(MeasureKind kind, const std::vector<glm::dvec3>& places,
                   const glm::dvec3& error = glm::dvec3(0.0)) {
  Measure measure{kind, {}};
  for (const glm::dvec3& place : places) measure.points.push_back({FAR_AWAY + place, error});
  return measure;
}

double value_of(const Measure& measure, const std::string& name) {
  for (const MeasureValue& value : values_of(measure, UP))
    if (value.name == name) return value.value;
  return std::nan("");
}

TEST(Measures, AreThoseOfGeometryAtLargeCoordinates) {
  const Measure path = measure_of(MeasureKind::distance, {{0, 0, 0}, {3, 0, 0}, {3, 4, 12}});
  EXPECT_NEAR(value_of(path, "distance"), 3.0 + std::sqrt(160.0), 1e-8);
  EXPECT_NEAR(value_of(path, "straight"), 13.0, 1e-8);
  EXPECT_NEAR(value_of(path, "horizontal"), 5.0, 1e-8);
  EXPECT_NEAR(value_of(path, "vertical"), 12.0, 1e-8);
  const std::vector<glm::dvec3> ends = {{0, 0, 5}, {9, 12, 2}};
  EXPECT_NEAR(values_of(measure_of(MeasureKind::vertical, ends), UP).front().value, -3.0, 1e-8);
  EXPECT_NEAR(values_of(measure_of(MeasureKind::horizontal, ends), UP).front().value, 15.0, 1e-8);
  EXPECT_NEAR(value_of(measure_of(MeasureKind::angle, {{1, 0, 0}, {0, 0, 0}, {0, 0, 2}}), "angle"), 90.0,
              1e-6);
  const Measure square = measure_of(MeasureKind::area, {{0, 0, 0}, {2, 0, 0}, {2, 2, 2}, {0, 2, 2}});
  EXPECT_NEAR(value_of(square, "area"), 4.0 * std::sqrt(2.0), 1e-7);
  EXPECT_NEAR(value_of(square, "perimeter"), 4.0 + 2.0 * std::sqrt(8.0), 1e-8);
}

TEST(Measures, OfAPlaceToItselfAreZeroWithItsError) {
  const Measure none = measure_of(MeasureKind::distance, {{1, 2, 3}, {1, 2, 3}}, {0.0, 0.0, 0.01});
  const MeasureValue value = values_of(none, UP).front();
  EXPECT_EQ(value.value, 0.0);
  EXPECT_NEAR(value.within, 1.96 * 0.01 * std::sqrt(2.0), 1e-9);
  EXPECT_EQ(angle_deg(glm::dvec3(1.0), glm::dvec3(1.0), glm::dvec3(1.0)), 0.0);
  EXPECT_TRUE(values_of(measure_of(MeasureKind::area, {{0, 0, 0}, {1, 0, 0}}), UP).empty()) << "too few";
}

TEST(Measures, TakeOfErrorsWhatLiesAlongThem) {
  const auto within = [](const glm::dvec3& error) {
    return values_of(measure_of(MeasureKind::distance, {{0, 0, 0}, {5, 0, 0}}, error), UP).front().within;
  };
  EXPECT_NEAR(within({0.003, 0.0, 0.0}), 1.96 * 0.003 * std::sqrt(2.0), 1e-8);
  EXPECT_NEAR(within({0.0, 0.003, 0.0}), 0.0, 1e-5);
  const Measure point = measure_of(MeasureKind::point, {{0, 0, 0}}, {1e-9, 0.0, 0.003});
  EXPECT_EQ(values_of(point, UP)[0].within, 0.0) << "digits of a rounded normal";
  EXPECT_NEAR(values_of(point, UP)[2].within, 1.96 * 0.003, 1e-9);
}

TEST(Measures, AreWrittenWithTheDigitsThatCount) {
  const auto text = [](double value, double within, MeasureUnit unit, double metres) {
    return value_text({"", value, within, unit}, metres);
  };
  EXPECT_EQ(text(12.345678, 0.0023, MeasureUnit::length, 1.0), "12.3457 \u00B10.0023 m");
  EXPECT_EQ(text(12.345678, 3.0, MeasureUnit::length, 1.0), "12.3 \u00B13.0 m");
  EXPECT_EQ(text(12.345678, 0.00996, MeasureUnit::length, 0.3048), "12.346 \u00B10.010 ft");
  EXPECT_EQ(text(12345.678, 123.4, MeasureUnit::area, 1.0), "12350 \u00B1120 m\u00B2");
  EXPECT_EQ(text(-0.0001, 0.03, MeasureUnit::length, 1.0), "0.000 \u00B10.030 m") << "not -0";
  EXPECT_EQ(text(45.123456, 0.25, MeasureUnit::degrees, 1.0), "45.12 \u00B10.25\u00B0");
  EXPECT_EQ(text(90.0, 0.0, MeasureUnit::degrees, 1.0), "90\u00B0");
  EXPECT_EQ(text(1004.000006, 0.0, MeasureUnit::length, 1.0), "1004 m") << "a tenth of a millimetre";
  EXPECT_EQ(text(2002.49999963, 0.0, MeasureUnit::length, 0.001), "2002.5 mm");
  EXPECT_EQ(text(7.0, 0.0, MeasureUnit::length, 0.5), "7 units");
  EXPECT_EQ(text(1.6999984, 0.00000065, MeasureUnit::length, 1.0), "1.699998 \u00B10.000010 m")
      << "of rounding";
  EXPECT_EQ(text(2.49999, 0.0000016, MeasureUnit::area, 1.0), "2.499990 \u00B10.000010 m\u00B2");
}

TEST(Measures, HaveTwoDigitsOfTheirIntervalsWhateverThatIs) {
  for (double within = 1.0e-9; within < 1.0e9; within *= 1.0371) {
    const int decimals = decimals_of(within);
    const double digits = std::round(within * std::pow(10.0, decimals));
    EXPECT_TRUE(digits >= 10.0 && digits <= 99.0) << within << " with " << decimals;
    EXPECT_NEAR(std::strtod(rounded_text(within, decimals).c_str(), nullptr), within, 0.05 * within);
  }
}

TEST(Measures, WithoutAnIntervalHaveTheDigitsOfWhatTheyStandBeside) {
  const Measure distance =
      measure_of(MeasureKind::distance, {{0, 0, 0}, {16.123456, 0, 0.5}}, {0.0, 0.0, 0.003});
  const std::vector<MeasureRow> rows = measure_rows(std::vector(1, distance), {UP, "", 0.0});
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[1].quantity, "horizontal");
  EXPECT_EQ(rows[1].words.value + "|" + rows[1].words.within, "16.1235|");
  EXPECT_EQ(rows[2].words.value + "|" + rows[2].words.within, "0.5000|0.0083");
}

TEST(Measures, HaveNoIntervalsOfTheNormalsErrors) {
  const Measure point =
      measure_of(MeasureKind::point, {{1.5006, 2.6999984, 3.0}}, {0.001, 0.000003, 0.00001});
  const std::vector<MeasureRow> rows = measure_rows(std::vector(1, point), {UP});
  EXPECT_EQ(rows[0].words.value + "|" + rows[0].words.within, "431251.5006|0.0020");
  EXPECT_EQ(rows[1].words.value + "|" + rows[1].words.within, "5412362.7000|");
  EXPECT_EQ(rows[2].words.value + "|" + rows[2].words.within, "220.0000|");
}

TEST(Measures, AreATableWithHeaderNameAndUnit) {
  Measure distance = measure_of(MeasureKind::distance, {{0, 0, 0}, {2, 0, 0}}, {0.003, 0.0, 0.0});
  distance.name = "door, \"left\"";
  const std::vector<Measure> measures = {distance, measure_of(MeasureKind::point, {{1, 2, 3}})};
  const std::string csv = csv_text(measures, {UP, "EPSG:2263;xy=0.3048006096012192"});
  EXPECT_TRUE(
      csv.starts_with("id,name,kind,quantity,value,within_95,unit\n"
                      "1,\"door, \"\"left\"\"\",distance,distance,2.0000,0.0083,us-ft\n"))
      << csv;
  EXPECT_NE(csv.find("\n2,,point,x,431251,,us-ft\n"), std::string::npos) << csv;
  const std::string table = table_of(measures, {UP, ""});
  EXPECT_NE(table.find("1\tdoor, \"left\"\tdistance\tdistance\t2.0000\t0.0083\tm\n"), std::string::npos)
      << table;
  EXPECT_NE(table.find("\n\nid\tplace\tx\ty\tz\tunit\n1\t1\t431250.0000\t5412360.0000\t217.0000\tm\n"),
            std::string::npos)
      << table;
}

TEST(Measures, SayTheMainThingBesideTheirMarks) {
  const Measure point{MeasureKind::point, {{{1.25, -2.5, 3.0}, {0.0, 0.0, 0.001}}}};
  EXPECT_EQ(short_text(point, {UP}), "1.2500, -2.5000, 3.0000 m");
  Measure area{MeasureKind::area, {}};
  for (const glm::dvec3& corner : {glm::dvec3(0, 0, 0), glm::dvec3(2, 0, 0), glm::dvec3(0, 2, 0)})
    area.points.push_back({corner, {}});
  EXPECT_EQ(short_text(area, {UP}), "A 2 m\u00B2");
  EXPECT_EQ(short_text({MeasureKind::distance, {}}, {UP}), "");
  area.name = "hall";
  EXPECT_EQ(labelled_text(area, {UP}), "hall: A 2 m\u00B2");
}

TEST(MeasureText, TakesPointsAndRays) {
  const GivenMeasure given = read_measure(MeasureKind::distance, "1,2,3>0,0,-1;4,5,6");
  ASSERT_EQ(given.places.size(), 2U);
  EXPECT_EQ(given.places[0].direction, glm::dvec3(0.0, 0.0, -1.0));
  EXPECT_EQ(given.places[1].place, glm::dvec3(4.0, 5.0, 6.0));
  EXPECT_EQ(read_measure(MeasureKind::sphere, "1,2,3;0.5").reach, 0.5);
  for (const char* text : {"", "1,2,3", "1,2;3,4", "1,2,3>0,0,0;1,2,3", "1,2,3;1,2,nan"})
    EXPECT_THROW((void)read_measure(MeasureKind::distance, text), Expected) << text;
  EXPECT_THROW((void)read_measure(MeasureKind::vertical, "0,0,0;1,1,1;2,2,2"), Expected);
  try {
    (void)read_measure(MeasureKind::distance, "1,2;3,4");
  } catch (const Expected& expected) {
    EXPECT_NE(expected.what.find("X,Y,Z>DX,DY,DZ with ; between them"), std::string::npos) << expected.what;
  }
  EXPECT_THROW((void)read_measure(MeasureKind::cylinder, "0,0,0;0"), Expected);
}

std::vector<Measure> all_kinds() {
  std::vector<Measure> measures = {
      measure_of(MeasureKind::point, {{1, 2, 3}}),
      measure_of(MeasureKind::distance, {{0, 0, 0}, {1, 0, 0}, {1, 1, 1}}),
      measure_of(MeasureKind::vertical, {{0, 0, 0}, {1, 0, 4}}),
      measure_of(MeasureKind::horizontal, {{0, 0, 0}, {1, 0, 4}}),
      measure_of(MeasureKind::angle, {{0, 0, 0}, {1, 0, 4}, {2, 2, 2}}),
      measure_of(MeasureKind::area, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0.0, 0.0, 0.001}),
      measure_of(MeasureKind::plane, {{1, 2, 3}}),
      measure_of(MeasureKind::cylinder, {{1, 2, 3}})};
  measures.front().name = "Stra\u00DFe";
  measures.front().points.front().sideways = {0.01, 0.0, 0.02};
  measures[6].plane = PlaneFit{FAR_AWAY, {0.0, 0.6, 0.8}, 0.002, 0.0003, 77};
  measures.back().fit = RadiusFit{0.25, 0.001, 0.002, FAR_AWAY, {0.0, 0.6, 0.8}, 77};
  return measures;
}

TEST(MeasureFile, OfGeoJsonIsReadAgain) {
  const TempFolder folder;
  const std::vector<Measure> measures = all_kinds();
  write_measures(measures, {UP, "EPSG:25832"}, folder.path() / "m.geojson");
  EXPECT_EQ(read_measures(folder.path() / "m.geojson", "EPSG:25832"), measures);
  EXPECT_EQ(read_measures(folder.path() / "m.geojson", ""), measures);
  EXPECT_THROW((void)read_measures(folder.path() / "m.geojson", "EPSG:25833"), Error) << "of another system";
  EXPECT_NE(geojson_text(measures, {UP, "EPSG:25832"}).find("urn:ogc:def:crs:EPSG::25832"),
            std::string::npos);
}

/// As QGIS and GDAL write what they have read: one kind of geometry a layer, in several parts each; every feature with the properties of
/// all, lists as texts; further properties; sometimes two coordinates.
TEST(MeasureFile, OfQgisIsReadAgain) {
  const TempFolder folder;
  const auto read = [&](const std::string& features, const std::string& crs = "EPSG:25832") {
    folder.write(
        "q.geojson",
        "{\"type\": \"FeatureCollection\", \"name\": \"q\", \"crs\": {\"type\": \"name\", \"properties\": "
        "{\"name\": \"urn:ogc:def:crs:EPSG::25832\"}}, \"features\": [" +
            features + "]}");
    return read_measures(folder.path() / "q.geojson", crs);
  };
  const std::string saved =
      R"({"type": "Feature", "properties": {"fid": 7, "id": 2, "name": "hall", "kind": "area", "area": 4.0, "note": null,
          "errors": "[ [ 0, 0, 0.001 ], [ 0, 0, 0.001 ], [ 0, 0, 0.001 ] ]", "errors_sideways": null, "center": null, "axis": null},
          "geometry": {"type": "MultiPolygon", "coordinates": [[[[0, 0, 5], [4, 0, 5], [4, 2, 5], [0, 0, 5]]]]}})";
  const std::vector<Measure> area = read(saved);
  ASSERT_EQ(area.size(), 1U);
  EXPECT_EQ(area[0].name, "hall");
  EXPECT_EQ(area[0].kind, MeasureKind::area);
  EXPECT_EQ(values_of(area[0], UP).front().value, 4.0);
  EXPECT_GT(values_of(area[0], {0.0, 1.0, 0.0}).size(), 0U);
  EXPECT_EQ(area[0].points[1].error, glm::dvec3(0.0, 0.0, 0.001));
  const std::vector<Measure> line = read(
      R"({"type": "Feature", "properties": {"fid": 1}, "geometry": {"type": "MultiLineString", "coordinates": [[[0, 0], [3, 4]]]}})");
  EXPECT_EQ(line[0].kind, MeasureKind::distance);
  EXPECT_EQ(values_of(line[0], UP).front().value, 5.0) << "of two coordinates each";
  const std::vector<Measure> point = read(
      R"({"type": "Feature", "properties": null, "geometry": {"type": "Point", "coordinates": [1, 2, 3]}})");
  EXPECT_EQ(point[0].points[0].place, glm::dvec3(1.0, 2.0, 3.0));
  EXPECT_THROW((void)read(saved, "EPSG:4326"), Error);
  for (
      const char* wrong :
      {R"({"properties": {}, "geometry": {"type": "MultiLineString", "coordinates": [[[0, 0], [1, 0]], [[5, 0], [6, 0]]]}})",
       R"({"properties": {}, "geometry": {"type": "GeometryCollection", "geometries": []}})",
       R"({"properties": {"errors": "[1"}, "geometry": {"type": "Point", "coordinates": [1, 2, 3]}})",
       R"({"properties": {}, "geometry": null})"})
    EXPECT_THROW((void)read(wrong), Error) << wrong;
}

TEST(MeasureFile, ThatIsNoneIsRefused) {
  const TempFolder folder;
  const std::filesystem::path path = folder.path() / "m.geojson";
  for (const std::string text :
       {"", "{", "[]", "{\"features\": 5}", "{\"features\": [{}]}",
        "{\"features\": [{\"properties\": {\"kind\": \"girth\"}, \"geometry\": {}}]}"}) {
    folder.write("m.geojson", text);
    EXPECT_THROW((void)read_measures(path, ""), Error) << text;
  }
  EXPECT_THROW((void)read_measures(folder.path() / "none.geojson", ""), Error);
  EXPECT_THROW(write_measures({}, {}, folder.path() / "m.txt"), Error);
}

TEST(MeasureFile, OfDxfHasPairsOfCodeAndValueInAscii) {
  const std::string text = dxf_text(all_kinds(), {UP, ""});
  EXPECT_TRUE(
      std::all_of(text.begin(), text.end(), [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); }));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n') % 2, 0);
  EXPECT_TRUE(text.starts_with("0\nSECTION\n2\nHEADER\n"));
  EXPECT_TRUE(text.ends_with("0\nENDSEC\n0\nEOF\n"));
  EXPECT_NE(text.find("\\U+00B1"), std::string::npos);
  EXPECT_NE(text.find("\n8\nMEASURES\n"), std::string::npos);
}

TEST(Dxf, PlacesOfCirclesAreOfTheirOwnSystem) {
  const glm::dvec3 place(1.0, 2.0, 3.0);
  EXPECT_EQ(in_object_system(place, {0.0, 0.0, 1.0}), place);
  EXPECT_EQ(in_object_system(place, {0.0, 0.0, -1.0}), glm::dvec3(-1.0, 2.0, -3.0));
  EXPECT_EQ(in_object_system(place, {1.0, 0.0, 0.0}), glm::dvec3(2.0, 3.0, 1.0));
  DxfWriter dxf(1.0, {{"A"}});
  dxf.circle("A", place, 0.5, {2.0, 0.0, 0.0});
  EXPECT_NE(dxf.str().find("\n10\n2\n20\n3\n30\n1\n40\n0.5\n210\n1\n"), std::string::npos) << dxf.str();
}

const Scene& ball() {
  static const Scene scene = testing::scene_of(
      {{sphere({.count = 20000, .even = true, .seed = 7}, 1.0), testing::test_material(0)}});
  return scene;
}

Region below(double z) {
  Region region;
  region.kept = {{glm::dvec3(0.0, 0.0, z), glm::dvec3(0.0, 0.0, -1.0)}};
  return region;
}

TEST(SurfacePoint, IsTheNearestOfTheDiscsInTheRegion) {
  const auto point = nearest_point(ball(), {}, {0.0, 0.0, 3.0});
  ASSERT_TRUE(point);
  EXPECT_LT(glm::distance(point->point.place, glm::dvec3(0.0, 0.0, 1.0)), 0.02);
  EXPECT_LT(glm::length(point->point.error), 1e-3);
  EXPECT_NEAR(point->distance_world, 2.0, 1e-3);
  EXPECT_NEAR(point->spacing_world, std::sqrt(4.0 * std::numbers::pi / 20000.0), 0.004);
  const auto lower = nearest_point(ball(), below(0.0), {0.0, 0.5, 3.0});
  ASSERT_TRUE(lower);
  EXPECT_LT(lower->point.place.z, 0.02);
  const auto fit = radius_near(ball(), {}, {0.0, 0.0, 1.0}, 0.5, MeasureKind::sphere);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->radius, 1.0, 1e-3);
}

TEST(SurfacePoint, IsRefusedFarFromThePlace) {
  const double spacing = nearest_point(ball(), {}, {0.0, 0.0, 1.0})->spacing_world;
  const auto measured = [](const GivenMeasure& given) { return take_measure(ball(), {}, given, nullptr); };
  const GivenPlace on{{0.0, 0.0, 1.0}, {}}, near{{0.0, 0.0, 1.0 + 3.0 * spacing}, {}};
  const GivenPlace off{{0.0, 0.0, 1.0 + 5.0 * spacing}, {}}, far{{2000.0, 0.0, 0.0}, {}};
  for (int i = 0; i < MARKED_KINDS; ++i) {
    const auto kind = static_cast<MeasureKind>(i);
    for (const GivenPlace& last : {on, near, off, far}) {
      GivenMeasure given{kind, std::vector(points_needed(kind), on), is_fitted(kind) ? 0.5 : 0.0};
      given.places.back() = last;
      const bool reached = last == on || last == near || (last == off && is_fitted(kind));
      if (reached)
        EXPECT_NO_THROW((void)measured(given)) << measure_name(kind);
      else
        EXPECT_THROW((void)measured(given), Error) << measure_name(kind);
    }
  }
  try {
    (void)measured({MeasureKind::point, {far}});
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("the place 2000,0,0 lies 2e+03 from the nearest surface"),
              std::string::npos)
        << error.what();
  }
}

TEST(Areas, OfOutlinesThatCrossThemselvesAreRefused) {
  const auto measured = [](const std::vector<glm::dvec3>& places) {
    GivenMeasure given{MeasureKind::area, {}};
    for (const glm::dvec3& place : places) given.places.push_back({glm::normalize(place), {}});
    return values_of(take_measure(ball(), {}, given, nullptr), UP)[0].value;
  };
  const glm::dvec3 a(1, 0.3, 0.3), b(1, -0.3, 0.3), c(1, -0.3, -0.3), d(1, 0.3, -0.3);
  EXPECT_NEAR(measured({a, b, c, d}), 4.0 * 0.09 / 1.18, 0.01);
  EXPECT_NEAR(measured({d, c, b, a}), 4.0 * 0.09 / 1.18, 0.01);
  EXPECT_NO_THROW((void)measured({a, a, b, c}));
  try {
    (void)measured({a, b, d, c});
    ADD_FAILURE() << "it has no inside";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("from place 2 to 3 crosses that from 4 to 1"), std::string::npos)
        << error.what();
  }
}

/// The discs end below a place that is on the ball: the point beside it says how far beside.
TEST(SurfacePoint, HoldsItsWaySidewaysInTheInterval) {
  const double spacing = nearest_point(ball(), {}, {1.0, 0.0, 0.0})->spacing_world, angle = 3.0 * spacing;
  const glm::dvec3 place(std::cos(angle), 0.0, std::sin(angle));
  const auto nearest = nearest_point(ball(), below(0.0), place);
  ASSERT_TRUE(nearest);
  const Measure measure{MeasureKind::point, {nearest->point}};
  const MeasureValue z = values_of(measure, UP)[2];
  EXPECT_GT(std::abs(z.value - place.z), spacing);
  EXPECT_LT(std::abs(z.value - place.z), z.within);
  EXPECT_LT(z.within, 8.0 * spacing);
}

/// Two sheets that smoothing makes one, because it was told to: their distance is lost, and the interval holds it.
TEST(SurfacePoint, HoldsWhatSmoothingMovedItInTheInterval) {
  constexpr double APART = 0.05;
  Points points;
  for (int i = 0; i < 8000; ++i) {
    const double turn = 0.618033988749895 * i;
    points.position.emplace_back(2.0 * i / 8000.0, 2.0 * (turn - std::floor(turn)), i % 2 == 0 ? 0.0 : APART);
  }
  const testing::BuiltScan built = testing::build_scan(points, {.smooth_world = 0.3});
  ASSERT_GT(built.stats.moved_median_world, 0.4 * APART) << "nothing moved, nothing shown";
  Measure measure{MeasureKind::vertical, {}};
  for (const double z : {0.0, APART})
    measure.points.push_back(nearest_point(built.scene, {}, {1.0, 1.0, z})->point);
  const MeasureValue height = values_of(measure, UP).front();
  EXPECT_LT(std::abs(height.value), 0.1 * APART);
  EXPECT_LT(std::abs(height.value - APART), height.within);
  EXPECT_LT(height.within, 1.5 * APART);
}

TEST(Values, NothingIsMeasuredAcrossTwoUnits) {
  const auto sentence = [](const std::string& crs) {
    try {
      (void)require_unit_metres(crs, std::nullopt);
      return std::string();
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(sentence(""), "");
  EXPECT_EQ(sentence("EPSG:2264;xy=0.3048006096012192;z=0.3048"), "") << "a part in 500 000";
  EXPECT_DOUBLE_EQ(require_unit_metres("EPSG:25832;xy=1", std::nullopt), 1.0);
  EXPECT_NE(sentence("EPSG:25832;xy=1;z=0.3048").find("z is in feet while x and y are in metres"),
            std::string::npos);
  EXPECT_NE(sentence("EPSG:25832;xy=1;z=0.3048").find("--z-scale 0.3048,"), std::string::npos);
  EXPECT_NE(sentence("EPSG:4326;deg").find("degrees"), std::string::npos);
  EXPECT_DOUBLE_EQ(require_unit_metres("EPSG:25832;xy=1;z=0.3048", 0.3048), 0.3048)
      << "the user knows better";
}

}  // namespace
}  // namespace splatray
