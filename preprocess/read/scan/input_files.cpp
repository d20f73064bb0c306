#include "preprocess/read/scan/input_files.h"

#include <algorithm>

#include "engine/base/error.h"
#include "preprocess/base/file_extension.h"
#include "preprocess/read/formats.h"

namespace splatray {
namespace {

/// Whether a file in a folder is taken for a scan.
bool may_be_a_scan(const std::filesystem::path& path) {
  const Format* format = find_format(path);
  return (format != nullptr && format->read_scan != nullptr) || lower_extension(path) == ".ply";
}

/// Whether the extension is one that all kinds of files have.
bool may_be_anything(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  return extension == ".txt" || extension == ".csv" || extension == ".asc" || extension == ".bin";
}

std::vector<InputFile> files_of_folder(const std::filesystem::path& folder) {
  std::vector<InputFile> files;
  std::error_code error;
  if (std::filesystem::is_regular_file(folder / "ept.json", error)) return {{folder / "ept.json", false}};
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (may_be_a_scan(entry.path())) files.push_back({entry.path(), may_be_anything(entry.path())});
  if (error) throw Error(ExitCode::input_unreadable, folder.string() + ": " + error.message());
  if (files.empty())
    throw Error(
        ExitCode::input_unreadable,
        folder.string() + ": found a folder without scans, expected files such as .laz or .e57 in it");
  std::sort(files.begin(), files.end(),
            [](const InputFile& a, const InputFile& b) { return a.path < b.path; });
  return files;
}

}  // namespace

std::vector<InputFile> input_files(const std::vector<std::filesystem::path>& paths) {
  std::vector<InputFile> files;
  for (const std::filesystem::path& path : paths) {
    std::error_code error;
    const Format* format = find_format(path);
    if (std::filesystem::is_directory(path, error))
      for (InputFile& file : files_of_folder(path)) files.push_back(std::move(file));
    else if (format != nullptr && format->read_list != nullptr)
      for (std::filesystem::path& file : format->read_list(path)) files.push_back({std::move(file), false});
    else
      files.push_back({path, false});
  }
  return files;
}

}  // namespace splatray
