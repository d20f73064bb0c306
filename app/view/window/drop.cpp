#include "app/view/window/drop.h"

#include <algorithm>
#include <charconv>
#include <sstream>
#include <string_view>

#include "app/library/codec/picture_format.h"
#include "app/library/image_file.h"
#include "preprocess/base/file_extension.h"
#include "preprocess/read/formats.h"

namespace splatray {
namespace {

/// %41 -> A
std::string percent_decoded(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned value = 0;
    const char* digits = text.data() + i + 1;
    if (text[i] == '%' && i + 2 < text.size() &&
        std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2) {
      plain += static_cast<char>(value);
      i += 2;
    } else {
      plain += text[i];
    }
  }
  return plain;
}

bool is_splatray_picture(const std::filesystem::path& file) {
  const Metadata metadata = read_metadata(file);
  return std::any_of(metadata.begin(), metadata.end(),
                     [](const auto& entry) { return entry.first == "command_line"; });
}

}  // namespace

DropKind drop_kind(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  std::error_code failed;
  if (std::filesystem::is_directory(file, failed)) return DropKind::scene;
  if (extension == ".soct" || find_format(file) != nullptr) return DropKind::scene;
  if (extension == ".json") return DropKind::camera;
  if (is_display_format(file)) return DropKind::picture;
  if (extension == ".exr") return is_splatray_picture(file) ? DropKind::picture : DropKind::environment;
  return extension == ".hdr" ? DropKind::environment : DropKind::unknown;
}

std::vector<std::filesystem::path> pasted_files(const std::string& text) {
  constexpr std::string_view SCHEME = "file://";
  std::vector<std::filesystem::path> files;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.starts_with(SCHEME)) {
      const std::size_t path = line.find('/', SCHEME.size());
      if (path != std::string::npos) files.emplace_back(percent_decoded(std::string_view(line).substr(path)));
    } else if (!line.empty()) {
      files.emplace_back(line);
    }
  }
  return files;
}

}  // namespace splatray
