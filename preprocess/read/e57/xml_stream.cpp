#include "preprocess/read/e57/xml_stream.h"

#include <expat.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <string_view>

#include "engine/base/utf8.h"

namespace splatray {
namespace {

constexpr std::size_t MOST_E57_DEPTH = 64;
constexpr std::size_t MOST_TEXT = 4096;
constexpr std::uint64_t CHUNK_BYTES = 65536;
constexpr std::string_view E57_NAMESPACE = "http://www.astm.org/COMMIT/E57/";
constexpr std::string_view NORMALS_NAMESPACE = "http://www.libe57.org/E57_NOR_";

struct FreeParser {
  void operator()(XML_ParserStruct* parser) const { XML_ParserFree(parser); }
};

/// Between expat, which is C, and the receiver, which may throw.
class Stream {
 public:
  Stream(PagedFile& file, XmlReceiver& receiver)
      : file_(file), receiver_(receiver), parser_(XML_ParserCreate(nullptr)) {
    if (!parser_) throw std::bad_alloc();
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(parser_.get(), on_begin, on_end);
    XML_SetCharacterDataHandler(parser_.get(), on_text);
    XML_SetStartDoctypeDeclHandler(parser_.get(), on_doctype);
  }

  void parse(std::uint64_t size) {
    while (!finished_) {
      const auto count = static_cast<std::size_t>(std::min(size, CHUNK_BYTES));
      const unsigned char* bytes = file_.take(count);
      if (bytes == nullptr) fail("the XML section goes beyond the file");
      size -= count;
      const std::string text = next_text({reinterpret_cast<const char*>(bytes), count}, size == 0);
      const XML_Status status =
          XML_Parse(parser_.get(), text.data(), static_cast<int>(text.size()), size == 0 ? 1 : 0);
      if (thrown_) std::rethrow_exception(thrown_);
      if (status != XML_STATUS_OK && !finished_)
        fail("its XML section is not well-formed: " +
             std::string(XML_ErrorString(XML_GetErrorCode(parser_.get()))) + " in line " +
             std::to_string(XML_GetCurrentLineNumber(parser_.get())));
    }
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw_unreadable(file_.path(), what); }

  /// A chunk of the section as UTF-8, whatever its declaration says: some programs write names in Latin-1 under "UTF-8", which
  /// no parser takes. UTF-16, which begins with a mark, stays.
  std::string next_text(std::string_view chunk, bool last) {
    const auto begins = [&](std::string_view mark) { return chunk.starts_with(mark); };
    if (encoding_ == Encoding::unknown) {
      encoding_ = begins("\xFF\xFE") || begins("\xFE\xFF") ? Encoding::utf16 : Encoding::utf8;
      if (encoding_ == Encoding::utf8) XML_SetEncoding(parser_.get(), "UTF-8");
    }
    if (encoding_ == Encoding::utf16) return std::string(chunk);
    cut_ += chunk;
    const std::size_t left = last ? 0 : cut_utf8_bytes(cut_);
    std::string text = to_utf8(std::string_view(cut_).substr(0, cut_.size() - left));
    cut_.erase(0, cut_.size() - left);
    return text;
  }

  /// Keeps what `call` throws for after expat has returned.
  template <class Call>
  void guarded(const Call& call) {
    if (thrown_ || finished_) return;
    try {
      call();
    } catch (...) {
      thrown_ = std::current_exception();
      XML_StopParser(parser_.get(), XML_FALSE);
    }
  }

  void learn_prefixes(const char** attributes) {
    for (; *attributes != nullptr; attributes += 2) {
      const std::string_view name = attributes[0];
      const std::string_view uri = attributes[1];
      if (!name.starts_with("xmlns:")) continue;
      const std::string prefix(name.substr(6));
      if (uri.starts_with(E57_NAMESPACE)) prefixes_[prefix] = "";
      if (uri.starts_with(NORMALS_NAMESPACE)) prefixes_[prefix] = "nor:";
    }
  }

  [[nodiscard]] std::string standard_name(std::string_view name) const {
    const std::size_t colon = name.find(':');
    const auto known = colon == std::string_view::npos ? prefixes_.end()
                                                       : prefixes_.find(std::string(name.substr(0, colon)));
    return known == prefixes_.end() ? std::string(name) : known->second + std::string(name.substr(colon + 1));
  }

  static void on_begin(void* self, const char* name, const char** attributes) {
    auto& stream = *static_cast<Stream*>(self);
    stream.guarded([&] {
      if (stream.path_.size() == MOST_E57_DEPTH)
        stream.fail("its XML nests more than " + std::to_string(MOST_E57_DEPTH) + " deep");
      stream.learn_prefixes(attributes);
      stream.path_.push_back(stream.standard_name(name));
      stream.text_.clear();
      stream.receiver_.begin(stream.path_, XmlAttributes(attributes));
    });
  }

  static void on_end(void* self, const char*) {
    auto& stream = *static_cast<Stream*>(self);
    stream.guarded([&] {
      stream.receiver_.end(stream.path_, stream.text_);
      stream.path_.pop_back();
      stream.text_.clear();
      stream.finished_ = stream.path_.empty();
      if (stream.finished_) XML_StopParser(stream.parser_.get(), XML_FALSE);
    });
  }

  static void on_text(void* self, const char* text, int length) {
    auto& stream = *static_cast<Stream*>(self);
    stream.guarded([&] {
      const std::size_t room = MOST_TEXT - stream.text_.size();
      stream.text_.append(text, std::min(room, static_cast<std::size_t>(length)));
    });
  }

  static void on_doctype(void* self, const char*, const char*, const char*, int) {
    auto& stream = *static_cast<Stream*>(self);
    stream.guarded([&] { stream.fail("found a document type in its XML, expected XML without"); });
  }

  enum class Encoding { unknown, utf8, utf16 };

  PagedFile& file_;
  XmlReceiver& receiver_;
  Encoding encoding_ = Encoding::unknown;
  std::string cut_;  ///< the beginning of a character that goes on in the next chunk
  std::unique_ptr<XML_ParserStruct, FreeParser> parser_;
  XmlPath path_;
  std::string text_;
  std::map<std::string, std::string> prefixes_;  ///< as in the file, to what names get instead
  std::exception_ptr thrown_;
  bool finished_ = false;
};

}  // namespace

std::string XmlAttributes::value(const std::string& name) const {
  for (const char** pair = pairs_; *pair != nullptr; pair += 2)
    if (name == pair[0]) return pair[1];
  return "";
}

void stream_xml(PagedFile& file, std::uint64_t size, XmlReceiver& receiver) {
  Stream(file, receiver).parse(size);
}

}  // namespace splatray
