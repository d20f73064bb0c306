#include "app/library/picture/series/sheets.h"

#include <algorithm>
#include <utility>

#include "app/library/picture/picture_file.h"
#include "app/library/sheet/sheet_files.h"
#include "engine/base/interrupt.h"
#include "engine/base/memory.h"
#include "engine/base/stopwatch.h"

namespace splatray {
namespace {

/// Throws Error (out_of_memory) where there is less memory than the pictures of all sheets take until they are written.
void require_memory_of_all(const Shot& shot) {
  constexpr std::uint64_t SHOWN_BYTES =
      sizeof(vec3) + sizeof(float) + 4;  // of a pixel, until the page has it
  std::uint64_t bytes = 0, largest = 0;
  for (std::size_t i = 0; i < shot.sheet_set()->sheets.size(); ++i) {
    const Shot one = sheet_shot(shot, i);
    bytes += std::uint64_t{one.view.width} * one.view.height * SHOWN_BYTES;
    largest = std::max(largest, made_image_bytes(one));
  }
  require_memory(bytes + largest, std::to_string(shot.sheet_set()->sheets.size()) + " sheets and their file");
}

/// Tells each sentence once.
class Notes {
 public:
  explicit Notes(const SequenceListener& listener) : listener_(listener) {}

  void tell(const std::string& note) {
    if (std::find(told_.begin(), told_.end(), note) != told_.end()) return;
    told_.push_back(note);
    listener_.note(note);
  }

 private:
  const SequenceListener& listener_;
  std::vector<std::string> told_;
};

}  // namespace

SequenceRecord make_sheets(const Shot& shot, SceneOnDevice& shown, const SequenceListener& listener) {
  require_memory_of_all(shot);
  const SequenceFrame& frame = shot.frames.front();
  const std::size_t count = shot.sheet_set()->sheets.size();
  Notes notes(listener);
  std::vector<SheetPicture> sheets;
  PictureRecord record{frame, 0, {}};
  for (std::size_t i = 0; i < count; ++i) {
    const Shot one = sheet_shot(shot, i);
    const auto progress = [&](double share) {
      const bool goes_on = listener.progress(frame, 0, (static_cast<double>(i) + share) / double(count));
      return !interrupted() && goes_on;
    };
    MadePicture made = make_picture(one, shown, one.view.camera, progress);
    for (const std::string& note : made.notes) notes.tell("note: " + note);
    if (!made.denoiser.empty()) notes.tell("denoised by " + made.denoiser);
    const double wall_ms = record.stats.wall_ms;
    record.lights = made.lights;
    record.stats = made.stats;
    record.stats.wall_ms += wall_ms;
    record.denoise_ms += made.denoise_ms;
    sheets.push_back({made.sheet.value_or(*one.sheet()), shown_image(one, made.image)});
  }
  Stopwatch watch;
  FileSet files;
  const std::vector<unsigned char> bytes = encode_sheets(shot, std::move(sheets), frame.output);
  files.add(frame.output, bytes.data(), bytes.size());
  add_sheet_set_places(*shot.sheet_set(), frame.output, files);
  files.commit();
  record.write_ms = watch.lap_ms();
  SequenceRecord all;
  all.made.push_back(record);
  return all;
}

}  // namespace splatray
