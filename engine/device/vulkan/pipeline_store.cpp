#include "engine/device/vulkan/pipeline_store.h"

#include <cstdio>
#include <cstring>
#include <fstream>
#include <string_view>
#include <vector>

#include "engine/base/error.h"
#include "engine/file/atomic_file.h"
#include "engine/file/checksum.h"

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

/// How our files begin; the XXH3-64 of what follows and the driver's data come after it. Drivers check no more than their header.
constexpr std::string_view MAGIC = "splatray's compiled pipelines 1\n";
constexpr std::size_t BEGIN_BYTES = MAGIC.size() + sizeof(std::uint64_t);

/// The bytes of a file that is no link; empty where there is none, it is too large or cannot be read.
std::string read_bytes(const std::filesystem::path& file) {
  std::error_code none;
  if (std::filesystem::is_symlink(file, none)) return {};
  const std::uintmax_t size = std::filesystem::file_size(file, none);
  if (none || size > BYTES_MOST) return {};
  std::string bytes(size, '\0');
  std::ifstream(file, std::ios::binary).read(bytes.data(), static_cast<std::streamsize>(size));
  return bytes;
}

/// What was kept for this device; empty where that is damaged.
std::vector<char> read_kept(const std::filesystem::path& file, const VkPhysicalDeviceProperties& properties) {
  const std::string bytes = read_bytes(file);
  if (bytes.size() < BEGIN_BYTES || !bytes.starts_with(MAGIC)) return {};
  std::uint64_t checksum = 0;
  std::memcpy(&checksum, bytes.data() + MAGIC.size(), sizeof checksum);
  const std::vector<char> kept(bytes.begin() + BEGIN_BYTES, bytes.end());
  return checksum == checksum_of(kept.data(), kept.size()) && is_of_device(kept, properties)
             ? kept
             : std::vector<char>{};
}

/// Replaces the file unless somebody else wrote it.
void keep(const std::string& data, const std::filesystem::path& file) {
  std::error_code none;
  if (std::filesystem::exists(file, none) && !read_bytes(file).starts_with(MAGIC)) return;
  const std::uint64_t checksum = checksum_of(data.data(), data.size());
  std::string bytes(MAGIC);
  bytes.append(reinterpret_cast<const char*>(&checksum), sizeof checksum);
  std::filesystem::create_directories(file.parent_path());
  write_text_file(bytes + data, file, Links::refuse);
}

}  // namespace

std::filesystem::path pipeline_file(const std::filesystem::path& folder,
                                    const VkPhysicalDeviceProperties& properties) {
  std::string name = "compiled_";
  for (const std::uint8_t byte : properties.pipelineCacheUUID) {
    char text[3];
    std::snprintf(text, sizeof(text), "%02x", unsigned{byte});
    name += text;
  }
  return folder / (name + ".bin");
}

PipelineStore::PipelineStore(const VulkanDevice& vulkan, const std::filesystem::path& folder)
    : vulkan_(vulkan) {
  std::vector<char> kept;
  if (!folder.empty()) {
    file_ = pipeline_file(folder, vulkan.properties);
    kept = read_kept(file_, vulkan.properties);
  }
  bytes_read_ = kept.size();
  VkPipelineCacheCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
  info.initialDataSize = kept.size();
  info.pInitialData = kept.data();
  VkPipelineCache cache = VK_NULL_HANDLE;
  check(vkCreatePipelineCache(vulkan.device, &info, nullptr, &cache), "making a pipeline cache");
  cache_ = {vulkan.device, cache};
}

PipelineStore::~PipelineStore() {
  if (file_.empty()) return;
  std::size_t size = 0;
  if (vkGetPipelineCacheData(vulkan_.device, cache_.get(), &size, nullptr) != VK_SUCCESS) return;
  if (size == bytes_read_ || size > BYTES_MOST) return;
  try {
    std::string bytes(size, '\0');
    if (vkGetPipelineCacheData(vulkan_.device, cache_.get(), &size, bytes.data()) != VK_SUCCESS) return;
    bytes.resize(size);
    keep(bytes, file_);
  } catch (const std::exception&) {
    // The cache only saves time.
  }
}

}  // namespace splatray
