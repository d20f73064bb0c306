#include "engine/file/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <system_error>

#include "engine/base/error.h"

namespace splatray {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& target, const std::string& reason) {
  throw Error(ExitCode::failed, "cannot write '" + target.string() + "': " + reason);
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
  temporary_ = target_;
  temporary_ += "." + std::to_string(getpid()) + ".tmp";
  const int descriptor = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    temporary_.clear();
    refuse(target, std::generic_category().message(errno));
  }
  close(descriptor);
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error) refuse(target_, error.message());
  temporary_.clear();
}

void require_writable(const fs::path& target) { const AtomicFile probe(target); }

void write_text_file(const std::string& text, const std::filesystem::path& target) {
  AtomicFile output(target);
  std::ofstream file(output.temporary());
  file << text;
  file.close();
  if (!file) refuse(target, "the disk is full or failed");
  output.commit();
}

}  // namespace splatray
