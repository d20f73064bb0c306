#include "app/library/picture/resume.h"

#include <algorithm>
#include <string>

#include "app/library/image_file.h"
#include "app/library/picture/picture_file.h"
#include "app/library/picture/reproduce.h"
#include "app/library/request/fields.h"
#include "engine/base/error.h"
#include "engine/base/number_text.h"
#include "engine/image/picture_error.h"
#include "engine/image/sample_mean.h"

namespace splatray {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& found,
                         const std::string& expected) {
  throw Error(ExitCode::input_unreadable,
              "cannot resume '" + file.string() + "': found " + found + ", expected " + expected);
}

/// The options of a field that a request has; where it has none, that it lacks those of another request.
std::string option_text(const Field& field, const Request& request, const Request& other) {
  const std::vector<FieldText> values = field.write(request);
  if (values.empty()) return "no --" + field.write(other).front().name;
  std::string text;
  for (const FieldText& value : values) text += (text.empty() ? "--" : " --") + value.name + " " + value.text;
  return text;
}

/// Refuses a picture of another command, by the first option that differs.
void require_same_light(const std::filesystem::path& file, const Request& kept, const Request& asked) {
  if (kept.output.denoise.value_or(false) || kept.output.despeckle)
    refuse(file, "a picture without its noise", "one without --denoise and --despeckle");
  for (const Field& field : fields())
    if (!field.is(NOT_OF_LIGHT) && field.write && field.write(kept) != field.write(asked))
      refuse(file, "a picture with " + option_text(field, kept, asked), option_text(field, asked, kept));
}

std::string kept_value(const Metadata& metadata, const char* name) {
  const auto kept =
      std::find_if(metadata.begin(), metadata.end(), [&](const auto& entry) { return entry.first == name; });
  return kept == metadata.end() ? "unknown" : kept->second;
}

/// Another scene of the same name.
void require_same_scene(const std::filesystem::path& file, const Metadata& metadata, const Scene& scene) {
  const std::string expected = number_text(scene.diagonal_world());
  const std::string found = kept_value(metadata, "diagonal_world");
  if (found != expected) refuse(file, "a scene whose diagonal is " + found, "this one's " + expected);
}

}  // namespace

std::optional<StartedPicture> read_started(const Shot& shot, const Scene& scene, const Camera& camera,
                                           const Device& device) {
  const Request& request = shot.request;
  const std::filesystem::path& file = request.output.resume;
  if (file.empty()) return {};
  const ExrPicture header = read_exr_header(file);
  const Request kept = plain_request(read_picture_request(file));
  require_same_light(file, kept, plain_request(still_request(shot, camera)));
  require_same_scene(file, header.metadata, scene);
  const std::string devices = kept_value(header.metadata, "device");
  if (devices != device_text(device) && !request.output.mixed_devices)
    refuse(file, "a picture that '" + devices + "' made",
           "one of '" + device_text(device) + "', as now, or --mixed-devices, as samples may differ");
  if (kept.settings.samples >= request.settings.samples)
    refuse(file, std::to_string(kept.settings.samples) + " samples a pixel",
           "fewer than the " + std::to_string(request.settings.samples) + " of --samples");
  if (header.width != shot.view.width || header.height != shot.view.height ||
      header.window != shot.view.made())
    refuse(file, "other pixels than those of its command", "a file as splatray-render writes it");
  return StartedPicture{image_of(read_exr(file)).rgba, kept.settings.samples, devices};
}

void add_started(const StartedPicture& started, bool estimate_error, Image& image, RenderStats& stats) {
  SampleMean mean;
  mean.add(started.means, started.samples);
  mean.join(image.rgba, 0, static_cast<std::uint32_t>(stats.samples));
  stats.samples += started.samples;
  if (!estimate_error) return;
  estimate_errors(started.means, started.samples, stats.samples, image);
  stats.error = relative_error(image);
}

}  // namespace splatray
