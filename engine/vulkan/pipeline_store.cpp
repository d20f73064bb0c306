#include "engine/vulkan/pipeline_store.h"

#include <cstdio>
#include <cstring>
#include <fstream>
#include <string_view>
#include <vector>

#include "engine/base/error.h"
#include "engine/file/atomic_file.h"

namespace splatray {
namespace {

/// Larger files are not ours: some hundred pipelines take a few MiB.
constexpr std::uintmax_t BYTES_MOST = std::uintmax_t{64} << 20U;

/// Whether the bytes begin as Vulkan's specification has them ("Pipeline Cache Header") for this device: drivers need not survive
/// others.
bool is_of_device(const std::vector<char>& bytes, const VkPhysicalDeviceProperties& properties) {
  VkPipelineCacheHeaderVersionOne header{};
  if (bytes.size() < sizeof(header)) return false;
  std::memcpy(&header, bytes.data(), sizeof(header));
  return header.headerSize >= sizeof(header) && header.headerSize <= bytes.size() &&
         header.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE &&
         header.vendorID == properties.vendorID && header.deviceID == properties.deviceID &&
         std::memcmp(header.pipelineCacheUUID, properties.pipelineCacheUUID, VK_UUID_SIZE) == 0;
}

std::vector<char> read_kept(const std::filesystem::path& file, const VkPhysicalDeviceProperties& properties) {
  std::error_code none;
  const std::uintmax_t size = std::filesystem::file_size(file, none);
  if (none || size > BYTES_MOST) return {};
  std::vector<char> bytes(size);
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!stream || !is_of_device(bytes, properties)) return {};
  return bytes;
}

}  // namespace

std::filesystem::path pipeline_file(const std::filesystem::path& folder,
                                    const VkPhysicalDeviceProperties& properties) {
  std::string name = "pipelines_";
  for (const std::uint8_t byte : properties.pipelineCacheUUID) {
    char text[3];
    std::snprintf(text, sizeof(text), "%02x", unsigned{byte});
    name += text;
  }
  return folder / (name + ".bin");
}

PipelineStore::PipelineStore(const Context& context, const std::filesystem::path& folder)
    : context_(context) {
  if (context.is_host()) return;
  std::vector<char> kept;
  if (!folder.empty()) {
    file_ = pipeline_file(folder, context.properties);
    kept = read_kept(file_, context.properties);
  }
  bytes_read_ = kept.size();
  VkPipelineCacheCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
  info.initialDataSize = kept.size();
  info.pInitialData = kept.data();
  VkPipelineCache cache = VK_NULL_HANDLE;
  check(vkCreatePipelineCache(context.device, &info, nullptr, &cache), "making a pipeline cache");
  cache_ = {context.device, cache};
}

PipelineStore::~PipelineStore() {
  if (file_.empty()) return;
  std::size_t size = 0;
  if (vkGetPipelineCacheData(context_.device, cache_.get(), &size, nullptr) != VK_SUCCESS) return;
  if (size == bytes_read_ || size > BYTES_MOST) return;
  try {
    std::string bytes(size, '\0');
    if (vkGetPipelineCacheData(context_.device, cache_.get(), &size, bytes.data()) != VK_SUCCESS) return;
    bytes.resize(size);
    std::filesystem::create_directories(file_.parent_path());
    write_text_file(bytes, file_);
  } catch (const std::exception&) {
    // The cache only saves time.
  }
}

}  // namespace splatray
