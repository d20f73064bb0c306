#include "engine/file/file_roles.h"

#include <sys/stat.h>

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "engine/base/error.h"

namespace splatray {
namespace {

namespace fs = std::filesystem;

using FileId = std::pair<dev_t, ino_t>;

/// Nothing of what is no file yet, and of folders, which are read by their files.
std::optional<FileId> id_of(const fs::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0 || S_ISDIR(status.st_mode)) return {};
  return FileId{status.st_dev, status.st_ino};
}

/// The name that a file is going to have, whatever the spelling. Outputs get new inodes when they are written, so that hard links
/// of one file are two outputs.
fs::path place_of(const fs::path& file) {
  std::error_code error;
  const fs::path place = fs::weakly_canonical(fs::absolute(file, error), error);
  return error ? file : place;
}

/// Each with the name that it was given.
struct Roles {
  std::mutex mutex;
  std::map<FileId, fs::path> inputs, replaced;
  std::map<fs::path, fs::path> outputs;
};

Roles& roles() {
  static Roles all;
  return all;
}

/// The name under which a file is in a list, empty where it is not: a file that is gone by now leaves its number to another.
fs::path name_in(const std::map<FileId, fs::path>& list, const FileId& id) {
  const auto found = list.find(id);
  return found != list.end() && id_of(found->second) == id ? found->second : fs::path();
}

[[noreturn]] void refuse_replacing(const fs::path& output, const fs::path& input) {
  throw Error(ExitCode::usage, "found the output '" + output.string() + "', which is the input '" +
                                   input.string() + "', expected another file");
}

void refuse_input(const Roles& all, const std::optional<FileId>& id, const fs::path& output) {
  const fs::path input = id ? name_in(all.inputs, *id) : fs::path();
  if (!input.empty()) refuse_replacing(output, input);
}

}  // namespace

void note_input(const fs::path& file) {
  const std::optional<FileId> id = id_of(file);
  if (!id) return;
  Roles& all = roles();
  const std::lock_guard lock(all.mutex);
  if (const fs::path output = name_in(all.replaced, *id); !output.empty()) refuse_replacing(output, file);
  all.inputs.insert_or_assign(*id, file);
}

void claim_output(const fs::path& file) {
  const std::optional<FileId> id = id_of(file);
  Roles& all = roles();
  const std::lock_guard lock(all.mutex);
  refuse_input(all, id, file);
  const auto [other, is_new] = all.outputs.emplace(place_of(file), file);
  if (!is_new)
    throw Error(ExitCode::usage, "found the outputs '" + other->second.string() + "' and '" + file.string() +
                                     "', which are one file, expected a file for each");
  if (id) all.replaced.insert_or_assign(*id, file);
}

void require_no_input(const fs::path& file) {
  const std::optional<FileId> id = id_of(file);
  Roles& all = roles();
  const std::lock_guard lock(all.mutex);
  refuse_input(all, id, file);
}

}  // namespace splatray
