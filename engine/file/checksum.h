/// Checksums of files: XXH3-64 (Y. Collet, xxHash 0.8).
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>

namespace splatray {

[[nodiscard]] std::uint64_t checksum_of(const void* bytes, std::size_t size);

/// The checksum of bytes that come piece by piece.
class Checksum {
 public:
  Checksum();
  ~Checksum();
  Checksum(const Checksum&) = delete;
  Checksum& operator=(const Checksum&) = delete;

  void add(const void* bytes, std::size_t size);
  [[nodiscard]] std::uint64_t value() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace splatray
