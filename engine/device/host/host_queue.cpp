#include "engine/device/host/host_queue.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "engine/base/stopwatch.h"
#include "engine/cpu/run_groups.h"
#include "engine/scene/wide/wide_tree.h"

namespace splatray {
namespace {

constexpr std::uint64_t LEAST_HOST_BYTES = 16;

Kernel kernel_of(Program program) {
  switch (program) {
    case Program::light:
      return run_light_kernel;
    case Program::rays:
      return run_rays_kernel;
    default:
      return run_trace_kernel;
  }
}

}  // namespace

HostBuffer::HostBuffer(std::uint64_t bytes)
    : Buffer(std::max(bytes, LEAST_HOST_BYTES)),
      own_(std::make_unique_for_overwrite<std::byte[]>(size())),
      data_(own_.get()) {}

HostBuffer::HostBuffer(std::span<const std::byte> bytes, std::shared_ptr<const void> keeper)
    : Buffer(bytes.size()), keeper_(std::move(keeper)), data_(const_cast<std::byte*>(bytes.data())) {}

HostTexture::HostTexture(const Environment& environment)
    : width_(environment.width),
      height_(environment.height),
      texels_(std::uint64_t{width_} * height_ * sizeof(vec4)) {
  auto* texel = reinterpret_cast<vec4*>(texels_.data());
  for (const vec3& radiance : environment.texels) *texel++ = vec4(radiance, 1.0F);
}

void HostBindings::bind(std::uint32_t binding, const Buffer& buffer, [[maybe_unused]] std::uint32_t page) {
  assert(page == 0);
  work_.bound[binding] = static_cast<const HostBuffer&>(buffer).data();
  if (binding == BIND_DATA_POOL)
    work_.tree.splats = reinterpret_cast<const std::uint32_t*>(work_.bound[binding]);
  if (binding == BIND_MATERIALS)
    work_.last_material =
        static_cast<std::uint32_t>(std::max(buffer.size() / sizeof(Material), std::uint64_t{1}) - 1);
}

void HostBindings::bind(const DeviceTexture& texture) {
  const auto& environment = static_cast<const HostTexture&>(texture);
  bind(BIND_ENVIRONMENT, environment.texels(), 0);
  work_.environment_width = environment.width();
  work_.environment_height = environment.height();
}

void HostBindings::bind_wide_tree(const Buffer& nodes, std::uint64_t splats) {
  work_.tree.nodes = reinterpret_cast<const WideNode*>(static_cast<const HostBuffer&>(nodes).data());
  work_.tree.levels = wide_levels(splats);
  work_.last_splat = static_cast<std::uint32_t>(std::max(splats, std::uint64_t{1}) - 1);
}

std::unique_ptr<Buffer> HostQueue::make_buffer(std::uint64_t bytes) {
  return std::make_unique<HostBuffer>(bytes);
}

std::unique_ptr<DeviceTexture> HostQueue::make_texture(const Environment& environment) {
  return std::make_unique<HostTexture>(environment);
}

std::unique_ptr<Bindings> HostQueue::make_bindings([[maybe_unused]] const Paging& paging) {
  assert(!paging.paged());
  return std::make_unique<HostBindings>();
}

std::unique_ptr<Buffer> HostQueue::lend(std::span<const std::byte> bytes,
                                        std::shared_ptr<const void> keeper) {
  return std::make_unique<HostBuffer>(bytes, std::move(keeper));
}

void HostQueue::upload(Buffer& buffer, std::span<const std::byte> bytes, std::uint64_t begin) {
  assert(begin + bytes.size() <= buffer.size());
  if (!bytes.empty())
    std::memcpy(static_cast<HostBuffer&>(buffer).data() + begin, bytes.data(), bytes.size());
}

void HostQueue::download(const Buffer& buffer, std::span<std::byte> bytes) {
  assert(bytes.size() <= buffer.size());
  if (!bytes.empty()) std::memcpy(bytes.data(), static_cast<const HostBuffer&>(buffer).data(), bytes.size());
}

Ran HostQueue::end() {
  const Ran ran = begun_.front();
  begun_.pop_front();
  return ran;
}

Ran HostQueue::run(const Dispatch& dispatch, const Bindings& bindings) {
  const auto start = std::chrono::steady_clock::now();
  KernelWork work = static_cast<const HostBindings&>(bindings).work();
  work.functions = functions_;
  work.constants = dispatch.constants;
  work.frame = dispatch.frame;
  Ran ran;
  run_groups(kernel_of(dispatch.program), work, dispatch.groups_x * dispatch.groups_y, threads_, ran.counted);
  ran.ms = milliseconds_since(start);
  return ran;
}

}  // namespace splatray
