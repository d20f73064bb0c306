/// Writes E57 files for tests, byte by byte and bit by bit: slow, plain, and nothing shared with the reader.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace splatray::testing {

/// One field of a record with all its values.
struct E57TestField {
  std::string name;
  std::string attributes;  ///< of its element in the prototype
  unsigned bits = 0;       ///< of a value
  std::vector<std::uint64_t> packed;
  std::string text{};  ///< of the element: a value that other readers want to be in range

  static E57TestField float32(const std::string& name, const std::vector<float>& values);
  static E57TestField float64(const std::string& name, const std::vector<double>& values);
  static E57TestField integer(const std::string& name, std::int64_t minimum, std::int64_t maximum,
                              const std::vector<std::int64_t>& values);
  /// `values`: before scale and offset.
  static E57TestField scaled(const std::string& name, std::int64_t minimum, std::int64_t maximum,
                             double scale, double offset, const std::vector<std::int64_t>& values);
};

struct E57TestScan {
  std::string xml = "<name type=\"String\">scan</name>";  ///< name, pose, limits
  std::vector<E57TestField> fields{};
  std::size_t packet_bytes = 4000;  ///< of each stream in a packet
  bool has_other_packets = false;   ///< index packets and ignored ones between
  std::int64_t more_records = 0;    ///< that recordCount says
  std::string codecs = "<codecs type=\"Vector\" allowHeterogeneousChildren=\"1\"></codecs>";
};

struct E57TestFile {
  std::vector<E57TestScan> scans;
  std::string prolog = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>";
  std::string namespaces{};  ///< further attributes of the root
  std::string images{};      ///< in images2D
  std::string elements{};    ///< further ones of the root
  bool xml_first = false;    ///< the XML section stands before the points
  std::uint64_t hole = 0;    ///< pages after the first that are not in e57_bytes but belong between
};

/// A pose of a scan's `xml`; `rotation`: w x y z.
std::string e57_pose(const std::vector<double>& rotation, const std::vector<double>& translation);

/// The file, page after page with checksums.
std::string e57_bytes(const E57TestFile& file);
std::string e57_bytes(const E57TestScan& scan);

/// The content of all pages, without checksums, and back.
std::string e57_content(const std::string& bytes);
std::string e57_pages(std::string content);

}  // namespace splatray::testing
