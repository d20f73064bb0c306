/// Numbers of files whose bytes are little-endian, as those of the machines that this runs on.
#pragma once
#include <cstring>

namespace splatray {

/// The number that begins at `bytes`, which need not be aligned.
template <class T>
[[nodiscard]] T load(const unsigned char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

/// Writes a number where `bytes` points to.
template <class T>
void store(unsigned char* bytes, T value) {
  std::memcpy(bytes, &value, sizeof value);
}

}  // namespace splatray
