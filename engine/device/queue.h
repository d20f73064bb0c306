/// Memory on a device, and programs that run on it.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/device/bindings.h"
#include "engine/device/device_profile.h"
#include "engine/device/program.h"
#include "engine/scene/environment.h"

namespace splatray {

/// A number that no other call gives. From any thread.
[[nodiscard]] std::uint64_t next_id();

/// Memory on a device, of at least 16 bytes, so that an empty array is a buffer too.
class Buffer {
 public:
  virtual ~Buffer() = default;
  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// That of no other memory, not even of what was freed before.
  [[nodiscard]] std::uint64_t id() const { return id_; }

 protected:
  explicit Buffer(std::uint64_t size = 0) : size_(size) {}
  Buffer(Buffer&&) = default;
  Buffer& operator=(Buffer&&) = default;

 private:
  std::uint64_t size_;
  std::uint64_t id_ = next_id();
};

/// The environment's texture: bilinear, repeating in columns, clamped in rows.
class DeviceTexture {
 public:
  DeviceTexture() = default;
  virtual ~DeviceTexture() = default;
  DeviceTexture(const DeviceTexture&) = delete;
  DeviceTexture& operator=(const DeviceTexture&) = delete;
  [[nodiscard]] virtual std::uint64_t size() const = 0;   ///< bytes of its texels
  [[nodiscard]] std::uint64_t id() const { return id_; }  ///< as Buffer's

 private:
  const std::uint64_t id_ = next_id();
};

class PagedBuffer;

/// In how many buffers each pool is.
struct Paging {
  std::array<std::uint32_t, POOLS> pages{};  ///< of each pool, at least 1; in the order of their bindings
  std::uint32_t page_shift = 0;              ///< SPEC_PAGE_SHIFT; 0 where no pool has several pages

  /// Whether some pool has several pages.
  [[nodiscard]] bool paged() const;
};

/// What programs find at each of BIND_*, for one paging. Buffers and textures are of the same device, and must outlive their use.
/// Every binding but BIND_FRAME and BIND_COUNTERS, which are the queue's, needs one before a dispatch, also one that the
/// program does not use.
class Bindings {
 public:
  Bindings() = default;
  virtual ~Bindings() = default;
  Bindings(const Bindings&) = delete;
  Bindings& operator=(const Bindings&) = delete;

  /// Points one binding to a buffer, or to a page of a pool; once all is done that was begun where it was another.
  virtual void bind(std::uint32_t binding, const Buffer& buffer, std::uint32_t page = 0) = 0;
  /// Points the environment's binding to a texture.
  virtual void bind(const DeviceTexture& texture) = 0;
  /// Has programs walk the wide tree of a scene with so many splats. For queues that walk it.
  virtual void bind_wide_tree([[maybe_unused]] const Buffer& nodes, [[maybe_unused]] std::uint64_t splats) {}
  /// Points a pool's binding to all of its pages.
  void bind(std::uint32_t binding, const PagedBuffer& buffer);
};

using Counters = std::array<std::uint64_t, COUNTER_COUNT>;

/// What a dispatch did.
struct Ran {
  double ms = 0.0;     ///< on the device, or on the wall clock where it has no timestamps
  Counters counted{};  ///< of dispatches that count
};

/// Most dispatches of a queue that were begun and not ended.
inline constexpr std::uint32_t IN_FLIGHT_MOST = 2;

/// Does one thing after the other and waits for each, but for dispatches that are begun. One thread at a time.
class Queue {
 public:
  Queue() = default;
  virtual ~Queue() = default;
  Queue(const Queue&) = delete;
  Queue& operator=(const Queue&) = delete;

  /// Whether programs may take fma() to round once (FEATURE_FUSED).
  [[nodiscard]] virtual bool fuses() const { return false; }
  /// Throws Error (out_of_memory) naming the size.
  [[nodiscard]] virtual std::unique_ptr<Buffer> make_buffer(std::uint64_t bytes) = 0;
  /// The texture of an environment that has texels, at most DeviceLimits::texture_size across and down.
  [[nodiscard]] virtual std::unique_ptr<DeviceTexture> make_texture(const Environment& environment) = 0;
  [[nodiscard]] virtual std::unique_ptr<Bindings> make_bindings(const Paging& paging) = 0;
  /// Whether programs walk a scene's wide tree in place of the octree.
  [[nodiscard]] virtual bool walks_wide_tree() const { return false; }
  /// The bytes as a buffer that programs only read, without a copy of them: they stay as long as `keeper` does. Null where a buffer has
  /// memory of its own.
  [[nodiscard]] virtual std::unique_ptr<Buffer> lend([[maybe_unused]] std::span<const std::byte> bytes,
                                                     [[maybe_unused]] std::shared_ptr<const void> keeper) {
    return nullptr;
  }
  /// Copies to the buffer's bytes from `begin` on; at most to its end. As download, behind all that was begun.
  virtual void upload(Buffer& buffer, std::span<const std::byte> bytes, std::uint64_t begin = 0) = 0;
  /// Copies from the buffer's start.
  virtual void download(const Buffer& buffer, std::span<std::byte> bytes) = 0;
  /// Waits for all that was begun, too.
  virtual Ran run(const Dispatch& dispatch, const Bindings& bindings) = 0;
  /// Begins a dispatch that counts nothing, behind those before it: where fewer than IN_FLIGHT_MOST were begun and not ended. What it
  /// uses must stay, and its bindings as they are, until it is ended or all was waited for.
  virtual void begin(const Dispatch& dispatch, const Bindings& bindings) = 0;
  /// Waits for the dispatch that was begun first and not yet ended.
  virtual Ran end() = 0;
  /// Waits for all that was begun, which is still to be ended.
  virtual void finish() = 0;
  /// Begins to build a dispatch's program on a thread of its own, so that run() waits for less of it, on devices that build them.
  virtual void prepare([[maybe_unused]] const Dispatch& dispatch, [[maybe_unused]] const Bindings& bindings) {
  }
  /// Programs compiled since construction.
  [[nodiscard]] virtual std::uint32_t programs_built() const = 0;

  /// Makes a buffer at least that large, once all is done that was begun; keeps it when it is.
  void reserve(std::unique_ptr<Buffer>& buffer, std::uint64_t bytes);
};

}  // namespace splatray
