#include "engine/file/checksum.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace splatray {

struct Checksum::State {
  XXH3_state_t of_bytes;
};

std::uint64_t checksum_of(const void* bytes, std::size_t size) { return XXH3_64bits(bytes, size); }

Checksum::Checksum() : state_(std::make_unique<State>()) { XXH3_64bits_reset(&state_->of_bytes); }
Checksum::~Checksum() = default;

void Checksum::add(const void* bytes, std::size_t size) {
  XXH3_64bits_update(&state_->of_bytes, bytes, size);
}

std::uint64_t Checksum::value() const { return XXH3_64bits_digest(&state_->of_bytes); }

}  // namespace splatray
