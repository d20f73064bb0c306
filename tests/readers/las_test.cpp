/// LAS files and their traps.
#include "preprocess/read/las/read_las.h"

#include <cmath>
#include <limits>

#include "engine/base/crs.h"
#include "tests/readers/las_file.h"
#include "tests/temp_folder.h"

namespace splatray {
namespace {

struct Read {
  ScanFile file;
  std::vector<std::string> notes;

  [[nodiscard]] bool has_note(const std::string& text) const {
    return std::any_of(notes.begin(), notes.end(),
                       [&](const std::string& note) { return note.find(text) != std::string::npos; });
  }
};

/// Reads bytes as a LAS file.
Read read_bytes(const std::string& bytes, const ReadOptions& options = {}) {
  const TempFolder folder;
  Read read;
  read.file = read_las(folder.write("a.las", bytes), options, {read.notes, options.progress});
  return read;
}

std::string error_of(const std::string& bytes, const ReadOptions& options = {}) {
  const TempFolder folder;
  return read_error(folder.write("a.las", bytes), options);
}

LasFile three_points() {
  LasFile file;
  file.records = {las_point(1000, 2000, 3000), las_point(-1000, 0, 7), las_point(5, 6, 2147483647)};
  return file;
}

double number(const Points& points, std::string_view name, std::size_t i) {
  const Column* column = find_column(points.columns, name);
  return column == nullptr ? NAN : column->number(i);
}

TEST(Las, EveryFieldOfEveryKindOfRecord) {
  for (const unsigned format : {0U, 1U, 2U, 3U, 6U, 7U}) {
    SCOPED_TRACE(format);
    LasFile file;
    file.format = format;
    file.version_minor = format >= 6 ? 4 : 2;
    file.scale = {0.01, 0.5, 2.0};
    file.offset = {600000.0, 5000000.0, -10.0};
    LasRecord point = las_point(123, -4, 5);
    point.intensity = 65535;
    point.return_number = 3;
    point.returns = 5;
    point.classification = format >= 6 ? 200 : 31;
    point.is_synthetic = true;
    point.source = 777;
    point.time = 1234.5;
    point.color = {1, 256, 65535};
    file.records = {point};
    const ScanFile scan = read_bytes(file.bytes()).file;
    ASSERT_EQ(scan.points.size(), 1U);
    EXPECT_EQ(scan.points.position[0], glm::dvec3(0.01 * 123 + 600000.0, 4999998.0, 0.0));
    EXPECT_EQ(number(scan.points, COLUMN_INTENSITY, 0), 65535.0);
    EXPECT_EQ(number(scan.points, COLUMN_RETURN, 0), 3.0);
    EXPECT_EQ(number(scan.points, COLUMN_RETURNS, 0), 5.0);
    EXPECT_EQ(number(scan.points, COLUMN_CLASS, 0), format >= 6 ? 200.0 : 31.0);
    EXPECT_EQ(number(scan.points, COLUMN_SOURCE, 0), 777.0);
    const bool has_time = format != 0 && format != 2;
    EXPECT_EQ(find_column(scan.points.columns, COLUMN_TIME) != nullptr, has_time);
    if (has_time) {
      EXPECT_EQ(number(scan.points, COLUMN_TIME, 0), 1234.5);
    }
    const bool has_color = format == 2 || format == 3 || format == 7;
    ASSERT_EQ(scan.points.stored_color.size(), has_color ? 1U : 0U);
    if (has_color) {
      EXPECT_EQ(scan.points.stored_color[0], glm::u16vec3(1, 256, 65535));
    }
    EXPECT_EQ(scan.points.stored_color_most, 0);
    EXPECT_EQ(scan.up, glm::dvec3(0.0, 0.0, 1.0));
  }
}

TEST(Las, AttributesThatAreZeroThroughoutAreLeftOut) {
  LasFile file = three_points();
  for (LasRecord& point : file.records) point.return_number = point.returns = 0;
  EXPECT_TRUE(read_bytes(file.bytes()).file.points.columns.empty());
  file.records[2].time = 1.0;
  const Points points = read_bytes(file.bytes()).file.points;
  ASSERT_EQ(points.columns.size(), 1U);
  EXPECT_EQ(points.columns[0].name, COLUMN_TIME);
}

TEST(Las, PointsBeginWhereTheHeaderSays) {
  LasFile file = three_points();
  const std::vector<glm::dvec3> expected = read_bytes(file.bytes()).file.points.position;
  file.padding = std::string("\xDD\xCC", 2);
  EXPECT_EQ(read_bytes(file.bytes()).file.points.position, expected);
  file.padding = std::string(30000, 'x');
  file.vlrs = {las_vlr("someone", 1, "text")};
  EXPECT_EQ(read_bytes(file.bytes()).file.points.position, expected);
}

TEST(Las, CountsOfRecordsThatAreNotThereDoNoHarm) {
  LasFile file = three_points();
  const std::vector<glm::dvec3> expected = read_bytes(file.bytes()).file.points.position;
  file.vlrs = {las_vlr("someone", 1, "text"), std::string(70, '\xFF')};
  file.claimed_vlrs = 0xFFFFFFFF;
  EXPECT_EQ(read_bytes(file.bytes()).file.points.position, expected);
}

TEST(Las, ClassAndFlagsShareAByteInOldFormatsOnly) {
  for (const unsigned format : {1U, 6U}) {
    LasFile file;
    file.format = format;
    file.version_minor = 4;
    for (const unsigned classification : {2U, 7U, 18U, 12U})
      for (const bool is_withheld : {false, true}) {
        LasRecord point = las_point(1, 2, 3);
        point.classification = classification;
        point.is_withheld = is_withheld;
        point.is_synthetic = true;
        file.records.push_back(point);
      }
    const ScanFile cleaned = read_bytes(file.bytes()).file;
    EXPECT_EQ(cleaned.points.size(), 2U);
    EXPECT_EQ(cleaned.counts.stored, 8U);
    EXPECT_EQ(cleaned.counts.withheld, 4U);
    EXPECT_EQ(cleaned.counts.noise, 2U);
    EXPECT_EQ(number(cleaned.points, COLUMN_CLASS, 0), 2.0);
    EXPECT_EQ(number(cleaned.points, COLUMN_CLASS, 1), 12.0);
    ReadOptions options;
    options.scans.keep_withheld = true;
    const ScanFile all = read_bytes(file.bytes(), options).file;
    EXPECT_EQ(all.points.size(), 8U);
    EXPECT_EQ(all.counts.withheld + all.counts.noise, 0U);
    EXPECT_EQ(number(all.points, COLUMN_CLASS, 3), 7.0);
  }
}

TEST(Las, CountsOfLas14) {
  LasFile file = three_points();
  file.version_minor = 4;
  file.format = 6;
  file.claimed_legacy = 0;
  EXPECT_EQ(read_bytes(file.bytes()).file.points.size(), 3U);
  file.claimed_points = 0;
  file.claimed_legacy = 3;
  EXPECT_EQ(read_bytes(file.bytes()).file.points.size(), 3U);
}

TEST(Las, TheHeadersCountRulesUnlessItIsZero) {
  LasFile file = three_points();
  file.claimed_points = 2;
  EXPECT_EQ(read_bytes(file.bytes()).file.points.size(), 2U);
  file.claimed_points = 0;
  const Read read = read_bytes(file.bytes());
  EXPECT_EQ(read.file.points.size(), 3U);
  EXPECT_TRUE(read.has_note("the header counts no points; found 3"));
}

TEST(Las, TheHeadersBoxIsNotUsed) {
  LasFile file = three_points();
  const std::vector<glm::dvec3> expected = read_bytes(file.bytes()).file.points.position;
  file.box = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(read_bytes(file.bytes()).file.points.position, expected);
}

TEST(Las, AFileThatEndsEarlyGivesWhatIsWhole) {
  const std::string bytes = three_points().bytes();
  ReadOptions strict;
  strict.scans.strict = true;
  for (std::size_t cut = 1; cut <= 34; ++cut) {
    const std::string part = bytes.substr(0, bytes.size() - cut);
    const Read read = read_bytes(part);
    EXPECT_EQ(read.file.points.size(), 2U);
    EXPECT_EQ(read.file.counts.stored, 3U);
    EXPECT_EQ(read.file.counts.missing, 1U);
    EXPECT_TRUE(read.has_note("found 2 whole points, expected the 3 that the header counts"));
    EXPECT_NE(error_of(part, strict).find("found 2 whole points"), std::string::npos);
  }
  EXPECT_EQ(read_bytes(bytes, strict).file.counts.missing, 0U);
}

TEST(Las, CountsBeyondTheFileTakeNoMemory) {
  LasFile file = three_points();
  file.version_minor = 4;
  file.format = 6;
  file.claimed_points = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(read_bytes(file.bytes()).file.points.size(), 3U);
}

TEST(Las, ScalesThatMakeNoPositionsAreRefused) {
  for (const double scale : {0.0, std::numeric_limits<double>::quiet_NaN(), 1e300}) {
    LasFile file = three_points();
    file.scale[2] = scale;
    EXPECT_NE(error_of(file.bytes()).find("of z, expected finite numbers and a scale that is not 0"),
              std::string::npos);
  }
}

TEST(Las, HeadersThatAreNoneAreRefused) {
  LasFile file = three_points();
  file.version_minor = 6;
  EXPECT_NE(error_of(file.bytes()).find("version 1.6"), std::string::npos);
  std::string bytes = three_points().bytes();
  bytes[104] = 11;
  EXPECT_NE(error_of(bytes).find("point format 11"), std::string::npos);
  bytes[104] = 5;
  EXPECT_NE(error_of(bytes).find("records of 34 bytes, expected at least 63"), std::string::npos);
  bytes[104] = static_cast<char>(128 + 3);
  EXPECT_NE(error_of(bytes).find("without LASzip's record"), std::string::npos);
}

TEST(Las, ExtraBytesOfAllRecordsWhenAskedFor) {
  LasFile file = three_points();
  file.vlrs = {las_vlr("LASF_Spec", 4, las_descriptor(4, "height", 24, 0.5, 3.0) + las_descriptor(0, "", 2)),
               las_vlr("LASF_Spec", 4, las_descriptor(29, "normal") + las_descriptor(1, "beyond"))};
  file.extra_bytes = 16;
  for (LasRecord& point : file.records)
    point.extra = bytes_of<std::int16_t>(-4) + "??" + bytes_of(0.25F) + bytes_of(0.5F) + bytes_of(1.0F);
  EXPECT_EQ(find_column(read_bytes(file.bytes()).file.points.columns, "height"), nullptr);
  ReadOptions options;
  options.scans.attributes = {"height", "normal", "beyond", "source"};
  const Points points = read_bytes(file.bytes(), options).file.points;
  EXPECT_EQ(number(points, "height", 2), 1.0);
  EXPECT_EQ(number(points, "normal[0]", 1), 0.25);
  EXPECT_EQ(number(points, "normal[2]", 1), 1.0);
  EXPECT_EQ(find_column(points.columns, "beyond"), nullptr);
  ASSERT_NE(find_column(points.columns, "normal[1]"), nullptr);
  EXPECT_TRUE(std::holds_alternative<Pool<float>>(find_column(points.columns, "normal[1]")->values));
  EXPECT_TRUE(std::holds_alternative<Pool<double>>(find_column(points.columns, "height")->values));
}

std::string geo_keys(const std::vector<std::array<std::uint16_t, 2>>& keys) {
  std::string text = bytes_of<std::uint16_t>(1) + bytes_of<std::uint32_t>(1) +
                     bytes_of(static_cast<std::uint16_t>(keys.size()));
  for (const auto& [key, value] : keys)
    text += bytes_of(key) + bytes_of<std::uint16_t>(0) + bytes_of<std::uint16_t>(1) + bytes_of(value);
  return las_vlr("LASF_Projection", 34735, text);
}

TEST(Las, UnitsThatDifferAreReported) {
  const auto notes = [](const std::string& vlr) {
    LasFile file = three_points();
    file.vlrs = {vlr};
    const Read read = read_bytes(file.bytes());
    return read.notes.empty() ? std::string() : read.notes[0].substr(read.notes[0].find(": ") + 2);
  };
  const auto wkt = [&](const std::string& text) { return notes(las_vlr("LASF_Projection", 2112, text)); };
  EXPECT_EQ(notes(geo_keys({{1024, 2}})).find("x and y are degrees"), 0U);
  EXPECT_EQ(notes(geo_keys({{1024, 1}, {3076, 9001}, {4099, 9003}})),
            "z is in US survey feet while x and y are in metres");
  EXPECT_EQ(notes(geo_keys({{1024, 1}, {3076, 9003}, {4099, 9002}})), "");
  EXPECT_EQ(notes(geo_keys({{1024, 1}, {3076, 9001}})), "");
  EXPECT_EQ(notes(geo_keys({{1024, 1}, {3072, 2264}, {4099, 9001}})),
            "z is in metres while x and y are in US survey feet");
  EXPECT_EQ(notes(geo_keys({{1024, 1}, {3072, 2264}, {3076, 9001}})),
            "x and y are in metres by the file's key of units and in US survey feet by EPSG:2264; the key is "
            "taken");
  EXPECT_EQ(notes(geo_keys({{1024, 1}, {3072, 2264}, {3076, 9003}})), "");
  const std::string geographic = R"(GEOGCS["WGS 84",DATUM["WGS_1984"],UNIT["degree",0.0174532925199433]])";
  const std::string projected =
      "PROJCS[\"UTM\"," + geographic + R"(,PARAMETER["false_easting",0],UNIT["metre",1]])";
  EXPECT_EQ(wkt(geographic).find("x and y are degrees"), 0U);
  EXPECT_EQ(wkt(projected), "");
  EXPECT_EQ(wkt("COMPD_CS[\"both\"," + projected + R"(,VERT_CS["h",UNIT["foot",0.3048]]])"),
            "z is in feet while x and y are in metres");
  EXPECT_EQ(wkt("COMPD_CS[\"both\"," + projected + R"(,VERT_CS["h",UNIT["metre",1]]])"), "");
}

TEST(Las, CoordinateSystemIsKept) {
  const auto crs = [](const std::vector<std::string>& vlrs) {
    LasFile file = three_points();
    file.vlrs = vlrs;
    return read_bytes(file.bytes()).file.points.crs;
  };
  const std::string text = R"(PROJCS["UTM",UNIT["metre",1]])";
  const std::string keys = geo_keys({{1024, 1}, {3072, 2264}, {3076, 9003}, {4096, 5703}, {4099, 9001}});
  EXPECT_EQ(crs({}), "");
  EXPECT_EQ(crs({las_vlr("LASF_Projection", 2112, text + std::string(3, '\0'))}), text);
  EXPECT_EQ(crs({keys, las_vlr("LASF_Projection", 2112, text)}), text) << "the text says more";
  EXPECT_EQ(crs({keys}), "EPSG:2264+5703;xy=0.3048006096012192;z=1");
  EXPECT_EQ(crs({geo_keys({{1024, 2}, {2048, 4326}})}), "EPSG:4326;deg");
  EXPECT_EQ(crs({geo_keys({{1024, 1}, {3072, 2264}})}), "EPSG:2264;xy=0.3048006096012192");
  EXPECT_EQ(crs({geo_keys({{1024, 1}, {3072, 2264}, {3076, 9001}})}), "EPSG:2264;xy=1") << "the key rules";
  EXPECT_EQ(crs({geo_keys({{1024, 1}, {3072, 2264}, {3076, 32767}})}), "EPSG:2264;xy=0.3048006096012192");
  EXPECT_EQ(crs({geo_keys({{1024, 1}, {3072, 2222}, {4096, 6360}})}),
            "EPSG:2222+6360;xy=0.3048;z=0.3048006096012192");
  EXPECT_EQ(crs({geo_keys({{1024, 1}, {3072, 25832}})}), "EPSG:25832");
  EXPECT_EQ(crs({geo_keys({{1024, 1}, {2048, 4326}, {3072, 32767}})}), "") << "a system of the user's own";
}

TEST(Las, ScaledHeightsLeaveTheirSystem) {
  const TempFolder folder;
  const auto crs = [&](const std::string& vlr, double z_scale) {
    LasFile file = three_points();
    file.vlrs = {vlr};
    ReadOptions options;
    options.scans.z_scale = z_scale;
    return read_input({folder.write("a.las", file.bytes())}, options).crs;
  };
  const std::string keys = geo_keys({{1024, 1}, {3072, 25832}, {3076, 9001}, {4096, 6360}, {4099, 9003}});
  EXPECT_EQ(crs(keys, 1.0), "EPSG:25832+6360;xy=1;z=0.3048006096012192");
  EXPECT_EQ(crs(keys, 1200.0 / 3937.0), "EPSG:25832;xy=1");
  const std::string projected = R"(PROJCS["UTM",GEOGCS["g"],UNIT["metre",1]])";
  const std::string both = "COMPD_CS[\"both\"," + projected + R"(,VERT_CS["h",UNIT["foot",0.3048]]])";
  EXPECT_EQ(crs(las_vlr("LASF_Projection", 2112, both), 1.0), both);
  EXPECT_EQ(crs(las_vlr("LASF_Projection", 2112, both), 0.3048), projected);
  EXPECT_EQ(crs(las_vlr("LASF_Projection", 2112, projected), 0.3048), projected);
}

TEST(Las, SystemsInFeetAreThoseOfEpsg) {
  constexpr double US_FOOT = 1200.0 / 3937.0, FOOT = 0.3048;
  for (const unsigned code : {2155U, 2225U, 2250U, 2264U, 2899U, 6358U, 6543U, 26729U, 32058U, 6360U})
    EXPECT_EQ(epsg_system_metres(code), US_FOOT) << code;
  for (const unsigned code : {2222U, 2224U, 2251U, 2256U, 2992U, 6557U, 8228U, 8348U, 20050U})
    EXPECT_EQ(epsg_system_metres(code), FOOT) << code;
  for (const unsigned code : {0U, 2154U, 2193U, 5703U, 6542U, 6556U, 8347U, 25832U, 32617U, 65536U + 2264U})
    EXPECT_EQ(epsg_system_metres(code), 0.0) << code;
  EXPECT_EQ(describe_crs("EPSG:2264+6360").horizontal_metres, US_FOOT);
  EXPECT_EQ(describe_crs("EPSG:2264+6360").vertical_metres, US_FOOT);
  EXPECT_EQ(describe_crs("EPSG:2264;xy=1").horizontal_metres, 1.0);
}

TEST(Las, EveryPrefixIsReadOrRefused) {
  const TempFolder folder;
  LasFile file = three_points();
  file.vlrs = {las_vlr("LASF_Spec", 4, las_descriptor(4, "height"))};
  read_every_prefix(folder, "a.las", file.bytes());
}

}  // namespace
}  // namespace splatray
