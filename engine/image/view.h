/// A picture is a value: View (camera, size) + Settings (method) -> Image. Viewer, headless program, tests
/// and benchmarks all use it.
#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "engine/image/region.h"
#include "engine/scene/scene.h"

namespace splatray {

/// A rectangle of a picture's pixels, from its top left corner; without pixels: the whole picture.
struct PixelWindow {
  std::uint32_t x = 0, y = 0, width = 0, height = 0;

  bool operator==(const PixelWindow&) const = default;
};

struct View {
  Camera camera;
  std::uint32_t width = 1920;   ///< pixels, >= 1
  std::uint32_t height = 1080;  ///< pixels, >= 1
  /// What of the picture is made: an image of the window's size, of the same bits as the whole one.
  PixelWindow window{};

  /// The window, or all pixels.
  [[nodiscard]] PixelWindow made() const {
    return window.width > 0 ? window : PixelWindow{0, 0, width, height};
  }
};

/// Default distance within which occlusion darkens a point, as a fraction of the scene's diagonal.
inline constexpr double REACH_SHARE = 0.1;

/// What make_frame_params accepts of Camera::lens_shift (its length) and Camera::pixel_aspect (and its inverse).
inline constexpr double MOST_LENS_SHIFT = 100.0, MOST_PIXEL_ASPECT = 100.0;

/// The image plane in root space, float64: position of (px, py) = corner + px * dx + py * dy, relative to the
/// eye, for a plane at unit distance (perspective) or through the eye (orthographic). dx and dy, per pixel, are perpendicular. Of a
/// panorama, which has no such plane, dx and dy are radians per pixel at its middle, and `forward` is across Camera::up.
struct ImagePlane {
  glm::dvec3 eye, forward, corner, dx, dy;
};
/// That of a view that make_frame_params accepts.
[[nodiscard]] ImagePlane image_plane(const RootTransform& root, const View& view);

/// The method of a picture. Enumerators are the BLEND_*, KERNEL_*, SIDE_*, ORDER_*, LOOK_* numbers of
/// shaders/layout.h.
struct Settings {
  /// Per pixel, >= 1; with LOOK_PAPER one sample goes through the pixel's centre.
  std::uint32_t samples = 16;
  /// How many of the samples that a picture of any number has come before the first: a range of a picture whose others are made
  /// elsewhere (sample_mean.h). Not of Tracer::render_until.
  std::uint32_t sample_offset = 0;
  std::uint32_t look = LOOK_PAPER;  ///< LOOK_*
  std::uint32_t seed = 1;
  std::uint32_t max_bounces = 8;  ///< secondary rays in a path, 0..64
  bool shadows = true;
  /// Cull splats that face away from the camera, for all rays, so that rooms can be seen into. For scenes whose objects are all
  /// two-sided, as scans are.
  bool cutaway = false;
  Region region{};  ///< what of the scene rays meet; as given, all
  std::uint32_t blend = BLEND_WINDOW;
  std::uint32_t kernel = KERNEL_RIM;
  float kappa = 1.0F;  ///< window depth / radius of the first splat, > 0
  std::uint32_t side = SIDE_SIDE;
  double delta_world = 0.0;  ///< SIDE_DELTA: minimum distance, world units
  std::uint32_t order = ORDER_Z;
  /// Count the work: the host then traces the camera's rays one by one, not by tiles; pictures are the same.
  bool counters = false;
  /// Also estimate the picture's error, by how much the second half of its samples changes what the first half showed: too high
  /// rather than too low, as samples of both halves complete each other. Needs two samples.
  bool estimate_error = false;
  bool aov = false;  ///< also trace the centre rays' normal, depth, object
  /// Also the mean of the base colours that the samples meet, of looks that have them but LOOK_PAPER. Of Tracer::render alone.
  bool albedo = false;
  float environment_strength = 1.0F;
  /// Background radiance, >= 0; unset: the environment.
  std::optional<glm::vec3> background{};
  /// Nothing is seen there: black, for pictures with coverage.
  bool transparent = false;
  // For looks other than LOOK_PAPER alone:
  /// LOOK_LIT: most that a path's light after the first bounce adds to a channel; 0: any. Biased: pictures lose light.
  float clamp = 0.0F;
  /// LOOK_AO, LOOK_SCAN: how far away something darkens a point; 0 = a tenth of the scene's diagonal.
  double reach_world = 0.0;
  /// Light of lights passes dielectrics unbent, tinted; else only where paths find it.
  bool straight_shadows = false;
  double lens_radius_world = 0.0;  ///< 0: all is sharp
  double focus_world = 0.0;        ///< distance of the sharp plane from the eye; 0 = the camera's target
  /// Turns (1 = a full one) about the up axis, counter-clockwise seen from above.
  float environment_turn = 0.0F;

  bool operator==(const Settings&) const = default;
};

/// When a picture is good enough.
struct Goal {
  /// Relative error that no region of 32 x 32 pixels shall have more of (picture_error.h); 0: as small as time allows.
  double error = 0.0;
  double seconds = std::numeric_limits<double>::infinity();  ///< to trace in
};

/// Vertical field of view of pictures that name none, degrees: a portrait lens.
inline constexpr double DEFAULT_FOV_Y_DEG = 30.0;

/// Axes of a scene's default framing and environment for the up direction `up` (any length > 0): columns
/// right, up, front; right-handed, unit. Right is the world's +x made perpendicular to up (+y where up is
/// along x), so that the front, from where the default camera looks, is +z for y-up and -y for z-up scenes.
[[nodiscard]] glm::dmat3 upright_axes(const glm::dvec3& up);
/// Upwards in a picture, or across that where the camera looks straight up or down.
[[nodiscard]] glm::dvec3 up_across(const glm::dvec3& up, const glm::dvec3& view_dir);

/// A camera that shows the whole scene from its front, a little from above and to the side, for the given
/// aspect ratio. The scene's own camera when it has one.
[[nodiscard]] Camera default_camera(const Scene& scene, double aspect);
/// As default_camera, but ignores the scene's own camera. `fov_y_deg` in (0, 180).
[[nodiscard]] Camera framing_camera(const Scene& scene, double aspect, double fov_y_deg = DEFAULT_FOV_Y_DEG);
/// As framing_camera, with the picture's axes given: columns right, up and back (towards the camera), orthonormal.
[[nodiscard]] Camera framing_camera(const Scene& scene, double aspect, double fov_y_deg,
                                    const glm::dmat3& axes, const Region& region = {});

/// Where framing_camera looks from, degrees.
inline constexpr double DEFAULT_AZIMUTH_DEG = 27.0;    ///< from the front towards the scene's right
inline constexpr double DEFAULT_ELEVATION_DEG = 17.0;  ///< above the horizon
/// As framing_camera, from elsewhere: `elevation_deg` -90 to 90.
[[nodiscard]] Camera angled_camera(const Scene& scene, double aspect, double fov_y_deg, double azimuth_deg,
                                   double elevation_deg, const Region& region = {});

/// From where a scene is looked at that says nothing of a camera.
enum class Viewpoint {
  automatic,  ///< the one that choose_viewpoint chooses
  front,      ///< as framing_camera
  oblique,    ///< the same from 35 degrees above: terrain, sites
  top,        ///< from straight above, the front at the bottom
  inside,     ///< from a scanner's place, or the middle at eye height, towards most of what is there
  dollhouse,  ///< into a room from above, from the left front or where its walls face; with Settings::cutaway
  sensor,     ///< from where a depth camera or scanner was, as it saw; front where no place is known
};

/// By kind_of_scan (scan_kind.h): from the sensor what one saw, into rooms from inside where a file says that a station stands free in them,
/// and into models of rooms, else as into a doll's house; sweeps from the scanner's place, from which they have no gaps, where it is known
/// or found, else oblique as sites; all else from the front.
[[nodiscard]] Viewpoint choose_viewpoint(const Scene& scene);
/// "front" and so on.
[[nodiscard]] const char* viewpoint_name(Viewpoint viewpoint);

/// Vertical field of view from inside that names none, degrees.
inline constexpr double INSIDE_FOV_Y_DEG = 70.0;

/// A camera at that viewpoint onto what the region holds, without a look at the scene's own but for Viewpoint::sensor. Scans are framed by their main parts
/// (point_sample.h), sites and rooms without half a percent of the points at each end of each axis, sweeps without two.
/// Things that show little from the usual side of the front are seen from a broader one (framing/broad_side.h).
[[nodiscard]] Camera viewpoint_camera(const Scene& scene, Viewpoint viewpoint, double aspect,
                                      std::optional<double> fov_y_deg, const Region& region = {});

/// The light a scene without lights is shown in: a key light over the viewer's left shoulder.
[[nodiscard]] std::vector<SceneLight> default_lights(const Scene& scene, const Camera& camera);
/// Irradiance of a surface at the centre of the scene's bounding box that faces all lights, the mean of rgb; of rectangles as if
/// all their light came from their centres.
[[nodiscard]] double summed_irradiance(const Scene& scene, const std::vector<SceneLight>& lights);
/// How strong the scene's own lights are together: irradiance of what faces each of them in the middle of the scene's bounding box,
/// the mean of rgb, whatever their cones and ranges; of lights nearer than a quarter of its diagonal as if they were so far away.
[[nodiscard]] double own_light_level(const Scene& scene);

/// Everything a frame needs of View, Settings and Scene, in root space, computed in float64. Tile and sample
/// range cover the whole picture; `environment` and `irradiance` are left zero (the tracer fills them from
/// its Environment). Throws Error (usage) for a camera that sees nothing: eye == target, up parallel to the
/// view, non-finite values, fov outside (0, 180), a lens shift or pixel aspect beyond the above, zero sizes; for a panorama that is not
/// twice as wide as high, or farther than four sizes of the scene from its middle.
[[nodiscard]] FrameParams make_frame_params(const Scene& scene, const View& view, const Settings& settings);

/// FrameParams::media and absorption of these materials.
void set_media(FrameParams& frame, std::span<const Material> materials);

/// Lights in root space, as the engine uploads them: those with a size first, of these those at infinity last; how often each is
/// chosen.
[[nodiscard]] std::vector<Light> lights_in_root(const Scene& scene, const std::vector<SceneLight>& lights);

}  // namespace splatray
