/// A request resolved for a scene: nothing that pictures depend on is left open.
#pragma once
#include <string>
#include <variant>
#include <vector>

#include "app/library/request/field.h"
#include "app/library/shot/sequence.h"
#include "app/library/shot/sheet.h"
#include "engine/image/view.h"
#include "engine/image/view_check.h"

namespace splatray {

/// One picture.
struct Still {};

/// A page of pictures all around.
struct Orbit {
  std::uint32_t columns = 1, rows = 1;  ///< pictures of a full turn, and heights
};

struct Shot {
  Request request;                   ///< as asked for, with the choices as if they had been asked for
  std::string of{};                  ///< what the scan is of, "a room"; empty: no scan
  std::vector<FieldText> choices{};  ///< what was chosen, as the fields that ask for the same
  /// Tried of a scan without a view of its own; the last is shown.
  std::vector<CheckedView> views{};
  std::string lod_error{};           ///< lod_error.h's sentence; empty where it was not asked for
  std::vector<std::string> notes{};  ///< sentences about options that have no effect
  View view{};                       ///< the camera of a still, and which pixels are made
  Settings settings{};               ///< of the tracer
  std::string environment{};  ///< name of the environment, as load_environment takes it; empty = studio
  bool exposes = false;       ///< the exposure is left to the picture: expose() chooses it
  std::vector<SequenceFrame> frames{};  ///< the pictures and their files
  std::variant<Still, Sequence, Orbit, Sheet, SheetSet> output{};

  /// The drawing, or null.
  [[nodiscard]] const Sheet* sheet() const { return std::get_if<Sheet>(&output); }
  /// Several drawings of one file, or null.
  [[nodiscard]] const SheetSet* sheet_set() const { return std::get_if<SheetSet>(&output); }
  [[nodiscard]] bool is_sequence() const { return std::holds_alternative<Sequence>(output); }
  [[nodiscard]] bool is_orbit() const { return std::holds_alternative<Orbit>(output); }
  /// Whether the picture goes through the denoiser.
  [[nodiscard]] bool denoises() const { return request.output.denoise.value_or(false); }
  /// The settings, with what a filter of the picture needs.
  [[nodiscard]] Settings traced_settings() const;
};

/// The shot as a frame of its sequence shows it: on a turntable the object turns, so that the studio around it keeps its place beside the
/// camera, as the key light does. Other environments are places that the camera goes around in.
[[nodiscard]] Shot frame_shot(const Shot& shot, std::uint32_t frame);

/// Has the shot show a sheet: its pixels, its camera, and of the region what it shows.
void show_sheet(const Sheet& sheet, Shot& shot);
/// The shot of one of a set's sheets.
[[nodiscard]] Shot sheet_shot(const Shot& shot, std::size_t index);

/// The camera of a frame of the shot.
[[nodiscard]] Camera frame_camera(const Shot& shot, std::uint32_t frame, const Scene& scene);
/// That of the first of all frames, though it may not be asked for.
[[nodiscard]] Camera first_camera(const Shot& shot, const Scene& scene);

/// Those of all pictures, of a set of sheets one for each; of an orbit: about the still one's target, as far away, `columns` all around at each of `rows` heights, one:
/// its own, several: from ORBIT_LOWEST_DEG to ORBIT_HIGHEST_DEG above the horizon, row by row from the lowest.
inline constexpr double ORBIT_LOWEST_DEG = 10.0, ORBIT_HIGHEST_DEG = 65.0;
[[nodiscard]] std::vector<Camera> all_cameras(const Shot& shot, const Scene& scene);
/// These cameras with their whole pictures' sizes.
[[nodiscard]] std::vector<View> all_views(const Shot& shot, const Scene& scene);

/// The choices as options of splatray-render, "--view inside --look scan"; empty where there are none.
[[nodiscard]] std::string choices_text(const Shot& shot);

}  // namespace splatray
