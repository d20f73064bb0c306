/// splatray as a library: scenes of splats from files or arrays, pictures of them, and exact ray queries.
///
///     namespace sr = splatray::api;
///     sr::Scene scene = sr::open("scan.laz");
///     sr::Image image = sr::render(scene, {sr::frame(scene), 1280, 720});
///     image.save("scan.png");
///
/// World space is right-handed, in the units of the input, float64. Colours and radiances are linear sRGB. Lengths are world
/// units, angles degrees. Nothing is printed, and no file is written but those that are named. Every failure is an Error. All
/// functions may be called from several threads at once, with the same scene too: what needs the device waits its turn. A process
/// that is forked off after the first use of a Vulkan device gets an Error (no_device) where it uses one; all else works there, the
/// device "cpu" too.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#define SPLATRAY_API __attribute__((visibility("default")))

namespace splatray::api {

using Double3 = std::array<double, 3>;  ///< x, y, z: a place or direction in world space
using Float3 = std::array<float, 3>;    ///< x, y, z or r, g, b

/// What kind of failure an Error is.
enum class ErrorKind {
  usage,          ///< an argument makes no sense
  input,          ///< a file is missing, unreadable or not what it should be; arrays without a usable point
  no_device,      ///< no usable Vulkan device, or no Vulkan
  out_of_memory,  ///< host or device memory
  cancelled,      ///< Progress returned false
  failed,         ///< anything else, such as a full disk
};

/// Every failure: what() is one sentence that says what was found and what was expected, without a trailing period.
class SPLATRAY_API Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& sentence);
  ~Error() override;
  [[nodiscard]] ErrorKind kind() const;

 private:
  ErrorKind kind_;
};

/// Hears the name of a stage and the share of it done, 0..1, on the thread that called, some times a second; returns false to
/// cancel. What it throws ends the call likewise and reaches the caller. It may make, use and end scenes; where it uses the one
/// whose picture or rays it hears of, that is an Error (usage).
using Progress = std::function<bool(const char* stage, double share)>;

/// What an object is made of.
struct Material {
  Float3 diffuse{0.64F, 0.61F, 0.57F};  ///< reflectance, 0..1; times the points' colours where they have some
  float specular = 0.05F;               ///< share of light in a highlight (Phong), 0..1
  float shininess = 40.0F;              ///< Phong's exponent, >= 1
  Float3 tint{1.0F, 1.0F, 1.0F};        ///< mirror: reflectance; glass: transmittance of each crossing; 0..1
  float mirror = 0.0F;                  ///< share of light mirrored, 0..1
  float ior = 1.5F;                     ///< index of refraction inside, > 0; glass only
  bool glass = false;                   ///< refracts; the object must be closed, its normals outwards
  bool two_sided = true;                ///< both faces are seen; glass is one-sided
  bool hidden = false;                  ///< not hit by any ray
  bool operator==(const Material&) const = default;
};
/// The material of a name: matte, glossy, mirror, gold, copper, glass or ruby. Throws Error (usage) for another.
[[nodiscard]] SPLATRAY_API Material named_material(const std::string& name);

/// One object as arrays, which are copied. Those that are not empty have as many elements as `positions`.
struct Points {
  std::span<const Double3> positions{};  ///< world; points that are not finite are left out
  /// Any length > 0; zero or NaN = estimate this one. Empty = estimate all.
  std::span<const Float3> normals{};
  std::span<const Float3> colors{};  ///< linear, 0..1, clamped; NaN is 0. Empty = none
  /// Of the discs, world units; zero, negative or NaN = choose. Empty = choose all.
  std::span<const float> radii{};
  std::string name = "points";
  std::optional<Material> material{};  ///< unset = light grey, white where there are colours
  /// Whether they come from a scanner: strays are left out, noise is smoothed and unknown normals turned to the side the
  /// scanner was on. Unset = where `normals` is empty.
  std::optional<bool> scanned{};
};

/// How files or arrays become a scene.
struct OpenOptions {
  double radius_scale = 1.0;      ///< factor on every radius, 1e-6..1e6
  std::uint64_t mesh_points = 0;  ///< points sampled on meshes by area; 0 = their vertices where fine enough
  std::vector<std::filesystem::path> data{};  ///< folders searched for models that a scene names
  /// Colours by an attribute: height, normal, distance, intensity ...; empty = the scene's own.
  std::string color_by{};
  std::optional<Double3> up{};  ///< up direction; unset = the file's own, z for arrays
  unsigned threads = 0;         ///< of reading, preprocess and the device "cpu"; 0 = all cores
  /// Vulkan device: number or part of a name as in devices(); empty = best. "cpu" = the processors without Vulkan: the same
  /// hits, in two to three times the time of Mesa's Vulkan driver for them.
  std::string device{};
  /// Folder that compiled pipelines are kept in between runs; empty = nowhere.
  std::filesystem::path cache{};
  Progress progress{};  ///< may be empty
};

class Scene;
/// Reads scenes, models and scans: .ply .obj .stl .vtk .vtp .vtu .pvtp .pvtu .gltf .glb .las .laz .e57 .pcd .ptx .pts .xyz .csv .txt .asc .bin, folders
/// of scans, or one .soct alone. Throws Error (input, usage, cancelled, out_of_memory).
[[nodiscard]] SPLATRAY_API Scene open(std::span<const std::filesystem::path> files,
                                      const OpenOptions& options = {});
[[nodiscard]] SPLATRAY_API Scene open(const std::filesystem::path& file, const OpenOptions& options = {});
/// A scene of one or several objects. Throws Error (input) when no point is usable, and as open().
[[nodiscard]] SPLATRAY_API Scene make_scene(std::span<const Points> objects, const OpenOptions& options = {});
[[nodiscard]] SPLATRAY_API Scene make_scene(const Points& object, const OpenOptions& options = {});

/// A scene of splats, oriented discs in an octree; it never changes. Its device is opened with the first picture or ray.
class SPLATRAY_API Scene {
 public:
  ~Scene();
  Scene(Scene&&) noexcept;  ///< leaves an empty scene, of which all functions throw Error (usage)
  Scene& operator=(Scene&&) noexcept;

  [[nodiscard]] std::size_t splats() const;                     ///< discs
  [[nodiscard]] Double3 bounds_low() const;                     ///< of the discs' centres
  [[nodiscard]] Double3 bounds_high() const;                    ///< of the discs' centres
  [[nodiscard]] Double3 up() const;                             ///< unit
  [[nodiscard]] std::vector<std::string> objects() const;       ///< names
  [[nodiscard]] std::vector<Material> materials() const;        ///< beside objects()
  [[nodiscard]] const std::vector<std::string>& notes() const;  ///< sentences about what is odd in the files
  [[nodiscard]] std::string device() const;  ///< the device's name; opens it. Throws Error (no_device)
  /// Centre, unit normal and radius of a disc as traced, its object. Throws Error (usage) beyond splats().
  struct Splat {
    Double3 center, normal;
    double radius;
    std::uint32_t object;
  };
  [[nodiscard]] Splat splat(std::size_t index) const;
  /// Writes splatray's scene file (.soct), which opens without preprocess. Throws Error (failed, cancelled); then there is no file.
  void save(const std::filesystem::path& file, const Progress& progress = {}) const;

  struct Impl;  ///< not for users

 private:
  explicit Scene(std::shared_ptr<Impl> impl);
  friend struct SceneAccess;
  std::shared_ptr<Impl> impl_;
};

/// A camera. The picture's top is towards `up`.
struct Camera {
  Double3 eye{0.0, 0.0, 1.0};
  Double3 target{0.0, 0.0, 0.0};
  Double3 up{0.0, 1.0, 0.0};  ///< not parallel to the view direction
  double fov_y_deg = 30.0;    ///< vertical field of view, between 0 and 180
  double ortho_height = 0.0;  ///< > 0: orthographic, of this height in world units
};
/// Where frame() looks from.
struct Framing {
  /// From the front (+z where y is up, -y where z is) towards the right.
  std::optional<double> azimuth_deg{};
  std::optional<double> elevation_deg{};  ///< above the horizon, -90..90
  std::optional<double> fov_y_deg{};      ///< unset = 30
  double aspect = 16.0 / 9.0;             ///< width / height of the picture, > 0
};
/// A camera that shows the whole scene. Without azimuth and elevation: the scene's own camera, or one that suits its shape; with
/// one of them the other is 27 or 17 degrees. Throws Error (usage).
[[nodiscard]] SPLATRAY_API Camera frame(const Scene& scene, const Framing& framing = {});

/// Which picture is made of a camera.
struct View {
  Camera camera;
  std::uint32_t width = 1280, height = 720;  ///< pixels, 1..32768
};

/// A light.
struct Light {
  enum class Kind { directional, point } kind = Kind::directional;
  /// Point: its place; directional: direction towards the light, any length > 0.
  Double3 position{0.0, 1.0, 0.0};
  Float3 power{3.14F, 3.14F, 3.14F};  ///< directional: irradiance facing it; point: irradiance * distance^2
  /// Makes shadows soft. point: radius, world units; directional: angular diameter, degrees.
  double size = 0.0;
};
/// How light is followed.
enum class Style {
  automatic,  ///< scan for scans in no light and of no material of their own or of the look's, else lit
  paper,      ///< highlights, mirrors, glass and hard shadows, no light between surfaces: quick
  lit,        ///< path tracing
  clay,       ///< the same, everything matt and light grey
  ambient,    ///< ambient occlusion
  scan,       ///< the points' colours under ambient occlusion and the lights
};
/// In what light, and made of what, a scene is shown.
struct Look {
  Style style = Style::automatic;
  /// Unset = the scene's; without those, and without `environment`, a key light.
  std::optional<std::vector<Light>> lights{};
  /// A latitude-longitude picture's file, or studio, white, black, or a radiance r,g,b; empty = the scene's, else studio.
  std::string environment{};
  float environment_strength = 1.0F;  ///< factor, >= 0
  float environment_turn = 0.0F;      ///< turns about up, 1 = a full one, counter-clockwise seen from above
  std::vector<Material> materials{};  ///< of all objects; empty = the scene's
};

/// How a picture is sampled.
struct Settings {
  std::uint32_t samples = 16;     ///< a pixel, 1..65536
  std::uint32_t seed = 1;         ///< the same seed makes the same picture
  std::uint32_t max_bounces = 8;  ///< mirror and glass rays in a path, 0..64
  bool shadows = true;
  bool channels = false;  ///< also Image::depth, normal and object
};

/// How what is brighter than a display can be is brought below 1.
enum class Tone {
  soft,     ///< each channel alone, from 0.8 on
  neutral,  ///< Khronos PBR Neutral: colours keep their hue, bright ones go towards white
  agx,      ///< AgX: like film
  none,     ///< cut off at 1
};
/// What stands between a picture and a .png.
struct Display {
  double exposure = 0.0;  ///< brightness, stops
  Tone tone = Tone::neutral;
};

/// A picture; rows from the top.
struct SPLATRAY_API Image {
  std::uint32_t width = 0, height = 0;
  std::vector<std::array<float, 4>> pixels{};  ///< linear radiance r, g, b, and coverage
  /// Distance from the eye, world units, +inf on a miss; empty unless Settings::channels.
  std::vector<float> depth{};
  std::vector<Float3> normal{};        ///< unit, world space, 0 on a miss; likewise
  std::vector<std::int32_t> object{};  ///< -1 on a miss; likewise

  /// Writes .png (sRGB, 8 bit, through `display`) or .exr (linear float; with Z, N.X N.Y N.Z and id where there are channels).
  /// Throws Error (usage, failed); an older file then stays as it was.
  void save(const std::filesystem::path& file, const Display& display = {}) const;
  /// The bytes of the .png.
  [[nodiscard]] std::vector<unsigned char> png(const Display& display = {}) const;
};

/// The picture of a scene: the same scene, look, view, settings and device give the same bits. Throws Error.
[[nodiscard]] SPLATRAY_API Image render(const Scene& scene, const View& view, const Look& look = {},
                                        const Settings& settings = {}, const Progress& progress = {});

/// What rays hit, an element a ray. The surface is what pictures show: discs near each other are blended.
struct Hits {
  std::vector<double> t{};             ///< distance from the origin, world units; +inf on a miss
  std::vector<Float3> normal{};        ///< unit, against the ray; 0 on a miss
  std::vector<std::int32_t> object{};  ///< -1 on a miss
  std::vector<std::int64_t> splat{};   ///< the first disc hit, as in Scene::splat(); -1 on a miss
  /// Which of the object's Points that disc is; -1 on a miss and for files.
  std::vector<std::int64_t> point{};
};
/// Traces rays exactly: a ray hits what brute force over all discs finds, of the ray rounded to float32 in a cube about the scene
/// (so t errs by up to 1e-6 of the scene's size). Directions have any length > 0; rays outside one-sided objects see front faces
/// alone. `origins` and `directions` are of one length. Throws Error (usage) with the number of a ray that is not finite or has
/// no direction.
[[nodiscard]] SPLATRAY_API Hits trace(const Scene& scene, std::span<const Double3> origins,
                                      std::span<const Double3> directions, const Progress& progress = {});

/// A Vulkan device.
struct Device {
  std::string name, type, driver;
  std::string refused;  ///< why it cannot be used; empty = usable
};
/// All Vulkan devices, by number; empty without Vulkan.
[[nodiscard]] SPLATRAY_API std::vector<Device> devices();

/// "major.minor.patch".
[[nodiscard]] SPLATRAY_API std::string version();

}  // namespace splatray::api
