#include "engine/file/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <random>
#include <system_error>
#include <utility>

#include "engine/base/error.h"

namespace splatray {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& target, const std::string& reason) {
  throw Error(ExitCode::failed, "cannot write '" + target.string() + "': " + reason);
}

std::string error_text() { return std::generic_category().message(errno); }

/// A name that nobody can foresee, so that nobody can have put a link there; as short for any target, so that it fits where
/// the target's does.
std::string temporary_name() {
  constexpr char LETTERS[] = "0123456789abcdefghijklmnopqrstuvwxyz";
  std::random_device random;
  std::string name = ".splatray-";
  for (int i = 0; i < 16; ++i) name += LETTERS[random() % 36];
  return name + ".tmp";
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& target) {
  std::error_code error;
  target_ = fs::weakly_canonical(target, error);  // a link's target is replaced, not the link
  if (error) refuse(target, error.message());
  if (target.filename().empty() || fs::is_directory(target_, error))
    refuse(target, "it is a folder, expected a file name");
  if (fs::exists(target_, error) && !fs::is_regular_file(target_, error))
    refuse(target, "it exists and is not a regular file");
  const fs::path temporary = fs::path(target_).replace_filename(temporary_name());
  descriptor_ = open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (descriptor_ < 0) refuse(target, error_text());
  temporary_ = temporary;
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) close(descriptor_);
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
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
  // Without fsync a name may outlive a power failure that its bytes do not; and file systems over a network may report a full
  // disk only here or in close.
  while (fsync(descriptor_) != 0)
    if (errno != EINTR) refuse(target_, error_text());
  const int descriptor = std::exchange(descriptor_, -1);
  if (close(descriptor) != 0 && errno != EINTR) refuse(target_, error_text());
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error) refuse(target_, error.message());
  temporary_.clear();
}

void require_writable(const fs::path& target) { const AtomicFile probe(target); }

void write_text_file(const std::string& text, const fs::path& target) {
  AtomicFile output(target);
  output.write(text.data(), text.size());
  output.commit();
}

}  // namespace splatray
