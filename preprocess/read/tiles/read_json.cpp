#include "preprocess/read/tiles/read_json.h"

#include <string>

#include "engine/base/json_fault.h"
#include "preprocess/read/bytes/byte_reader.h"

namespace splatray {

nlohmann::json read_json(const std::filesystem::path& path) {
  ByteReader in(path);
  const std::vector<unsigned char> bytes = in.read(in.remaining());
  const std::string text(bytes.begin(), bytes.end());
  if (const auto fault = json_fault<nlohmann::json>(text))
    throw_unreadable(path, "found " + *fault + ", expected JSON");
  return nlohmann::json::parse(text);
}

}  // namespace splatray
