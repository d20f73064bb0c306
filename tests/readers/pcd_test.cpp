/// PCD in its three kinds, and what is wrong with files.
#include <sys/resource.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "preprocess/read/pcd/lzf.h"
#include "tests/readers/scan_reading.h"

namespace splatray {
namespace {

struct Field {
  std::string name;
  std::string type = "F";
  int size = 4;
  int count = 1;
};

std::string header(const std::vector<Field>& fields, int width, int height, const std::string& data,
                   const std::string& viewpoint = "0 0 0 1 0 0 0") {
  std::string lines[4] = {"FIELDS", "SIZE", "TYPE", "COUNT"};
  for (const Field& field : fields) {
    lines[0] += " " + field.name;
    lines[1] += " " + std::to_string(field.size);
    lines[2] += " " + field.type;
    lines[3] += " " + std::to_string(field.count);
  }
  return "# .PCD v.7\nVERSION .7\n" + lines[0] + "\n" + lines[1] + "\n" + lines[2] + "\n" + lines[3] +
         "\nWIDTH " + std::to_string(width) + "\nHEIGHT " + std::to_string(height) + "\nVIEWPOINT " +
         viewpoint + "\nPOINTS " + std::to_string(width * height) + "\nDATA " + data + "\n";
}

const std::vector<Field> XYZ{{"x"}, {"y"}, {"z"}};
const std::vector<Field> XYZ_RGB{{"x"}, {"y"}, {"z"}, {"rgb"}};

/// LZF of literals alone, but for runs of one byte.
std::string compressed(const std::string& bytes) {
  std::string out;
  for (std::size_t i = 0; i < bytes.size();) {
    const std::size_t run = std::min(bytes.find_first_not_of(bytes[i], i), bytes.size()) - i;
    if (run >= 12) {
      const std::size_t repeat = std::min<std::size_t>(run - 1, 264);
      out += std::string(1, '\0') + bytes[i] + '\xE0' + static_cast<char>(repeat - 9) + '\0';
      i += repeat + 1;
    } else {
      out += std::string(1, '\0') + bytes[i++];
    }
  }
  return out;
}

std::string with_sizes(const std::string& packed, std::size_t size) {
  return bytes_of(static_cast<std::uint32_t>(packed.size())) + bytes_of(static_cast<std::uint32_t>(size)) +
         packed;
}

/// A grid of two rows of three with a hole, in each kind of data: x, y, z and a colour 0xFF800100 + i.
std::string grid(const std::string& data) {
  const float hole = std::numeric_limits<float>::quiet_NaN();
  std::string text;
  std::string rows;
  std::string fields[4];
  for (unsigned i = 0; i < 6; ++i) {
    const float place[3] = {i == 4 ? hole : 0.5F * static_cast<float>(i % 3), static_cast<float>(i / 3),
                            0.125F};
    const std::uint32_t color = 0x00800100U + i;
    for (int axis = 0; axis < 3; ++axis) {
      text += (std::isnan(place[axis]) ? "nan" : std::to_string(place[axis])) + " ";
      rows += bytes_of(place[axis]);
      fields[axis] += bytes_of(place[axis]);
    }
    char printed[32];
    std::snprintf(printed, sizeof printed, "%.9g\n", static_cast<double>(std::bit_cast<float>(color)));
    text += printed;
    rows += bytes_of(color);
    fields[3] += bytes_of(color);
  }
  const std::string bytes = fields[0] + fields[1] + fields[2] + fields[3];
  const std::string body = data == "ascii"    ? text
                           : data == "binary" ? rows
                                              : with_sizes(compressed(bytes), bytes.size());
  return header(XYZ_RGB, 3, 2, data, "0.5 -1 0.25 0.92 0 0.38 0") + body;
}

TEST(Pcd, OneGridInAllKindsOfData) {
  const TempFolder folder;
  for (const std::string data : {"ascii", "binary", "binary_compressed"}) {
    const ReadScan read = read_scan(folder.write("g.pcd", grid(data)));
    const Points& points = read.file.points;
    ASSERT_EQ(points.size(), 5U) << data;
    EXPECT_EQ(read.file.counts.stored, 6U);
    EXPECT_EQ(read.file.counts.no_return, 1U);
    EXPECT_EQ(read.file.counts.missing, 0U) << data;
    EXPECT_EQ(points.position[4], glm::dvec3(1.0, 1.0, 0.125)) << data;
    EXPECT_EQ(points.grid_cell, (std::vector<std::uint32_t>{0, 1, 2, 3, 5})) << data;
    EXPECT_EQ(points.stored_color[4], glm::u16vec3(128, 1, 5)) << data;
    EXPECT_EQ(points.stations.at(0).rows, 2U);
    EXPECT_EQ(points.stations.at(0).columns, 3U);
    EXPECT_EQ(points.stations[0].sensor_world, glm::dvec3(0.5, -1.0, 0.25));
    EXPECT_EQ(read.file.up, glm::dvec3(0.0, 0.0, 1.0));
    EXPECT_TRUE(read.notes.empty()) << read.notes[0];
  }
}

TEST(Pcd, FieldsOfAllTypes) {
  const TempFolder folder;
  const std::vector<Field> fields{{"_", "U", 1, 3}, {"x", "F", 8},      {"intensity", "U", 2}, {"y", "I", 2},
                                  {"a", "I", 1},    {"b", "U", 1},      {"c", "U", 4},         {"d", "I", 8},
                                  {"e", "U", 8},    {"z", "I", 4},      {"normal_x"},          {"normal_y"},
                                  {"normal_z"},     {"many", "F", 4, 2}};
  const std::string row = std::string(3, '\7') + bytes_of(4321234.123) + bytes_of(std::uint16_t{40000}) +
                          bytes_of(std::int16_t{-3}) + bytes_of(std::int8_t{-5}) +
                          bytes_of(std::uint8_t{250}) + bytes_of(std::uint32_t{4000000000U}) +
                          bytes_of(std::int64_t{-6}) + bytes_of(std::uint64_t{7}) +
                          bytes_of(std::int32_t{-70000}) + bytes_of(0.0F) + bytes_of(0.6F) + bytes_of(0.8F) +
                          bytes_of(1.0F) + bytes_of(2.0F);
  ScanOptions options;
  options.attributes = {"a", "b", "c", "d", "e", "intensity", "absent"};
  const ReadScan read = read_scan(folder.write("f.pcd", header(fields, 1, 1, "binary") + row), options);
  const Points& points = read.file.points;
  EXPECT_EQ(points.position.at(0), glm::dvec3(4321234.123, -3.0, -70000.0));
  EXPECT_EQ(points.normal.at(0), glm::vec3(0.0F, 0.6F, 0.8F));
  ASSERT_EQ(points.columns.size(), 6U);
  const double expected[] = {40000.0, -5.0, 250.0, 4000000000.0, -6.0, 7.0};
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_EQ(points.columns[i].number(0), expected[i]) << points.columns[i].name;
  EXPECT_TRUE(read.has_note("skipped fields 'many'"));
}

TEST(Pcd, PackedColours) {
  const TempFolder folder;
  const auto color = [&](const Field& field, const std::string& value) {
    std::vector<Field> fields = XYZ;
    fields.push_back(field);
    return read_scan(folder.write("c.pcd", header(fields, 1, 1, "ascii") + "1 2 3 " + value + "\n"))
        .file.points.stored_color.at(0);
  };
  EXPECT_EQ(color({"rgb", "F"}, "4.2108e+06"), glm::u16vec3(128, 128, 224)) << "the bits of a printed float";
  EXPECT_EQ(color({"rgb", "F"}, "1.3499566e-38").x, 146);
  EXPECT_EQ(color({"rgb", "U"}, "8388864"), glm::u16vec3(128, 1, 0));
  EXPECT_EQ(color({"rgba", "U"}, "4286578945"), glm::u16vec3(128, 1, 1));
  EXPECT_EQ(color({"rgba", "I"}, "-8388351"), glm::u16vec3(128, 1, 1));
}

TEST(Pcd, GreysThatWereRoundedAreGreyAgain) {
  const TempFolder folder;
  std::vector<Field> fields = XYZ;
  fields.push_back({"rgb", "F"});
  constexpr unsigned COUNT = 4000;
  // Colours of 100 brightnesses as the bits of floats, printed with some digits.
  const auto colors_of = [&](int digits, const auto& blue_of) {
    std::string rows;
    for (unsigned i = 0; i < COUNT; ++i) {
      const std::uint32_t level = 156 + i % 100;
      char number[64];
      std::snprintf(number, sizeof number, " 2 3 %.*g\n", digits,
                    static_cast<double>(std::bit_cast<float>(level << 16U | level << 8U | blue_of(level))));
      rows += std::to_string(i) + number;
    }
    return read_scan(folder.write("g.pcd", header(fields, COUNT, 1, "ascii") + rows));
  };
  const auto grey = [](std::uint32_t level) { return level; };
  const ReadScan rounded = colors_of(5, grey);
  EXPECT_TRUE(rounded.has_note("lost when they were written as rounded numbers"));
  for (std::size_t i = 0; i < COUNT; ++i) {
    const glm::u16vec3 color = rounded.file.points.stored_color.at(i);
    EXPECT_EQ(color.y, color.z);
    EXPECT_NEAR(color.y, 156.0 + static_cast<double>(i % 100), 2.0) << "white, which rounds up, too";
  }
  EXPECT_EQ(colors_of(9, grey).file.points.stored_color.at(7), glm::u16vec3(163)) << "nothing is lost";
  const auto kept = [&](const auto& blue_of) {
    const ReadScan read = colors_of(9, blue_of);
    EXPECT_FALSE(read.has_note("lost when"));
    return read.file.points.stored_color.at(5);
  };
  EXPECT_EQ(kept([](std::uint32_t) { return 0U; }), glm::u16vec3(161, 161, 0)) << "yellow";
  EXPECT_EQ(kept([](std::uint32_t level) { return 255U - level; }), glm::u16vec3(161, 161, 94)) << "a scale";
}

TEST(Pcd, TextIsReadAsDoubleAndFloatsFarFromTheOriginAreNoted) {
  const TempFolder folder;
  const ReadScan text = read_scan(folder.write(
      "t.pcd", header(XYZ, 2, 1, "ascii") + "289814.15 4320978.61 170.76\n289815.15 4320979.61 170.76\n"));
  EXPECT_EQ(text.file.points.position.at(0), glm::dvec3(289814.15, 4320978.61, 170.76));
  EXPECT_TRUE(text.notes.empty());
  EXPECT_FALSE(text.file.points.stations.at(0).sensor_world) << "the default viewpoint says nothing";
  std::string rows;
  for (const float v : {289814.15F, 4320978.61F, 170.76F, 289815.15F, 4320979.61F, 170.76F})
    rows += bytes_of(v);
  EXPECT_TRUE(read_scan(folder.write("b.pcd", header(XYZ, 2, 1, "binary") + rows)).has_note("float32"));
}

TEST(Pcd, GridsOfCamerasHaveYDown) {
  const TempFolder folder;
  const std::string cells = "0 0 1\n1 0 1\n0 1 1\n1 1 -1\n";
  const auto read = [&](int width, const std::string& viewpoint) {
    return read_scan(folder.write("c.pcd", header(XYZ, width, 4 / width, "ascii", viewpoint) + cells)).file;
  };
  EXPECT_EQ(read(2, "0 0 0 1 0 0 0").up, glm::dvec3(0.0, -1.0, 0.0));
  EXPECT_EQ(read(2, "0 0 0 1 0 0 0").points.stations.at(0).sensor_world, glm::dvec3(0.0));
  EXPECT_EQ(read(2, "0 0 1 1 0 0 0").up, glm::dvec3(0.0, 0.0, 1.0));
  EXPECT_EQ(read(4, "0 0 0 1 0 0 0").up, glm::dvec3(0.0, 0.0, 1.0));
}

TEST(Pcd, WhatACutHasLeftIsReadAndCounted) {
  const TempFolder folder;
  for (const std::string data : {"ascii", "binary", "binary_compressed"}) {
    const std::string whole = grid(data);
    const auto cut = folder.write("cut.pcd", whole.substr(0, whole.size() - 18));
    const ReadScan read = read_scan(cut);
    EXPECT_GT(read.file.counts.missing, 0U) << data;
    EXPECT_GT(read.file.points.size(), 1U) << data;
    EXPECT_EQ(read.file.counts.stored, 6U);
    EXPECT_EQ(read.file.points.size() + read.file.counts.no_return + read.file.counts.missing, 6U) << data;
    EXPECT_TRUE(read.has_note("expected 6 as the file says")) << data;
    EXPECT_NE(strict_error(cut).find("expected 6 as the file says"), std::string::npos);
    read_every_prefix(folder, "p.pcd", whole);
  }
}

TEST(Pcd, EveryCorruptByteIsAnErrorOrAValidInput) {
  const TempFolder folder;
  for (const std::string data : {"ascii", "binary", "binary_compressed"}) {
    const std::string good = grid(data);
    for (std::size_t i = 0; i < good.size(); ++i) {
      std::string bad = good;
      bad[i] = static_cast<char>(bad[i] ^ 0x11);
      try {
        static_cast<void>(read_input({folder.write("c.pcd", bad)}, {}));
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_unreadable) << error.what();
      }
    }
  }
}

TEST(Pcd, SizesAreCheckedBeforeAnythingIsAllocated) {
  const TempFolder folder;
  const auto error = [&](const std::string& text) { return read_error(folder.write("e.pcd", text)); };
  const std::string huge = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 4294967295\nHEIGHT 1\nDATA binary";
  const ReadScan read = read_scan(folder.write("h.pcd", huge + "\n" + std::string(12, '\0')));
  EXPECT_EQ(read.file.points.size(), 1U);
  EXPECT_EQ(read.file.counts.missing, 4294967294U);
  EXPECT_NE(error(header(XYZ, 1000000, 1, "binary_compressed") + with_sizes("abc", 12000000))
                .find("expected at least an 88th"),
            std::string::npos);
  EXPECT_NE(error(header(XYZ, 3, 1, "binary_compressed") + with_sizes("abc", 12))
                .find("expected 3 points of 12 bytes"),
            std::string::npos);
  EXPECT_NE(error(header({{"x"}, {"y"}, {"z"}, {"w", "F", 8, 4000000}}, 1, 1, "binary"))
                .find("points of 32000012 bytes"),
            std::string::npos);
  const std::vector<Field> wide{{"x"}, {"y"}, {"z"}, {"w", "F", 8, 100000}};
  const std::string start = compressed(std::string(12000, '\0'));
  const auto peak_kib = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
  };
  const long before = peak_kib();
  EXPECT_EQ(read_scan(folder.write("w.pcd", header(wide, 1000, 1, "binary_compressed") +
                                                bytes_of(0xF0000000U) + bytes_of(800012000U) + start))
                .file.points.size(),
            1000U)
      << "the 800 MB that the file ends before are not needed";
  EXPECT_LT(peak_kib() - before, 64L << 10);
  const ReadScan more = read_scan(folder.write("m.pcd", header(XYZ, 1, 1, "ascii") + "1 2 3\n4 5 6\n"));
  EXPECT_EQ(more.file.points.size(), 1U);
  EXPECT_TRUE(more.has_note("more lines follow"));
}

TEST(Pcd, GridsThatAreNotTheirPointsAreNone) {
  const TempFolder folder;
  std::string text = header(XYZ, 2, 2, "ascii");
  text.replace(text.find("POINTS 4"), 8, "POINTS 3");
  const ReadScan read = read_scan(folder.write("g.pcd", text + "1 2 3\n4 5 6\n7 8 9\n"));
  EXPECT_EQ(read.file.points.size(), 3U);
  EXPECT_TRUE(read.file.points.grid_cell.empty());
  EXPECT_TRUE(read.has_note("without a grid"));
}

TEST(Pcd, ErrorsSayWhatIsWrong) {
  const TempFolder folder;
  const auto error = [&](std::string text, const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
    return read_error(folder.write("e.pcd", text));
  };
  const std::string good = header(XYZ, 2, 1, "ascii") + "1 2 3\n4 5 6\n";
  EXPECT_NE(error(good, "FIELDS x y z", "FIELDS x y w").find("found the fields 'x', 'y', 'w'"),
            std::string::npos);
  EXPECT_NE(error(good, "TYPE F F F", "TYPE F F").find("2 TYPEs"), std::string::npos);
  EXPECT_NE(error(good, "SIZE 4 4 4", "SIZE 4 4 3").find("SIZE '3'"), std::string::npos);
  EXPECT_NE(error(good, "DATA ascii", "DATA text").find("line 11: found DATA 'text'"), std::string::npos);
  EXPECT_NE(error(good, "WIDTH 2", "WIDTH -2").find("line 7: found no whole number for WIDTH"),
            std::string::npos);
  EXPECT_NE(error(good, "4 5 6", "4 5 6 7").find("line 13: found 4 numbers, expected 3"), std::string::npos);
  EXPECT_NE(error(good, "VERSION .7", "VERZION .7").find("line 2: found 'VERZION'"), std::string::npos);
  EXPECT_NE(error(good, "DATA ascii\n1 2 3\n4 5 6\n", "").find("no DATA line"), std::string::npos);
}

TEST(Lzf, RepeatsMayOverlapAndNeverReachBeyondTheirBuffers) {
  const auto decompress = [](const std::string& bytes, std::size_t size) {
    std::string out(size, '?');
    const auto* from = reinterpret_cast<const unsigned char*>(bytes.data());
    const std::size_t written =
        decompress_lzf({from, bytes.size()}, {reinterpret_cast<unsigned char*>(out.data()), size});
    return out.substr(0, written);
  };
  EXPECT_EQ(decompress(std::string("\2abc\x20\2", 6), 99), "abcabc");
  EXPECT_EQ(decompress(std::string("\0a\xE0\3\0", 5), 99), std::string(13, 'a'));
  EXPECT_EQ(decompress(std::string("\0a\xE0\3\0", 5), 7), "aaaaaaa");
  EXPECT_EQ(decompress(std::string("\0a\x20\5", 4), 99), "a") << "refers to what is not there";
  EXPECT_EQ(decompress(std::string("\x1F"
                                   "ab",
                                   3),
                       99),
            "ab");
  EXPECT_EQ(decompress("\xE0", 99), "");
}

}  // namespace
}  // namespace splatray
