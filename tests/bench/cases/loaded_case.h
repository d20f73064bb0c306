/// A case on the device, ready to be measured.
#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "engine/device/device.h"
#include "tests/bench/cases/case_file.h"
#include "tests/bench/cases/cases.h"
#include "tests/bench/measure/record.h"
#include "tests/gpu/shown_tracer.h"

namespace splatray::testing {

/// One scene file of a case.
struct LoadedVariant {
  PreparedVariant prepared;
  ShownTracer tracer;  ///< holds the scene and its surroundings
  RootTransform root;
  std::uint64_t splats = 0;
  std::uint32_t leaf_size = 0;   ///< that the build took
  std::uint64_t references = 0;  ///< in the leaves

  LoadedVariant(const Device& device, const std::filesystem::path& folder, const std::string& file,
                const PreparedVariant& about);
};

class LoadedCase {
 public:
  /// Reads what prepare_case left in `folder` and uploads all scene files. Throws Error.
  LoadedCase(const Device& device, const Case& one, const std::filesystem::path& folder);

  [[nodiscard]] const Case& about() const { return case_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] const PreparedCase& prepared() const { return prepared_; }
  [[nodiscard]] const View& view() const { return view_; }
  [[nodiscard]] LoadedVariant& variant_of(const Run& run) { return *variants_.at(file_name(run.variant)); }

  /// The run's settings; SIDE_DELTA gets splatray-render's default distance, a thousandth of the diagonal.
  [[nodiscard]] Settings settings_of(const Run& run) const;
  /// A run's record (record.h) but for `speed` and `error`.
  [[nodiscard]] Json start_record(const Run& run);

 private:
  const Device& device_;
  const Case& case_;
  std::filesystem::path folder_;
  PreparedCase prepared_;
  View view_;
  std::map<std::string, std::unique_ptr<LoadedVariant>> variants_;  ///< by file name
};

}  // namespace splatray::testing
