#include "engine/file/atomic_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>
#include <mutex>
#include <random>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/interrupt.h"
#include "engine/file/file_mapping.h"

namespace splatray {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& target, const std::string& reason) {
  throw Error(ExitCode::failed, "cannot write '" + target.string() + "': " + reason);
}

std::string error_text() { return std::generic_category().message(errno); }

/// Why a file cannot be made: errno's reason, in a user's words where the folder is missing.
std::string why_not_made(const fs::path& file) {
  const int reason = errno;
  const fs::path folder = file.parent_path();
  std::error_code unknown;
  if (reason == ENOENT && !folder.empty() && !fs::exists(folder, unknown))
    return "found no folder '" + folder.string() + "', expected one that is there";
  return std::generic_category().message(reason);
}

constexpr std::string_view LETTERS = "0123456789abcdefghijklmnopqrstuvwxyz";
constexpr std::string_view NAME_BEGIN = ".splatray-", NAME_END = ".tmp";
constexpr std::size_t NAME_LETTERS = 16;

/// A name that no one can foresee, so that no one can have put a link there; as short for any target, so that it fits where
/// the target's does.
std::string temporary_name() {
  std::random_device random;
  std::string name(NAME_BEGIN);
  for (std::size_t i = 0; i < NAME_LETTERS; ++i) name += LETTERS[random() % LETTERS.size()];
  return name.append(NAME_END);
}

bool is_temporary_name(const std::string& name) {
  return name.size() == NAME_BEGIN.size() + NAME_LETTERS + NAME_END.size() && name.starts_with(NAME_BEGIN) &&
         name.ends_with(NAME_END) &&
         name.find_first_not_of(LETTERS, NAME_BEGIN.size()) == name.size() - NAME_END.size();
}

/// Removes a temporary file of this user that no writer has locked. Whoever locks one here keeps it from its writer only for as
/// long as it takes to remove it, and that one then makes another (open_locked).
void remove_if_left(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return;
  struct stat status {};
  if (fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == geteuid() &&
      flock(descriptor, LOCK_EX | LOCK_NB) == 0)
    unlink(file.c_str());
  close(descriptor);
}

/// Removes what killed programs left in a folder, once for each folder: a long sequence has many files there.
void remove_left_overs(const fs::path& folder) {
  static std::mutex mutex;
  static std::set<fs::path> cleaned;
  const std::lock_guard lock(mutex);
  if (!cleaned.insert(folder).second) return;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (is_temporary_name(entry->path().filename())) remove_if_left(entry->path());
}

/// A new file, locked where the file system has locks; its descriptor, negative with errno where it cannot be made.
int open_locked(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (descriptor < 0) return descriptor;
  while (flock(descriptor, LOCK_EX) != 0 && errno == EINTR) {
  }
  return descriptor;
}

/// A temporary file that a signal's handler can remove, which may take no lock and no memory.
struct Removable {
  std::atomic<bool> taken{false}, there{false};
  char path[PATH_MAX];
};

/// More than one program writes at a time. One that finds no place here is left to the next writer's cleaning.
std::array<Removable, 16> removables;

void remove_unfinished() {
  for (const Removable& file : removables)
    if (file.there) unlink(file.path);
}

void remember(const fs::path& file) {
  at_abrupt_end(remove_unfinished);
  if (file.native().size() >= PATH_MAX) return;
  for (Removable& place : removables) {
    if (place.taken.exchange(true)) continue;
    std::strcpy(place.path, file.c_str());
    place.there = true;
    return;
  }
}

void forget(const fs::path& file) {
  for (Removable& place : removables)
    if (place.there && file == place.path) {
      place.there = false;
      place.taken = false;
      return;
    }
}

bool is_removed(int descriptor) {
  struct stat status {};
  return fstat(descriptor, &status) == 0 && status.st_nlink == 0;
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& target, Links links) {
  std::error_code error;
  if (links == Links::refuse && fs::is_symlink(target, error))
    refuse(target, "it is a link, expected a file of this program's or none");
  target_ = fs::weakly_canonical(target, error);  // a link's target is replaced, not the link
  if (error) refuse(target, error.message());
  if (target.filename().empty() || fs::is_directory(target_, error))
    refuse(target, "it is a folder, expected a file name");
  const fs::file_status status = fs::symlink_status(target_, error);  // a link's, where it leads to no file
  if (fs::exists(status) && !fs::is_regular_file(status))
    refuse(target, "it exists and is not a regular file");
  remove_left_overs(target_.parent_path());
  do {
    if (descriptor_ >= 0) close(descriptor_);
    temporary_ = fs::path(target_).replace_filename(temporary_name());
    descriptor_ = open_locked(temporary_);
    if (descriptor_ < 0) refuse(target, why_not_made(target));
  } while (is_removed(descriptor_));
  remember(temporary_);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) close(descriptor_);
  if (temporary_.empty()) return;
  std::error_code ignored;
  fs::remove(temporary_, ignored);
  forget(temporary_);
}

void AtomicFile::write(const void* bytes, std::uint64_t size) {
  const auto* next = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t step =
        ::write(descriptor_, next, size);  // at most 2 GiB, fewer at a signal or the disk's end
    if (step < 0 && errno == EINTR) continue;
    if (step <= 0) refuse(target_, error_text() + " after " + std::to_string(written_) + " bytes");
    next += step;
    size -= static_cast<std::uint64_t>(step);
    written_ += static_cast<std::uint64_t>(step);
  }
}

void AtomicFile::commit() {
  require_whole_mappings();
  // Without fsync a name may outlive a power failure that its bytes do not; and file systems over a network may report a full
  // disk only here or in close.
  while (fsync(descriptor_) != 0)
    if (errno != EINTR) refuse(target_, error_text());
  const int lock = dup(descriptor_);  // keeps the lock until the file has its name
  const int closed = close(std::exchange(descriptor_, lock));
  if (closed != 0 && errno != EINTR) refuse(target_, error_text());
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error) refuse(target_, error.message());
  forget(temporary_);
  temporary_.clear();
}

void FileSet::add(const fs::path& target, const void* bytes, std::uint64_t size) {
  files_.emplace_back(target).write(bytes, size);
}

void FileSet::add(const fs::path& target, const std::string& text) { add(target, text.data(), text.size()); }

void FileSet::commit() {
  for (AtomicFile& file : files_) file.commit();
}

void require_writable(const fs::path& target) { const AtomicFile probe(target); }

void write_file(const void* bytes, std::uint64_t size, const fs::path& target, Links links) {
  AtomicFile output(target, links);
  output.write(bytes, size);
  output.commit();
}

void write_text_file(const std::string& text, const fs::path& target, Links links) {
  write_file(text.data(), text.size(), target, links);
}

}  // namespace splatray
