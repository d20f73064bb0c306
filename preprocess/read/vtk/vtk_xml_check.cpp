#include "preprocess/read/vtk/vtk_xml_check.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "preprocess/read/bytes/byte_reader.h"

namespace splatray {
namespace {

constexpr std::size_t MOST_VTK_DEPTH = 64;
constexpr std::size_t MOST_TAG_BYTES = 65536;
constexpr std::uint64_t MOST_GROWTH = 1032;  ///< of zlib's; real points compress far less with any method
constexpr std::uint64_t MOST_COUNTS_COMPRESSED = 16;  ///< points or cells for a byte of the file
constexpr std::size_t MOST_WORDS = 3;                 ///< of an array's header that are looked at
constexpr std::size_t ARRAY_HEADER_BYTES = 8 * MOST_WORDS;

using Attributes = std::map<std::string, std::string>;

std::string value_of(const Attributes& attributes, const std::string& name) {
  const auto found = attributes.find(name);
  return found == attributes.end() ? "" : found->second;
}

/// The bytes that the first letters of a base64 text stand for, up to a letter that is none.
std::string from_base64(const std::string& text) {
  std::string bytes;
  std::uint32_t word = 0;
  int bits = 0;
  for (const char c : text) {
    static const std::string DIGITS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t digit = DIGITS.find(c);
    if (digit == std::string::npos) break;
    word = word << 6U | static_cast<std::uint32_t>(digit);
    bits += 6;
    if (bits >= 8) {
      bits -= 8;
      bytes += static_cast<char>(word >> static_cast<unsigned>(bits) & 0xFFU);
    }
  }
  return bytes;
}

class XmlScan {
 public:
  XmlScan(const std::filesystem::path& path, const ReadListener& listener)
      : in_(path, &listener), size_(in_.remaining()) {}

  std::vector<std::string> scan() {
    for (int c = next(); c >= 0; c = next()) {
      if (c == 0) fail("found a zero byte in its XML, expected UTF-8 text");
      if (c == '<') {
        check_inline_array();
        if (!read_markup()) break;
      } else if (in_array_ && c > ' ' && array_text_.size() < 4 * ARRAY_HEADER_BYTES / 3) {
        array_text_ += static_cast<char>(c);
      }
    }
    return std::move(sources_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw_unreadable(in_.path(), what); }

  int next() {
    const unsigned char* byte = in_.take(1);
    return byte == nullptr ? -1 : *byte;
  }

  /// Reads on after '<'; false when what follows is no XML any more.
  bool read_markup() {
    std::string tag;
    char quote = 0;
    for (int c = next(); c >= 0 && (c != '>' || quote != 0); c = next()) {
      if (tag.size() >= MOST_TAG_BYTES) {
        fail("found a tag of more than " + std::to_string(MOST_TAG_BYTES) + " bytes");
      }
      tag += static_cast<char>(c);
      if (tag == "!--") return skip_comment();
      if (quote == 0 && (c == '"' || c == '\'')) {
        quote = static_cast<char>(c);
      } else if (c == quote) {
        quote = 0;
      }
    }
    if (tag.starts_with('!')) fail("found '<!', expected XML without document types and CDATA");
    if (tag.starts_with('/')) {
      depth_ -= depth_ > 0 ? 1 : 0;
    } else if (!tag.starts_with('?')) {
      return read_element(tag);
    }
    return true;
  }

  bool skip_comment() {
    std::string last;
    for (int c = next(); c >= 0; c = next()) {
      last = (last + static_cast<char>(c));
      if (last.size() > 3) last.erase(0, 1);
      if (last == "-->") break;
    }
    return true;
  }

  bool read_element(const std::string& tag) {
    const std::string name = tag.substr(0, tag.find_first_of(" \t\r\n/"));
    const Attributes attributes = read_attributes(tag);
    const bool has_content = tag.empty() || tag.back() != '/';
    depth_ += has_content ? 1 : 0;
    if (depth_ > MOST_VTK_DEPTH)
      fail("its elements nest more than " + std::to_string(MOST_VTK_DEPTH) + " deep");
    if (name == "VTKFile") read_file_attributes(attributes);
    if (name == "Piece" && attributes.count("Source") > 0) sources_.push_back(value_of(attributes, "Source"));
    if (name == "Array" || name == "DataArray") check_type(value_of(attributes, "type"));
    check_counts(attributes);
    if (name == "AppendedData") {
      check_appended_arrays(value_of(attributes, "encoding") == "base64");
      return false;
    }
    if (value_of(attributes, "format") == "appended") {
      offsets_.push_back(whole_number("offset", value_of(attributes, "offset")));
    }
    in_array_ = has_content && value_of(attributes, "format") == "binary";
    array_text_.clear();
    return true;
  }

  Attributes read_attributes(const std::string& tag) const {
    Attributes attributes;
    std::size_t at = 0;
    for (;;) {
      const std::size_t equals = tag.find('=', at);
      const std::size_t open = tag.find_first_of("\"'", equals == std::string::npos ? tag.size() : equals);
      const std::size_t close = open == std::string::npos ? open : tag.find(tag[open], open + 1);
      if (close == std::string::npos) return attributes;
      std::string name = tag.substr(at, equals - at);
      name.erase(name.find_last_not_of(" \t\r\n") + 1);
      name.erase(0, name.find_last_of(" \t\r\n") + 1);  // npos + 1 = 0
      attributes[name] = tag.substr(open + 1, close - open - 1);
      at = close + 1;
    }
  }

  void read_file_attributes(const Attributes& attributes) {
    word_bytes_ = value_of(attributes, "header_type") == "UInt64" ? 8 : 4;
    big_endian_ = value_of(attributes, "byte_order") == "BigEndian";
    compressed_ = !value_of(attributes, "compressor").empty();
  }

  std::uint64_t whole_number(const std::string& name, const std::string& text) const {
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (text.empty() || error != std::errc{} || end != text.data() + text.size()) {
      fail("found " + name + " '" + text.substr(0, 20) + "', expected a whole number");
    }
    return number;
  }

  /// VTK (9.1) reads through a null pointer where data beside the points are of a type that it does not know.
  void check_type(const std::string& type) const {
    constexpr std::array TYPES{"Int8",  "UInt8",  "Int16",   "UInt16",  "Int32",  "UInt32",
                               "Int64", "UInt64", "Float32", "Float64", "String", "Bit"};
    if (std::find(TYPES.begin(), TYPES.end(), type) == TYPES.end())
      fail("found an array of type '" + type + "', expected one of VTK's, such as Float32");
  }

  /// All that VTK makes arrays of before it sees their content.
  void check_counts(const Attributes& attributes) {
    const std::uint64_t most = size_ * (compressed_ ? MOST_COUNTS_COMPRESSED : 1);
    for (const auto& [name, value] : attributes) {
      if (!name.starts_with("NumberOf") && name != "length") continue;
      const std::uint64_t count = whole_number(name, value);
      const bool factor = name == "NumberOfComponents";
      const std::uint64_t product = factor ? largest_count_ : 1;
      if (count > most || (count > 0 && product > most / count) || (!factor && all_counts_ > most - count)) {
        fail("found " + name + " " + value + ", expected one that fits a file of " + std::to_string(size_) +
             " bytes");
      }
      all_counts_ += factor ? 0 : count;
      largest_count_ = factor ? largest_count_ : std::max(largest_count_, count);
    }
  }

  void check_inline_array() {
    if (in_array_) check_array(from_base64(array_text_));
    in_array_ = false;
  }

  /// `start`: an array's first bytes. Plain: its size. Compressed: blocks, bytes of a block, bytes of the last.
  void check_array(const std::string& start) const {
    std::array<std::uint64_t, MOST_WORDS> words{};
    for (std::size_t i = 0; i < std::min(MOST_WORDS, start.size() / word_bytes_); ++i) {
      for (std::size_t byte = 0; byte < word_bytes_; ++byte) {
        const std::size_t from = i * word_bytes_ + (big_endian_ ? byte : word_bytes_ - 1 - byte);
        words[i] = words[i] << 8U | static_cast<unsigned char>(start[from]);
      }
    }
    const auto [first, block, last] = words;
    const std::uint64_t most = size_ * MOST_GROWTH;
    const bool fits = compressed_ ? first <= size_ / word_bytes_ && block <= most && last <= most &&
                                        (first == 0 || (block > 0 && block <= most / first))
                                  : first <= size_;
    if (!fits) {
      fail(compressed_ ? "found an array of " + std::to_string(first) + " compressed blocks of " +
                             std::to_string(block) + " bytes, expected what fits a file of " +
                             std::to_string(size_) + " bytes"
                       : "found an array of " + std::to_string(first) +
                             " bytes, expected it within a file of " + std::to_string(size_));
    }
  }

  /// The arrays after '_': `base64` or raw.
  void check_appended_arrays(bool base64) {
    for (int c = next(); c != '_'; c = next()) {
      if (c < 0) return;
    }
    const std::uint64_t begin = in_.offset();
    std::sort(offsets_.begin(), offsets_.end());
    offsets_.erase(std::unique(offsets_.begin(), offsets_.end()), offsets_.end());
    std::string seen;  // the last bytes read, as arrays may begin within each other's headers
    for (const std::uint64_t offset : offsets_) {
      const std::uint64_t passed = in_.offset() - begin;
      if (offset > size_ || (offset >= passed && !in_.skip(offset - passed))) {
        fail("found an array at offset " + std::to_string(offset) + ", expected it within the file");
      }
      seen.erase(0, offset >= passed ? seen.size() : seen.size() - static_cast<std::size_t>(passed - offset));
      for (int c = 0;
           seen.size() < (base64 ? 4 * ARRAY_HEADER_BYTES / 3 : ARRAY_HEADER_BYTES) && (c = next()) >= 0;) {
        seen += static_cast<char>(c);
      }
      check_array(base64 ? from_base64(seen) : seen);
    }
  }

  ByteReader in_;
  std::uint64_t size_;
  std::size_t depth_ = 0;
  std::size_t word_bytes_ = 4;
  bool big_endian_ = false;
  bool compressed_ = false;
  std::uint64_t all_counts_ = 0;
  std::uint64_t largest_count_ = 1;
  bool in_array_ = false;
  std::string array_text_;
  std::vector<std::uint64_t> offsets_;
  std::vector<std::string> sources_;
};

}  // namespace

std::vector<std::string> check_vtk_xml(const std::filesystem::path& path, const ReadListener& listener) {
  return XmlScan(path, listener).scan();
}

}  // namespace splatray
