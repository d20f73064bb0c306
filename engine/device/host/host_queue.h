/// Memory of the host, and the programs as C++ that run on its threads.
#pragma once
#include <deque>

#include "engine/cpu/kernel.h"
#include "engine/device/queue.h"

namespace splatray {

class HostBuffer final : public Buffer {
 public:
  explicit HostBuffer(std::uint64_t bytes);
  /// Bytes that are only read, as Queue::lend has them.
  HostBuffer(std::span<const std::byte> bytes, std::shared_ptr<const void> keeper);
  [[nodiscard]] std::byte* data() const { return data_; }

 private:
  std::unique_ptr<std::byte[]> own_;
  std::shared_ptr<const void> keeper_;  ///< of bytes that are not its own
  std::byte* data_;
};

class HostTexture final : public DeviceTexture {
 public:
  explicit HostTexture(const Environment& environment);
  [[nodiscard]] std::uint64_t size() const override { return texels_.size(); }
  [[nodiscard]] const HostBuffer& texels() const { return texels_; }  ///< vec4
  [[nodiscard]] std::uint32_t width() const { return width_; }
  [[nodiscard]] std::uint32_t height() const { return height_; }

 private:
  std::uint32_t width_, height_;
  HostBuffer texels_;
};

/// The arrays that kernels read and write.
class HostBindings final : public Bindings {
 public:
  using Bindings::bind;
  void bind(std::uint32_t binding, const Buffer& buffer, std::uint32_t page) override;
  void bind(const DeviceTexture& texture) override;
  void bind_wide_tree(const Buffer& nodes, std::uint64_t splats) override;

  /// By binding; constants and parameters are left.
  [[nodiscard]] const KernelWork& work() const { return work_; }

 private:
  KernelWork work_;
};

class HostQueue final : public Queue {
 public:
  /// 0 = one a core.
  HostQueue(unsigned threads, std::uint32_t vector_bits)
      : threads_(threads), functions_(wide_functions(vector_bits)) {}

  [[nodiscard]] std::unique_ptr<Buffer> make_buffer(std::uint64_t bytes) override;
  [[nodiscard]] std::unique_ptr<DeviceTexture> make_texture(const Environment& environment) override;
  [[nodiscard]] std::unique_ptr<Bindings> make_bindings(const Paging& paging) override;
  [[nodiscard]] bool walks_wide_tree() const override { return true; }
  [[nodiscard]] std::unique_ptr<Buffer> lend(std::span<const std::byte> bytes,
                                             std::shared_ptr<const void> keeper) override;
  void upload(Buffer& buffer, std::span<const std::byte> bytes, std::uint64_t begin) override;
  void download(const Buffer& buffer, std::span<std::byte> bytes) override;
  Ran run(const Dispatch& dispatch, const Bindings& bindings) override;
  /// Runs it: the host has nothing else to do.
  void begin(const Dispatch& dispatch, const Bindings& bindings) override {
    begun_.push_back(run(dispatch, bindings));
  }
  Ran end() override;
  void finish() override {}
  [[nodiscard]] std::uint32_t programs_built() const override { return 0; }

 private:
  const unsigned threads_;
  const WideFunctions& functions_;
  std::deque<Ran> begun_;  ///< and not ended
};

}  // namespace splatray
