/// Parts of a picture that were made apart, joined.
#pragma once
#include <filesystem>
#include <vector>

#include "app/library/image_file.h"

namespace splatray {

/// The whole picture of one or more EXR files that splatray-render made of its parts (--tile, --crop, --sample-offset) with otherwise
/// the same command, by the same device and driver, as another one's samples may differ, or `mixed_devices`. Each sample of each pixel must be in one of them, samples in ranges as SampleMean
/// (sample_mean.h) takes them. The metadata are those of the picture made in one piece, and so are all bits. Throws Error
/// (input_unreadable) that names the file, what was found and what was expected.
[[nodiscard]] ExrPicture join_tiles(const std::vector<std::filesystem::path>& files,
                                    bool mixed_devices = false);

}  // namespace splatray
