/// E57 files that are damaged, cut off or made to harm.
#include <sys/resource.h>

#include <algorithm>

#include "preprocess/read/e57/read_e57.h"
#include "tests/readers/e57/e57_writer.h"
#include "tests/readers/read_error.h"
#include "tests/temp_folder.h"

namespace splatray {
namespace {

using testing::e57_bytes;
using testing::e57_content;
using testing::e57_pages;
using testing::E57TestField;
using testing::E57TestFile;
using testing::E57TestScan;

E57TestScan simple_scan(int count) {
  std::vector<double> x;
  for (int i = 0; i < count; ++i) x.push_back(i + 1.0);
  E57TestScan scan;
  scan.packet_bytes = 400;
  scan.fields = {E57TestField::float64("cartesianX", x), E57TestField::float64("cartesianY", x),
                 E57TestField::float64("cartesianZ", x)};
  return scan;
}

ScanFile read_bytes(const std::string& bytes, std::vector<std::string>& notes,
                    const ReadOptions& options = {}) {
  const TempFolder folder;
  return read_e57(folder.write("a.e57", bytes), options, {notes, options.progress});
}

/// Expects a refusal that holds `words`, and no more than 64 MiB of memory touched beyond what was before.
void expect_refusal(const std::string& bytes, const std::string& words, const ReadOptions& options = {}) {
  const TempFolder folder;
  const auto peak_kib = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
  };
  const long before = peak_kib();
  const std::string error = read_error(folder.write("a.e57", bytes), options);
  EXPECT_NE(error.find(words), std::string::npos) << error;
  EXPECT_LT(peak_kib() - before, 64L << 10);
}

/// The bytes with `from` in the content replaced by `to`, as long; checksums are put right.
std::string replaced(const std::string& bytes, const std::string& from, const std::string& to) {
  std::string content = e57_content(bytes);
  const std::size_t at = content.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  EXPECT_EQ(from.size(), to.size());
  return e57_pages(content.replace(at, from.size(), to));
}

/// The bytes with some of the content overwritten.
std::string overwritten(const std::string& bytes, std::size_t at, const std::string& with) {
  return e57_pages(e57_content(bytes).replace(at, with.size(), with));
}

TEST(E57Hostile, ADamagedPageIsNamedAndReadOnlyWhenAskedTo) {
  std::string bytes = e57_bytes(simple_scan(500));
  bytes[5 * 1024 + 100] = static_cast<char>(bytes[5 * 1024 + 100] ^ 1);
  expect_refusal(bytes, "page 5 (from byte 5120) does not match its checksum");
  ReadOptions options;
  options.scans.ignore_checksums = true;
  std::vector<std::string> notes;
  EXPECT_EQ(read_bytes(bytes, notes, options).points.size(), 500U);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("page 5"), std::string::npos);
}

TEST(E57Hostile, ADamagedHeaderIsNamedBeforeItIsBelieved) {
  std::string bytes = e57_bytes(simple_scan(10));
  bytes[25] = static_cast<char>(bytes[25] ^ 0x7F);  // of the XML section's offset
  expect_refusal(bytes, "page 0 (from byte 0) does not match its checksum");
}

TEST(E57Hostile, ACutFileGivesWhatIsThere) {
  E57TestFile file{{simple_scan(1000)}};
  file.xml_first = true;
  const std::string bytes = e57_bytes(file);
  for (const std::size_t cut : {bytes.size() / 2, bytes.size() / 2 + 300, bytes.size() - 1}) {
    std::vector<std::string> notes;
    const ScanFile read = read_bytes(bytes.substr(0, cut), notes);
    EXPECT_GT(read.points.size(), 400U);
    EXPECT_LT(read.points.size(), 1000U);
    EXPECT_EQ(read.counts.missing, 1000U - read.points.size());
    EXPECT_EQ(read.points.position.back(), glm::dvec3(static_cast<double>(read.points.size())));
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_NE(notes[0].find("of the 1000 records that it names; the file is cut off"), std::string::npos)
        << notes[0];
    ReadOptions strict;
    strict.scans.strict = true;
    expect_refusal(bytes.substr(0, cut), "of the 1000 records that it names, expected all", strict);
  }
}

TEST(E57Hostile, ACutFileWithoutItsDescriptionIsRefused) {
  const std::string bytes = e57_bytes(simple_scan(1000));
  expect_refusal(bytes.substr(0, bytes.size() / 2), "the file is cut off, and with it the XML section");
  expect_refusal(bytes.substr(0, 500), "expected at least one page");
}

TEST(E57Hostile, WrongCountsOfRecords) {
  E57TestScan scan = simple_scan(100);
  scan.more_records = -40;
  std::vector<std::string> notes;
  EXPECT_EQ(read_bytes(e57_bytes(scan), notes).points.size(), 60U) << "the count rules";
  EXPECT_TRUE(notes.empty());
  for (const std::int64_t more : {std::int64_t{1}, std::int64_t{1} << 46U}) {
    scan.more_records = more;
    notes.clear();
    const ScanFile file = read_bytes(e57_bytes(scan), notes);
    EXPECT_EQ(file.points.size(), 100U);
    EXPECT_EQ(file.counts.missing, static_cast<std::uint64_t>(more));
    EXPECT_LT(file.points.position.capacity(), 10000U);
    EXPECT_EQ(notes.size(), 1U);
  }
  scan.more_records = std::int64_t{1} << 60U;
  expect_refusal(e57_bytes(scan), "expected at most 2^47");
  const std::string bytes = e57_bytes(simple_scan(100));
  expect_refusal(replaced(bytes, "recordCount=\"100\"", "recordCount=\"-10\""), "recordCount '-10'");
  expect_refusal(replaced(bytes, "recordCount=\"100\"", "recordCount=\"1e2\""), "recordCount '1e2'");
}

TEST(E57Hostile, RecordsWithoutBitsAreNotBelievedWithoutEnd) {
  E57TestScan scan;
  for (const char* name : {"cartesianX", "cartesianY", "cartesianZ"})
    scan.fields.push_back(E57TestField::integer(name, 4, 4, {4, 4}));
  scan.more_records = std::int64_t{1} << 40U;
  std::vector<std::string> notes;
  const ScanFile file = read_bytes(e57_bytes(scan), notes);
  EXPECT_EQ(file.points.size(), 2048U);
  EXPECT_EQ(file.counts.missing, (std::uint64_t{1} << 40U) + 2 - 2048);
}

TEST(E57Hostile, ForgedHeaders) {
  const std::string bytes = e57_bytes(simple_scan(10));
  const std::string huge(8, '\x7F');
  expect_refusal("ASTM-E58" + bytes.substr(8), "found no signature");
  expect_refusal(overwritten(bytes, 8, std::string("\2\0\0\0", 4)), "version 2");
  expect_refusal(overwritten(bytes, 24, huge), "expected");
  expect_refusal(overwritten(bytes, 32, huge), "without which no scan can be read");
  expect_refusal(overwritten(bytes, 40, std::string("\0\2\0\0\0\0\0\0", 8)), "pages of 512 bytes");
  expect_refusal(overwritten(bytes, 24, std::string("\xFD\3\0\0\0\0\0\0", 8)), "where a page's checksum is");
}

/// Of a scan of ten points: its section begins at byte 48, its first packet at 80.
TEST(E57Hostile, ForgedSectionsAndPackets) {
  const std::string bytes = e57_bytes(simple_scan(10));
  const std::string huge(8, '\x7F');
  expect_refusal(overwritten(bytes, 48, "\5"), "a section of type 5");
  expect_refusal(replaced(bytes, "fileOffset=\"000000000048\"", "fileOffset=\"999999999900\""),
                 "points beyond the file's");
  expect_refusal(overwritten(bytes, 80, "\7"), "the type 7");
  expect_refusal(overwritten(bytes, 82, std::string("\1\0", 2)), "a length of 2 bytes");
  expect_refusal(overwritten(bytes, 84, "\4"), "4 streams, expected 3");
  expect_refusal(overwritten(bytes, 82, std::string("\x08\0", 2)), "its header beyond its end");
  expect_refusal(overwritten(bytes, 86, "\xFF\xFF"), "a stream beyond its end");
  std::vector<std::string> notes;
  EXPECT_EQ(read_bytes(overwritten(bytes, 56, huge), notes).points.size(), 10U)
      << "a section's length too large";
  EXPECT_TRUE(notes.empty());
  EXPECT_EQ(read_bytes(overwritten(bytes, 56, std::string(8, '\0')), notes).points.size(), 0U);
  EXPECT_EQ(notes.size(), 1U);
  EXPECT_EQ(read_bytes(overwritten(bytes, 64, std::string("\0\0\0\0\1\0\0\0", 8)), notes).counts.missing,
            10U);
  EXPECT_EQ(read_bytes(overwritten(bytes, 82, "\xFF\xFF"), notes).counts.missing, 10U) << "ends in a packet";
}

TEST(E57Hostile, ScansThatShareTheirBytesAreRefused) {
  E57TestFile file{{simple_scan(10), simple_scan(10)}};
  const std::string bytes = e57_bytes(file);
  const std::string content = e57_content(bytes);
  const std::size_t second = content.find("fileOffset", content.find("fileOffset") + 1);
  std::string twice = content;
  twice.replace(second + 12, 12, content, content.find("fileOffset") + 12, 12);
  expect_refusal(e57_pages(twice), "two scans with the same points");
}

TEST(E57Hostile, ASectionEndsWhereTheNextBegins) {
  E57TestFile file{{simple_scan(10), simple_scan(10)}};
  file.scans[0].more_records = 5;
  std::vector<std::string> notes;
  const ScanFile read = read_bytes(overwritten(e57_bytes(file), 56, std::string(8, '\x7F')), notes);
  EXPECT_EQ(read.points.size(), 20U)
      << "a section's length too large does not give it the next scan's points";
  EXPECT_EQ(read.counts.missing, 5U);
}

TEST(E57Hostile, HarmfulXml) {
  E57TestFile file{{simple_scan(10)}};
  file.prolog = "<!DOCTYPE a [<!ENTITY b \"c\"><!ENTITY d \"&b;&b;&b;&b;&b;&b;&b;\">]>";
  expect_refusal(e57_bytes(file), "found a document type");
  file.prolog.clear();
  for (int i = 0; i < 100000; ++i) file.images += "<a>";
  expect_refusal(e57_bytes(file), "nests more than 64 deep");
  file.images = "<a></b>";
  expect_refusal(e57_bytes(file), "not well-formed");
  file.images = "\x01";
  expect_refusal(e57_bytes(file), "not well-formed");
  file.images = "&b;";
  expect_refusal(e57_bytes(file), "not well-formed");
}

TEST(E57Hostile, PrototypesThatAreNone) {
  E57TestScan scan = simple_scan(2);
  const auto refused = [&](const std::string& words) { expect_refusal(e57_bytes(scan), words); };
  scan.fields[0].attributes = " type=\"Blob\"";
  refused("type 'Blob'");
  scan.fields[0].attributes = " type=\"ScaledInteger\" minimum=\"0\" maximum=\"9\" scale=\"0\"";
  refused("a scale or offset that makes no numbers");
  scan.fields[0].attributes = " type=\"Float\"><inner type=\"Float\"/";
  refused("fields within the field 'cartesianX'");
  scan = simple_scan(2);
  scan.fields.pop_back();
  refused("no coordinates");
  scan = simple_scan(2);
  scan.codecs = "<codecs><vectorChild><inputs/><zipCodec/></vectorChild></codecs>";
  refused("packed with 'zipCodec'");
  scan = simple_scan(2);
  scan.xml = testing::e57_pose({1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
  scan.xml.replace(scan.xml.rfind(">0<"), 3, ">a<");
  refused("found z 'a' in a pose");
}

/// Reads bytes that may be no file any more: only a sentence may come of it, or points.
void expect_sane(const TempFolder& folder, const std::string& bytes) {
  try {
    EXPECT_GT(read_input({folder.write("a.e57", bytes)}, {}).objects.at(0).points.size(), 0U);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::input_unreadable) << error.what();
  }
}

TEST(E57Hostile, FilesCutAnywhereEndInASentenceOrInPoints) {
  const TempFolder folder;
  E57TestFile file{{simple_scan(100)}};
  file.xml_first = true;
  const std::string bytes = e57_bytes(file);
  for (std::size_t length = 0; length < bytes.size(); length += 13)
    expect_sane(folder, bytes.substr(0, length));
}

/// All bytes of the header, the section and its packets; of the XML every third, as each change costs a file.
TEST(E57Hostile, ChangedBytesEndInASentenceOrInPoints) {
  const TempFolder folder;
  E57TestScan scan = simple_scan(3);
  scan.fields.push_back(E57TestField::integer("intensity", 0, 100, {1, 2, 3}));
  scan.has_other_packets = true;
  const std::string content = e57_content(e57_bytes(scan));
  const std::size_t xml = content.find("<?xml");
  for (std::size_t at = 0; at < content.size(); at += at < xml ? 1 : 3)
    for (const int change : {1, 0xFF}) {
      std::string changed = content;
      changed[at] = static_cast<char>(changed[at] ^ change);
      expect_sane(folder, e57_pages(changed));
    }
}

}  // namespace
}  // namespace splatray
