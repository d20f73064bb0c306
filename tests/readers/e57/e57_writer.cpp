#include "tests/readers/e57/e57_writer.h"

#include <algorithm>
#include <bit>
#include <cstdio>

namespace splatray::testing {
namespace {

constexpr std::size_t PAGE = 1024;
constexpr std::size_t CONTENT = 1020;
constexpr std::size_t HEADER = 48;

std::string little_endian(std::uint64_t value, std::size_t bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xFFU);
  return text;
}

std::uint64_t physical(std::size_t content) { return content / CONTENT * PAGE + content % CONTENT; }

std::uint32_t checksum(const std::string& page) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char byte : page) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1U ^ ((crc & 1U) != 0 ? 0x82F63B78U : 0U);
  }
  return ~crc;
}

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string packed_bytes(const E57TestField& field) {
  std::string bytes((field.packed.size() * field.bits + 7) / 8, '\0');
  std::size_t at = 0;
  for (const std::uint64_t value : field.packed)
    for (unsigned bit = 0; bit < field.bits; ++bit, ++at)
      if ((value >> bit & 1U) != 0) bytes[at / 8] = static_cast<char>(bytes[at / 8] | 1 << at % 8);
  return bytes;
}

std::string other_packets() {
  const std::string index = '\0' + little_endian(0, 1) + little_endian(31, 2) + little_endian(1, 2) +
                            std::string(10, '\0') + little_endian(0, 8) + little_endian(48, 8);
  return index + '\2' + '\0' + little_endian(7, 2) + "skip";
}

/// The binary section's packets.
std::string packets(const E57TestScan& scan) {
  std::vector<std::string> streams;
  std::size_t longest = 0;
  for (const E57TestField& field : scan.fields) {
    streams.push_back(packed_bytes(field));
    longest = std::max(longest, streams.back().size());
  }
  std::string all;
  for (std::size_t from = 0; from < longest; from += scan.packet_bytes) {
    std::string lengths;
    std::string bytes;
    for (const std::string& stream : streams) {
      const std::string part = from < stream.size() ? stream.substr(from, scan.packet_bytes) : "";
      lengths += little_endian(part.size(), 2);
      bytes += part;
    }
    bytes.resize((6 + lengths.size() + bytes.size() + 3) / 4 * 4 - 6 - lengths.size());
    all += '\1' + std::string(1, '\0') + little_endian(6 + lengths.size() + bytes.size() - 1, 2) +
           little_endian(streams.size(), 2) + lengths + bytes;
    if (scan.has_other_packets) all += other_packets();
  }
  return all;
}

/// With its header, for a place in the content.
std::string section(const E57TestScan& scan, std::size_t at) {
  const std::string data = packets(scan);
  return '\1' + std::string(7, '\0') + little_endian(32 + data.size(), 8) +
         little_endian(physical(at + 32), 8) + little_endian(0, 8) + data;
}

std::string scan_xml(const E57TestScan& scan, std::size_t at) {
  const std::size_t records = scan.fields.empty() ? 0 : scan.fields[0].packed.size();
  char offset[24];
  std::snprintf(offset, sizeof offset, "%012llu", static_cast<unsigned long long>(physical(at)));
  std::string xml = "<vectorChild type=\"Structure\"><guid type=\"String\">{g}</guid>" + scan.xml +
                    "<points type=\"CompressedVector\" fileOffset=\"" + offset + "\" recordCount=\"" +
                    std::to_string(records + static_cast<std::uint64_t>(scan.more_records)) +
                    "\"><prototype type=\"Structure\">";
  for (const E57TestField& field : scan.fields)
    xml += "<" + field.name + field.attributes + ">" + field.text + "</" + field.name + ">";
  return xml + "</prototype>" + scan.codecs + "</points></vectorChild>\n";
}

std::string file_xml(const E57TestFile& file, const std::vector<std::size_t>& at) {
  std::string xml =
      file.prolog + "\n<e57Root type=\"Structure\" xmlns=\"http://www.astm.org/COMMIT/E57/2010-e57-v1.0\"" +
      file.namespaces +
      "><formatName type=\"String\">ASTM E57 3D Imaging Data File</formatName><guid "
      "type=\"String\">{f}</guid><versionMajor type=\"Integer\">1</versionMajor><versionMinor "
      "type=\"Integer\">0</versionMinor><data3D type=\"Vector\" allowHeterogeneousChildren=\"1\">";
  for (std::size_t i = 0; i < file.scans.size(); ++i) xml += scan_xml(file.scans[i], at[i]);
  return xml + "</data3D><images2D type=\"Vector\" allowHeterogeneousChildren=\"1\">" + file.images +
         "</images2D>" + file.elements + "</e57Root>\n";
}

E57TestField integers(const std::string& name, std::int64_t minimum, std::int64_t maximum,
                      const std::string& type, const std::vector<std::int64_t>& values) {
  const auto low = static_cast<std::uint64_t>(minimum);
  E57TestField field{name,
                     " type=\"" + type + "\" minimum=\"" + std::to_string(minimum) + "\" maximum=\"" +
                         std::to_string(maximum) + "\"",
                     static_cast<unsigned>(std::bit_width(static_cast<std::uint64_t>(maximum) - low)),
                     {},
                     std::to_string(minimum)};
  for (const std::int64_t value : values) field.packed.push_back(static_cast<std::uint64_t>(value) - low);
  return field;
}

}  // namespace

E57TestField E57TestField::float32(const std::string& name, const std::vector<float>& values) {
  E57TestField field{name, " type=\"Float\" precision=\"single\"", 32, {}};
  for (const float value : values) field.packed.push_back(std::bit_cast<std::uint32_t>(value));
  return field;
}

E57TestField E57TestField::float64(const std::string& name, const std::vector<double>& values) {
  E57TestField field{name, " type=\"Float\"", 64, {}};
  for (const double value : values) field.packed.push_back(std::bit_cast<std::uint64_t>(value));
  return field;
}

E57TestField E57TestField::integer(const std::string& name, std::int64_t minimum, std::int64_t maximum,
                                   const std::vector<std::int64_t>& values) {
  return integers(name, minimum, maximum, "Integer", values);
}

E57TestField E57TestField::scaled(const std::string& name, std::int64_t minimum, std::int64_t maximum,
                                  double scale, double offset, const std::vector<std::int64_t>& values) {
  E57TestField field = integers(name, minimum, maximum, "ScaledInteger", values);
  field.attributes += " scale=\"" + number(scale) + "\" offset=\"" + number(offset) + "\"";
  return field;
}

std::string e57_pose(const std::vector<double>& rotation, const std::vector<double>& translation) {
  const auto structure = [](const std::string& name, const std::string& axes,
                            const std::vector<double>& values) {
    std::string xml = "<" + name + " type=\"Structure\">";
    for (std::size_t i = 0; i < values.size(); ++i)
      xml +=
          "<" + axes.substr(i, 1) + " type=\"Float\">" + number(values[i]) + "</" + axes.substr(i, 1) + ">";
    return xml + "</" + name + ">";
  };
  return "<pose type=\"Structure\">" + (rotation.empty() ? "" : structure("rotation", "wxyz", rotation)) +
         (translation.empty() ? "" : structure("translation", "xyz", translation)) + "</pose>";
}

std::string e57_bytes(const E57TestFile& file) {
  std::vector<std::size_t> at(file.scans.size(), 0);
  const std::size_t xml_bytes = file_xml(file, at).size();
  const std::size_t hole = file.hole * CONTENT;
  std::size_t end = hole > 0 ? CONTENT + hole : HEADER;
  std::size_t xml_at = end;
  if (file.xml_first) end = (end + xml_bytes + 3) / 4 * 4;
  std::string sections;
  for (std::size_t i = 0; i < file.scans.size(); ++i) {
    at[i] = end + sections.size();
    sections += section(file.scans[i], at[i]);
  }
  const std::string xml = file_xml(file, at);
  std::string content(hole > 0 ? CONTENT : HEADER, '\0');
  if (file.xml_first) {
    content += xml;
    content.resize(end - hole);
    content += sections;
  } else {
    content += sections;
    xml_at = content.size() + hole;
    content += xml;
  }
  const std::size_t pages = (content.size() + CONTENT - 1) / CONTENT;
  const std::string header =
      "ASTM-E57" + little_endian(1, 4) + little_endian(0, 4) + little_endian((pages + file.hole) * PAGE, 8) +
      little_endian(physical(xml_at), 8) + little_endian(xml.size(), 8) + little_endian(PAGE, 8);
  return e57_pages(content.replace(0, HEADER, header));
}

std::string e57_bytes(const E57TestScan& scan) {
  E57TestFile file;
  file.scans.push_back(scan);
  return e57_bytes(file);
}

std::string e57_content(const std::string& bytes) {
  std::string content;
  for (std::size_t page = 0; page < bytes.size(); page += PAGE) content += bytes.substr(page, CONTENT);
  return content;
}

std::string e57_pages(std::string content) {
  content.resize((content.size() + CONTENT - 1) / CONTENT * CONTENT);
  std::string bytes;
  for (std::size_t from = 0; from < content.size(); from += CONTENT) {
    const std::string page = content.substr(from, CONTENT);
    const std::string crc = little_endian(checksum(page), 4);
    bytes += page + std::string(crc.rbegin(), crc.rend());
  }
  return bytes;
}

}  // namespace splatray::testing
