#include "tests/bench/cases/loaded_case.h"

#include "engine/base/error.h"
#include "engine/file/scene_file.h"
#include "tests/bench/measure/speed_record.h"

namespace splatray::testing {
namespace {

constexpr double DELTA_SHARE = 1e-3;

}  // namespace

LoadedVariant::LoadedVariant(const Device& device, const std::filesystem::path& folder,
                             const std::string& file, const PreparedVariant& about)
    : prepared(about), tracer(device) {
  const Scene scene = read_scene(folder / file);
  tracer.upload(scene);
  tracer.set_environment(read_environment_file(folder / "environment.bin"));
  root = scene.root;
  splats = scene.data_pool.size();
  leaf_size = scene.build.leaf_size;
  references = scene.reference_pool.size();
}

LoadedCase::LoadedCase(const Device& device, const Case& one, const std::filesystem::path& folder)
    : device_(device), case_(one), folder_(folder), prepared_(read_case(folder)) {
  view_ = {prepared_.camera, one.width, one.height};
  for (const Variant& variant : variants_of(one)) {
    const std::string file = file_name(variant);
    const auto about = prepared_.variants.find(file);
    if (about == prepared_.variants.end())
      throw Error(ExitCode::input_unreadable,
                  (folder / "case.json").string() + ": found no '" + file +
                      "', expected a folder that splatray-bench prepare of this version made");
    variants_[file] = std::make_unique<LoadedVariant>(device, folder, file, about->second);
  }
}

Settings LoadedCase::settings_of(const Run& run) const {
  Settings settings = run.settings;
  if (settings.side == SIDE_DELTA) settings.delta_world = DELTA_SHARE * prepared_.diagonal_world;
  return settings;
}

Json LoadedCase::start_record(const Run& run) {
  Json record = testing::start_record(case_, run, variant_of(run).splats);
  record["settings"]["leaf_size"] = variant_of(run).leaf_size;
  add_device(record, device_);
  return record;
}

}  // namespace splatray::testing
