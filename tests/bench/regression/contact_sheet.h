/// Small pictures side by side.
#pragma once
#include <filesystem>
#include <vector>

namespace splatray::testing {

/// How far each of the pictures differs from that in the same place of the sheet `last`: the largest difference of two blocks of 16 x 16
/// pixels' means, 0 to 1 of what a display shows; 1 where the sheet has no such place. They are written side by side as a sheet to
/// `path`. All are of the first one's size. Throws Error as read_display_image and write_png do.
[[nodiscard]] std::vector<double> write_contact_sheet(const std::vector<std::filesystem::path>& pictures,
                                                      const std::filesystem::path& last,
                                                      const std::filesystem::path& path);

}  // namespace splatray::testing
