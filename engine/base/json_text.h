/// JSON as text.
#pragma once
#include <string>

namespace splatray {

/// The text of a value of nlohmann's library, on one line or with an indent. It never throws: what is no UTF-8 where it should
/// be (engine/base/utf8.h) becomes U+FFFD.
template <class Json>
[[nodiscard]] std::string json_text(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace splatray
