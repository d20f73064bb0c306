#include "engine/file/file_mapping.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

#include "engine/base/error.h"

namespace splatray {
namespace {

/// A mapping as the signal's handler knows it, which may take no lock and no memory.
struct Place {
  std::atomic<std::uintptr_t> begin{0}, end{0};  ///< none where they are equal
  std::atomic<bool> lost{false};                 ///< pages were asked for that the file no longer has
};

/// More scenes than a program opens at a time. What finds no place is read.
std::array<Place, 64> places;

struct sigaction before_ours;

/// Puts zeros in place of what the file no longer has, up to the mapping's end: page by page there might be more parts than a process
/// may have.
bool put_zeros(std::uintptr_t address) {
  const auto page_bytes = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  for (Place& place : places) {
    const std::uintptr_t end = place.end;
    if (address < place.begin || address >= end) continue;
    const std::uintptr_t page = address / page_bytes * page_bytes;
    place.lost = true;
    return mmap(reinterpret_cast<void*>(page), end - page, PROT_READ,
                MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED | MAP_NORESERVE, -1, 0) != MAP_FAILED;
  }
  return false;
}

void on_bus_error(int signal, siginfo_t* info, void* context) {
  const int error = errno;
  const bool ours = put_zeros(reinterpret_cast<std::uintptr_t>(info->si_addr));
  errno = error;
  if (ours) return;
  if ((before_ours.sa_flags & SA_SIGINFO) != 0)
    before_ours.sa_sigaction(signal, info, context);
  else if (before_ours.sa_handler != SIG_DFL && before_ours.sa_handler != SIG_IGN)
    before_ours.sa_handler(signal);
  else
    sigaction(SIGBUS, &before_ours, nullptr);  // the access comes again, and ends the program
}

std::mutex mutex;

/// All that there are, by the mutex.
std::set<const FileMapping*>& mappings() {
  static std::set<const FileMapping*> all;
  return all;
}

void add(const FileMapping* mapping) {
  const std::lock_guard lock(mutex);
  if (mappings().empty()) {
    struct sigaction action {};
    action.sa_sigaction = on_bus_error;
    action.sa_flags = SA_SIGINFO | SA_NODEFER | SA_ONSTACK;
    sigaction(SIGBUS, &action, &before_ours);
  }
  mappings().insert(mapping);
}

void remove(const FileMapping* mapping) {
  const std::lock_guard lock(mutex);
  mappings().erase(mapping);
  struct sigaction action {};
  // Who has put a handler over ours since goes on to it: it stays.
  if (mappings().empty() && sigaction(SIGBUS, nullptr, &action) == 0 && action.sa_sigaction == on_bus_error)
    sigaction(SIGBUS, &before_ours, nullptr);
}

/// Takes a place for these addresses; nothing where all are taken.
std::optional<std::size_t> take_place(std::uintptr_t begin, std::uintptr_t end) {
  const std::lock_guard lock(mutex);
  for (std::size_t i = 0; i < places.size(); ++i)
    if (places[i].end == 0) {
      places[i].lost = false;
      places[i].begin = begin;
      places[i].end = end;
      return i;
    }
  return {};
}

std::size_t whole_pages(std::size_t bytes) {
  const auto page_bytes = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return (bytes + page_bytes - 1) / page_bytes * page_bytes;
}

}  // namespace

std::shared_ptr<const FileMapping> FileMapping::map(int descriptor, const std::filesystem::path& path) {
  struct stat status {};
  if (fstat(descriptor, &status) != 0 || status.st_size <= 0) return nullptr;
  const auto size = static_cast<std::size_t>(status.st_size);
  void* const begin = mmap(nullptr, size, PROT_READ, MAP_PRIVATE | MAP_NORESERVE, descriptor, 0);
  if (begin == MAP_FAILED) return nullptr;
  const auto address = reinterpret_cast<std::uintptr_t>(begin);
  const int own = fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
  const std::optional<std::size_t> place =
      own < 0 ? std::nullopt : take_place(address, address + whole_pages(size));
  if (!place) {
    munmap(begin, size);
    if (own >= 0) close(own);
    return nullptr;
  }
  const std::shared_ptr<FileMapping> mapping(new FileMapping);  // NOLINT: the constructor is its own
  mapping->path_ = path;
  mapping->descriptor_ = own;
  mapping->changed_s_ = status.st_mtim.tv_sec;
  mapping->changed_ns_ = status.st_mtim.tv_nsec;
  mapping->bytes_ = {static_cast<const std::byte*>(begin), size};
  mapping->place_ = *place;
  add(mapping.get());
  return mapping;
}

FileMapping::~FileMapping() {
  remove(this);
  munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
  places[place_].begin = 0;
  places[place_].end = 0;
  close(descriptor_);
}

bool FileMapping::is_whole() const {
  struct stat status {};
  return !places[place_].lost && fstat(descriptor_, &status) == 0 &&
         static_cast<std::size_t>(status.st_size) == bytes_.size() && status.st_mtim.tv_sec == changed_s_ &&
         status.st_mtim.tv_nsec == changed_ns_;
}

void FileMapping::require_whole() const {
  if (!is_whole())
    throw Error(ExitCode::input_unreadable, "cannot read scene '" + path_.string() +
                                                "': found that it shrank or was changed while it was in "
                                                "use, expected a file that stays as it is");
}

void require_whole_mappings() {
  const std::lock_guard lock(mutex);
  for (const FileMapping* mapping : mappings()) mapping->require_whole();
}

}  // namespace splatray
