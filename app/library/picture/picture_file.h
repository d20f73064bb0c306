/// The outgoing side of splatray-render: picture file, its metadata, comparison with a reference.
#pragma once
#include <optional>

#include "app/library/image_file.h"
#include "app/library/shot/shot.h"
#include "engine/base/stopwatch.h"
#include "engine/device/device.h"

namespace splatray {

/// Bytes of the image that is made, with the channels that denoising and goals need.
[[nodiscard]] std::uint64_t made_image_bytes(const Shot& shot);

/// Throws Error (out_of_memory) where there is less memory than a picture takes until it is written.
void require_picture_memory(const Shot& shot);

/// Throws Error (failed) when the pictures or the statistics have no place to go, and as read_measures does for --measures.
void require_outputs_writable(const Request& request);

/// The picture of --reference; nothing without the option. Throws Error: input_unreadable, or failed when its
/// size is not
/// --resolution's.
[[nodiscard]] std::optional<DisplayImage> read_reference(const Request& request);

/// A device and its driver, as pictures name what made them.
[[nodiscard]] std::string device_text(const Device& device);
/// What made a picture of samples of several, each named once.
[[nodiscard]] std::string joined_devices(const std::string& devices, const std::string& more);

/// The command line that makes this picture (still_request), camera, scene's diagonal, `devices` that made its samples,
/// their number, seed, commit and what was chosen, for the picture's file.
[[nodiscard]] Metadata picture_metadata(const Shot& shot, const Scene& scene, const Camera& camera,
                                        const std::string& devices);

/// The picture as files of 8 bits show it.
[[nodiscard]] DisplayImage shown_image(const Shot& shot, const Image& image);

/// Writes the picture in the format of its name, of a sheet with what says where it lies (add_sheet_places): all of these files or
/// none. Throws Error (failed).
void write_output(const Shot& shot, const Image& image, const Metadata& metadata,
                  const std::filesystem::path& path);

/// Where a picture and its reference are compared: NAME.diff.png.
[[nodiscard]] std::filesystem::path difference_file(std::filesystem::path picture);

/// Compares the picture, as its file shows it, with the reference. When they differ, writes its difference_file and throws Error (failed); else prints the numbers on stderr unless quiet.
void require_match(const Shot& shot, const Image& image, const DisplayImage& reference);

}  // namespace splatray
