#include "preprocess/read/bytes/byte_source.h"

#include <fcntl.h>
#include <unistd.h>

#include "engine/base/module.h"
#include "preprocess/base/file_extension.h"
#include "preprocess/read/bytes/byte_reader.h"
#include "preprocess/read/bytes/remote_module.h"

namespace splatray {
namespace {

class FileSource : public ByteSource {
 public:
  explicit FileSource(const std::filesystem::path& path) : path_(path) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) throw_unreadable(path, "no such file");
    if (std::filesystem::is_directory(status)) throw_unreadable(path, "found a directory, expected a file");
    if (!std::filesystem::is_regular_file(status)) throw_unreadable(path, "not a regular file");
    size_ = std::filesystem::file_size(path, error);
    if (error || size_ == 0) throw_unreadable(path, error ? error.message() : "the file is empty");
    file_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file_ < 0) throw_unreadable(path, "cannot be opened for reading");
  }
  ~FileSource() override { ::close(file_); }

  [[nodiscard]] std::uint64_t size() const override { return size_; }
  [[nodiscard]] bool is_near() const override { return true; }

  [[nodiscard]] std::size_t read(std::uint64_t offset, unsigned char* to, std::size_t count) override {
    std::size_t done = 0;
    while (done < count) {
      const ssize_t got = ::pread(file_, to + done, count - done, static_cast<off_t>(offset + done));
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) throw_unreadable(path_, "byte " + std::to_string(offset + done) + " cannot be read");
      if (got == 0) break;
      done += static_cast<std::size_t>(got);
    }
    return done;
  }

 private:
  std::filesystem::path path_;
  int file_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace

std::unique_ptr<ByteSource> open_source(const std::filesystem::path& path) {
  if (!is_url(path)) return std::make_unique<FileSource>(path);
  void* function = module_function("splatray_remote", "splatray_open_remote", ExitCode::input_unreadable,
                                   path.string() + ": cannot read from servers",
                                   ": the package splatray-remote (Python's wheel has no libcurl)");
  std::unique_ptr<ByteSource> source;
  reinterpret_cast<decltype(&splatray_open_remote)>(function)(path.string(), source);
  return source;
}

}  // namespace splatray
