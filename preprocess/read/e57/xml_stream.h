/// XML of an E57 file as a stream of elements, from libexpat.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "preprocess/read/e57/paged_file.h"

namespace splatray {

/// The names of open elements, from the root. Names of E57's own namespace have no prefix, those of the normals extension
/// have "nor:", all others keep theirs.
using XmlPath = std::vector<std::string>;

/// The attributes of one element.
class XmlAttributes {
 public:
  /// `pairs`: names and values in turn, a null pointer at the end.
  explicit XmlAttributes(const char** pairs) : pairs_(pairs) {}

  /// Empty where there is no such attribute.
  [[nodiscard]] std::string value(const std::string& name) const;

 private:
  const char** pairs_;
};

/// Hears of elements; may throw.
class XmlReceiver {
 public:
  XmlReceiver() = default;
  XmlReceiver(const XmlReceiver&) = delete;
  XmlReceiver& operator=(const XmlReceiver&) = delete;
  virtual ~XmlReceiver() = default;
  /// `at` ends with the element that begins.
  virtual void begin(const XmlPath& at, const XmlAttributes& attributes) = 0;
  /// `text`: what stands behind the last tag before this end, at most 4096 bytes of it.
  virtual void end(const XmlPath& at, const std::string& text) = 0;
};

/// Parses `size` bytes from where the file stands, up to the root element's end. Throws Error (input_unreadable) where they
/// are not well-formed XML, elements nest more than 64 deep or there is a document type.
void stream_xml(PagedFile& file, std::uint64_t size, XmlReceiver& receiver);

}  // namespace splatray
