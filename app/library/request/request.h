/// What is asked for: a scene, how it looks, from where it is seen, how it is sampled, and what is written. A value; its texts, names,
/// ranges and sentences are the rows of fields.h, from which every door has them.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/library/attributes.h"
#include "app/library/display_image.h"
#include "app/library/request/frame_list.h"
#include "app/library/request/light_request.h"
#include "app/library/request/object_change.h"
#include "app/library/request/sheet_request.h"
#include "app/library/request/title_block.h"
#include "engine/base/progress.h"
#include "engine/image/aovs.h"
#include "engine/image/view.h"
#include "engine/scene/scene.h"
#include "preprocess/points.h"

namespace splatray {

/// What of the scene a picture shows.
struct RegionRequest {
  std::optional<TurnedBox> keep_box, drop_box;
  std::vector<HalfSpace> cuts;
  /// What is cut off sends no light back and shades nothing; unset = of sheets.
  std::optional<bool> light_kept;

  bool operator==(const RegionRequest&) const = default;
};

struct Request {
  /// Input files and how they become a scene: one .soct, or files that preprocess reads.
  struct Source {
    std::vector<std::filesystem::path> inputs;
    std::vector<std::filesystem::path> data_paths;  ///< folders for models a scene names
    BuildParams params;
    ScanOptions scans;
    unsigned threads = 0;  ///< 0 = all cores
    /// Spacing of the points that are read of files in levels, in pixels of the pictures; 0: all are; unset: 1.
    std::optional<double> lod;
    /// What the points of files in levels may take; 0: most of what there is.
    std::uint64_t memory_bytes = 0;

    bool operator==(const Source&) const = default;
  };

  /// What the scene is shown as, and in what light.
  struct Look {
    std::optional<std::uint32_t> style;               ///< LOOK_*; unset: as resolve_look has it
    std::string material;                             ///< a name of materials.h; empty = as the input says
    std::vector<ObjectChange> objects;                ///< changes to materials, in this order
    std::optional<std::vector<LightRequest>> lights;  ///< unset = the scene's, or the default ones
    std::string environment;                          ///< as written; empty = the scene's, else the studio
    AttributeOptions attributes;                      ///< what is shown of the points' attributes
    std::optional<glm::dvec3> up;                     ///< world; of the scene, its environment and the camera
    std::optional<Tone> tone;                         ///< unset: as resolve_tone has it
    std::optional<double> exposure_ev;                ///< stops; unset: as Shot::exposes has it
    bool exposure_auto = false;                       ///< unset = automatic for all

    bool operator==(const Look&) const = default;
  };

  /// The camera and what of its picture is made.
  struct View {
    std::uint32_t width = 1920, height = 1080;  ///< pixels
    std::optional<glm::dvec3> eye, target;      ///< world
    std::optional<glm::dvec3> camera_up;        ///< world; of the camera, where that is another than Look::up
    std::optional<double> fov_y_deg;
    Viewpoint viewpoint = Viewpoint::automatic;  ///< where no eye is given
    bool look_in = false;                        ///< Settings::cutaway, from wherever one looks
    RegionRequest region;
    std::optional<SheetRequest> sheet;
    bool ink = false, xray = false;     ///< of a sheet
    double ortho_height = 0.0;          ///< world units; 0 = perspective
    bool panorama = false;              ///< Camera::panorama, of pictures that are written
    glm::dvec2 lens_shift{0.0};         ///< Camera::lens_shift
    double pixel_aspect = 1.0;          ///< Camera::pixel_aspect
    double aperture_world = 0.0;        ///< diameter of the lens
    PixelWindow crop{};                 ///< without pixels: all
    std::uint32_t tile = 0, tiles = 0;  ///< of `tiles` bands of rows this one, from 1 on; 0 = all

    bool operator==(const View&) const = default;
  };

  /// How the picture is sampled, and by what device.
  struct Settings : splatray::Settings {
    std::optional<double> asked_delta_world;  ///< unset = 1/1000 of the scene's diagonal
    bool asked_environment_seen = false;      ///< in the background, of scans that have another one, too
    double error_goal = 0.0;                  ///< Goal::error; 0 = none
    double seconds_goal = 0.0;                ///< Goal::seconds; 0 = none
    std::string device;                       ///< number or part of a name; empty = best
    std::filesystem::path cache;  ///< folder of compiled pipelines; empty = none, of programs the user's

    /// Whether a picture is traced until it is good enough, instead of by `samples`.
    [[nodiscard]] bool has_goal() const { return error_goal > 0.0 || seconds_goal > 0.0; }
    bool operator==(const Settings&) const = default;
  };

  /// Which pictures are made, and what is written of them.
  struct Output {
    std::filesystem::path path;    ///< empty = nowhere
    std::filesystem::path film{};  ///< .mp4 that the pictures at `path` are made into; empty = none
    std::filesystem::path resume;  ///< an EXR of fewer samples that they are added to; empty = none
    bool mixed_devices = false;    ///< also of one that another device or driver made
    std::optional<bool> denoise;   ///< false: --keep-noise; unset: as suits the picture
    std::string chosen{};    ///< what a picture that is made again says was chosen for it; no field has it
    bool despeckle = false;  ///< fireflies.h
    AovSet aovs = 0;
    std::string title;                    ///< of a sheet's page; empty = the input's name
    TitleBlock title_block;               ///< of a sheet's page
    std::filesystem::path measures;       ///< drawn on a sheet's page, measure_file.h; empty = none
    std::filesystem::path height_raster;  ///< of a sheet, .tif; empty = none
    std::filesystem::path camera_path;    ///< camera_file.h; empty = none
    std::uint32_t turntable = 0;          ///< frames of a full turn, 0 .. turntable - 1; 0 = none
    /// Pictures of a page: of a full turn, and heights; 0 = none.
    std::uint32_t orbit_columns = 0, orbit_rows = 1;
    std::vector<FrameRange> frames;      ///< empty = all
    bool skip_existing = false;          ///< leave out pictures that exist
    bool lod_error = false;              ///< lod_error.h, beside the pictures
    std::filesystem::path stats_json;    ///< empty = none
    std::filesystem::path reference;     ///< empty = no comparison
    double reference_threshold = 0.004;  ///< allowed error of a pixel, display-encoded 0..1
    double reference_share = 0.0002;     ///< allowed share of pixels beyond it
    double reference_limit = 0.012;      ///< no pixel may be beyond this
    bool list_devices = false;
    bool quiet = false;
    ProgressStyle progress = ProgressStyle::line;

    /// Whether several pictures are made, so that `path` is a pattern of names; else a still.
    [[nodiscard]] bool many() const { return turntable > 0 || !camera_path.empty(); }
    bool operator==(const Output&) const = default;
  };

  Source source;
  Look look;
  View view;
  Settings settings;
  Output output;

  bool operator==(const Request&) const = default;
};

/// Width and height of the picture, pixels: as asked for, of a panorama the largest within that which is twice as wide as high.
[[nodiscard]] glm::uvec2 picture_size(const Request::View& view);

/// What of a picture of this size is made: the crop's or the tile's window; without pixels: all.
[[nodiscard]] PixelWindow window_of(const Request::View& view, std::uint32_t width, std::uint32_t height);
/// That of the request's own size, or all its pixels.
[[nodiscard]] PixelWindow made_pixels(const Request::View& view);

/// Whether other materials than the scene's are asked for.
[[nodiscard]] bool asks_for_materials(const Request::Look& look);

/// Makes the request's camera exactly this one.
void set_camera(Request::View& view, const Camera& camera);

/// The region: --keep-box, --drop-box, --cut. `up` of the scene as shown, about which boxes are turned.
[[nodiscard]] Region region_of(const RegionRequest& asked, const glm::dvec3& up);

/// Whether it is a whole scene by its name, a .soct.
[[nodiscard]] bool is_scene_file(const std::filesystem::path& path);

/// Throws Error (usage), one sentence, where no input is named, or a .soct beside others.
void require_inputs(const Request::Source& source);

/// Throws Error (usage) where a .soct, which is a whole scene, is not the only input.
void require_scene_alone(const std::vector<std::filesystem::path>& inputs);

/// Folders for models a scene names: the data paths, then the variable SPLATRAY_DATA_DIR where it is set.
[[nodiscard]] std::vector<std::filesystem::path> model_folders(const Request::Source& source);

/// What reading needs to know of the source.
[[nodiscard]] ReadOptions read_options(const Request::Source& source, const Progress& progress);

}  // namespace splatray
