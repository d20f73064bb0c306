/// LAZ files: those of the fuzzer's corpus beside the same points in LAS, and what is left of damaged ones.
#include <cstring>
#include <fstream>
#include <iterator>

#include "preprocess/base/thread_limit.h"
#include "preprocess/read/las/read_las.h"
#include "tests/all_tests.h"
#include "tests/readers/las_file.h"
#include "tests/readers/read_error.h"
#include "tests/temp_folder.h"

namespace splatray {
namespace {

ReadOptions everything() {
  ReadOptions options;
  options.scans.keep_withheld = true;
  options.scans.attributes = {"a", "b", "c", "v", "user_data", "scan_angle", "scanner_channel", "nir"};
  return options;
}

ScanFile read_file(const std::filesystem::path& file, const ReadOptions& options) {
  std::vector<std::string> notes;
  return read_las(file, options, {notes, options.progress});
}

void expect_equal(const Points& a, const Points& b) {
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.stored_color, b.stored_color);
  ASSERT_EQ(a.columns.size(), b.columns.size());
  for (std::size_t i = 0; i < a.columns.size(); ++i) {
    EXPECT_EQ(a.columns[i].name, b.columns[i].name);
    EXPECT_TRUE(a.columns[i].values == b.columns[i].values) << a.columns[i].name;
  }
}

std::string bytes_of_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::filesystem::path corpus(const std::string& name) { return std::filesystem::path(CORPUS) / "las" / name; }

/// Puts a number into bytes.
template <class T>
void put(std::string& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

std::uint64_t table_offset(const std::string& bytes) {
  std::uint64_t offset = 0;
  std::memcpy(&offset, bytes.data() + las_points_offset(bytes), sizeof offset);
  return offset;
}

/// Pointwise chunks of 25 and 15 points, layered ones of 20, 1 and 19.
const char* const POINTWISE = "pf5_items_v2.laz";
const char* const LAYERED = "pf8_items_v3.laz";
/// All points in one chunk without a table.
const char* const ONE_CHUNK = "pf1_items_v1_one_chunk.laz";

TEST(Laz, EveryKindOfItemGivesThePointsOfTheLasFile) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(corpus(""))) {
    std::filesystem::path las = entry.path();
    if (las.extension() != ".laz" || !std::filesystem::exists(las.replace_extension(".las"))) continue;
    SCOPED_TRACE(entry.path());
    const ScanFile expected = read_file(las, everything());
    EXPECT_EQ(expected.points.size(), 40U);
    const bool timed =
        !entry.path().filename().string().starts_with("pf2");  // formats 0 and 2 have no GPS time
    EXPECT_GE(expected.points.columns.size(), timed ? 5U : 4U);
    expect_equal(read_file(entry.path(), everything()).points, expected.points);
    ++files;
  }
  EXPECT_EQ(files, 8U);
}

TEST(Laz, ThreadsDoNotMatter) {
  ReadOptions options;
  const Points together = read_file(corpus(LAYERED), options).points;
  const ThreadLimit limit(1);
  expect_equal(read_file(corpus(LAYERED), options).points, together);
  EXPECT_LT(together.size(), 40U);
  EXPECT_GT(together.size(), 10U);
}

TEST(Laz, TheTablesPlaceMayStandAtTheEnd) {
  const TempFolder folder;
  std::string bytes = bytes_of_file(corpus(POINTWISE));
  const Points expected = read_file(corpus(POINTWISE), everything()).points;
  bytes += bytes_of(table_offset(bytes));
  put(bytes, las_points_offset(bytes), ~std::uint64_t{0});
  expect_equal(read_file(folder.write("a.laz", bytes), everything()).points, expected);
}

TEST(Laz, AMissingTableIsNotNeeded) {
  const TempFolder folder;
  for (const char* name : {POINTWISE, LAYERED}) {
    SCOPED_TRACE(name);
    const Points expected = read_file(corpus(name), everything()).points;
    const std::string bytes = bytes_of_file(corpus(name));
    // The program was stopped before it wrote the table; the file was cut off behind the chunks; the table is nonsense.
    std::string stopped = bytes.substr(0, table_offset(bytes));
    expect_equal(read_file(folder.write("a.laz", stopped), everything()).points, expected);
    put(stopped, las_points_offset(bytes), std::uint64_t{las_points_offset(bytes)});
    expect_equal(read_file(folder.write("b.laz", stopped), everything()).points, expected);
    std::string nonsense = bytes;
    put(nonsense, table_offset(bytes) + 4, 0xFFFFFFFFU);
    expect_equal(read_file(folder.write("c.laz", nonsense), everything()).points, expected);
  }
}

TEST(Laz, AFileThatEndsInAChunkGivesThoseBefore) {
  const TempFolder folder;
  const std::pair<const char*, std::size_t> cases[] = {{POINTWISE, 25}, {LAYERED, 21}};
  for (const auto& [name, whole] : cases) {
    SCOPED_TRACE(name);
    const Points expected = read_file(corpus(name), everything()).points;
    const std::string bytes = bytes_of_file(corpus(name));
    const auto file = folder.write("a.laz", bytes.substr(0, table_offset(bytes) - 60));
    const ScanFile part = read_file(file, everything());
    ASSERT_EQ(part.points.size(), whole);
    EXPECT_EQ(part.counts.missing, 40 - whole);
    EXPECT_TRUE(
        std::equal(part.points.position.begin(), part.points.position.end(), expected.position.begin()));
    ReadOptions strict = everything();
    strict.scans.strict = true;
    EXPECT_NE(read_error(file, strict).find("whole points, expected the 40"), std::string::npos);
  }
}

/// Has the header count so many points.
void claim(std::string& bytes, std::uint32_t count) {
  put(bytes, 107, count);
  if (bytes[25] >= 4) put(bytes, 247, std::uint64_t{count});
}

TEST(Laz, CountsBeyondTheChunksGiveThePointsThereAre) {
  const TempFolder folder;
  for (const char* name : {POINTWISE, LAYERED, ONE_CHUNK}) {
    SCOPED_TRACE(name);
    const Points expected = read_file(corpus(name), everything()).points;
    std::string bytes = bytes_of_file(corpus(name));
    for (const std::uint32_t count : {41U, 45U, 50U, 51U, 1000U}) {
      claim(bytes, count);
      const auto file = folder.write("a.laz", bytes);
      const ScanFile read = read_file(file, everything());
      expect_equal(read.points, expected);
      EXPECT_EQ(read.counts.missing, count - 40);
      ReadOptions strict = everything();
      strict.scans.strict = true;
      EXPECT_NE(read_error(file, strict).find("found 40 whole points, expected the"), std::string::npos);
    }
  }
}

TEST(Laz, ADamagedChunkIsLeftOut) {
  const TempFolder folder;
  std::string bytes = bytes_of_file(corpus(POINTWISE));
  // What no coder writes: an interval's value that is not below its length.
  std::uint16_t record_bytes = 0;
  std::memcpy(&record_bytes, bytes.data() + 105, sizeof record_bytes);
  put(bytes, las_points_offset(bytes) + 8 + record_bytes, 0xFFFFFFFFU);
  const ScanFile part = read_file(folder.write("a.laz", bytes), everything());
  EXPECT_EQ(part.points.size(), 15U);
  EXPECT_EQ(part.counts.missing, 25U);
}

TEST(Laz, AChunkThatDoesNotEndWhereItsBytesDoIsLeftOut) {
  const TempFolder folder;
  const Points expected = read_file(corpus(POINTWISE), everything()).points;
  const std::string bytes = bytes_of_file(corpus(POINTWISE));
  std::size_t noticed = 0;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < 64; ++i) {
    std::string damaged = bytes;
    damaged[las_points_offset(bytes) + 8 + 110 + i] ^= 4;
    const Points points = read_file(folder.write("a.laz", damaged), everything()).points;
    noticed += points.size() == 15 ? 1 : 0;
    wrong += points.size() == 40 && points.position != expected.position ? 1 : 0;
  }
  EXPECT_GE(noticed, 55U);
  EXPECT_LE(wrong, 4U);
}

TEST(Laz, DamagedBytesDoNoHarm) {
  const TempFolder folder;
  for (const char* name : {POINTWISE, LAYERED}) {
    const std::string bytes = bytes_of_file(corpus(name));
    for (std::size_t i = 0; i < bytes.size(); i += testing::all_or(3, 7)) {
      std::string damaged = bytes;
      damaged[i] = static_cast<char>(damaged[i] ^ (i % 2 == 0 ? 0xFF : 0x10));
      try {
        EXPECT_LE(read_file(folder.write("a.laz", damaged), everything()).points.size(), 40U) << i;
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_unreadable);
      }
    }
  }
}

TEST(Laz, UnknownCompressionIsRefused) {
  const TempFolder folder;
  const std::string bytes = bytes_of_file(corpus(POINTWISE));
  const std::size_t record = bytes.find("laszip encoded") - 2 + 54;
  const auto refusal = [&](std::size_t at, std::uint16_t value) {
    std::string other = bytes;
    put(other, record + at, value);
    return read_error(folder.write("a.laz", other));
  };
  EXPECT_NE(refusal(0, 4).find("LASzip compressor 4"), std::string::npos);
  EXPECT_NE(refusal(2, 1).find("coder 1"), std::string::npos);
  EXPECT_NE(refusal(34 + 4, 9).find("version 9"), std::string::npos);
  EXPECT_NE(refusal(34 + 2, 21).find("21 bytes"), std::string::npos);
  EXPECT_NE(refusal(32, 3).find("items of"), std::string::npos);
}

}  // namespace
}  // namespace splatray
