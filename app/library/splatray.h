/// splatray as a library: scenes of splats from files or arrays, pictures of them, and exact ray queries.
///
///     namespace sr = splatray::api;
///     sr::Scene scene = sr::open("scan.laz");
///     sr::Image image = sr::render(scene, {{"resolution", "1280x720"}, {"samples", 64}});
///     image.save("scan.png");
///
/// World space is right-handed, in the units of the input, float64. Colours and radiances are linear sRGB. Lengths are world
/// units, angles degrees. Nothing is printed, and no file is written but those that are named. Every failure is an Error. All
/// functions may be called from several threads at once, with the same scene too: what needs the device waits its turn. A process
/// that is forked off after the first use of a Vulkan device gets an Error (no_device) where it uses one; all else works there,
/// the device "cpu" too.
///
/// Scene and Request hide what they hold; all other structs are plain values of the standard library's types, so that programs
/// need GCC's libstdc++. Layouts and names stay within a MINOR version, which the soname carries. All that comes in is checked
/// first: what makes no sense is an Error (usage).
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
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

/// Called with the stage's name and the fraction of it done, 0..1, on the calling thread, some times a second; returns false to
/// cancel. An exception it throws cancels the call and propagates. It may make, use and end scenes; where it uses the one
/// whose picture or rays are being made, that is an Error (usage).
using Progress = std::function<bool(const char* stage, double share)>;

/// What an object is made of: the numbers of the look "paper", from which those of path tracing follow.
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
  // For path tracing only. Unset: derived from the fields above.
  std::optional<float> metallic{}, roughness{};  ///< 0..1 (glTF 2.0, "metallic-roughness")
  /// A clear layer's share and roughness, 0..1 (KHR_materials_clearcoat).
  std::optional<float> coat{}, coat_roughness{};
  std::optional<Float3> emission{};  ///< radiance sent out, 0..1e9
  bool operator==(const Material&) const = default;
};
/// The material of a name: matte, glossy, mirror, gold, copper, glass or ruby. Throws Error (usage) for another.
[[nodiscard]] SPLATRAY_API Material named_material(const std::string& name);

/// A number for each point or vertex, kept beside it: "intensity", "class" or any other name. The request's "color-by" shows it,
/// and "hide-class" and "hide-scan" look at "class" and "scan", which as "return", "returns" and "source" have whole numbers from
/// 0 on. A number that is not finite is 0; "point" and "kind" are splatray's own names.
struct Attribute {
  std::string name;
  std::span<const double> values;  ///< as many as there are points or vertices
};

/// An object of points as arrays, which are copied. Those that are not empty have as many elements as `positions`.
struct Points {
  std::span<const Double3> positions{};  ///< world; points that are not finite are left out
  /// Any length > 0; zero or NaN = estimate this one. Empty = estimate all.
  std::span<const Float3> normals{};
  /// Linear, 0..1: up to 1.01 and below 0 they are clamped, NaN is 0, and more is refused. Empty = none.
  std::span<const Float3> colors{};
  /// Disc radii, world units. 0, negative or NaN: estimated. Empty: all estimated.
  std::span<const float> radii{};
  std::vector<Attribute> attributes{};  ///< at most 31, of different names
  std::string name = "points";
  std::optional<Material> material{};  ///< unset = light grey, white where there are colours
  /// Whether they come from a scanner: strays are left out, noise is smoothed and unknown normals turned to the side the
  /// scanner was on. Unset = where `normals` is empty.
  std::optional<bool> scanned{};
};

/// An object of triangles as arrays, which are copied; the same as a file of it. Points lie at the vertices, or by area where
/// triangles are large or the request has "mesh-points". Arrays that are not empty have as many elements as `vertices`.
struct Mesh {
  std::span<const Double3> vertices{};  ///< world; triangles with one that is not finite are left out
  /// Three vertices each, below their number, anticlockwise seen from outside; at least one triangle.
  std::span<const std::array<std::uint32_t, 3>> triangles{};
  /// Any length > 0; zero or NaN = of the triangles. Empty = all are.
  std::span<const Float3> normals{};
  /// As of Points; interpolated.
  std::span<const Float3> colors{};
  /// As of Points; interpolated; attributes of integers up to 65535 are taken from the nearest corner.
  std::vector<Attribute> attributes{};
  std::string name = "mesh";
  /// Unset = light grey, white where there are colours. Closed glass is turned outwards.
  std::optional<Material> material{};
};

/// What scenes are made of.
using Object = std::variant<Points, Mesh>;

/// A camera. The picture's top is towards `up`.
struct Camera {
  Double3 eye{0.0, 0.0, 1.0};
  Double3 target{0.0, 0.0, 0.0};
  Double3 up{0.0, 1.0, 0.0};  ///< not parallel to the view direction
  double fov_y_deg = 30.0;    ///< vertical field of view, between 0 and 180
  double ortho_height = 0.0;  ///< > 0: orthographic, of this height in world units
  /// Where the point straight ahead lies, from the picture's middle to the right and down, in widths and heights of the picture.
  std::array<double, 2> lens_shift{0.0, 0.0};
  double pixel_aspect = 1.0;  ///< a pixel's width over its height, 0.01 to 100
  /// All directions from the eye, equirectangular: longitude across with the target in the middle, latitude down. Pictures are then the
  /// largest within the size asked for that are twice as wide as high, and what else says how wide it sees is ignored.
  bool panorama = false;
};
/// The camera of a pose and intrinsics as OpenCV has them: `pose`, rows of a 4 x 4 matrix, takes camera coordinates (x right, y
/// down, z ahead) to the world and is a rotation and a translation; `k`, rows of fx 0 cx, 0 fy cy, 0 0 1, is in pixels, the
/// centre of the top left one at (0, 0), for pictures of width x height. Their shape is part of the camera: other sizes of the
/// same shape show the same. The target is 1 ahead. For OpenGL's cameras (y up, z back), negate the pose's second and third
/// column; of COLMAP, whose corner is at (0, 0), subtract 0.5 from cx and cy. Exact off-centre and with fx other than fy. Throws
/// Error (usage) for a pose that is none, skew, or sizes and focal lengths that are not above 0.
[[nodiscard]] SPLATRAY_API Camera camera_from_pose(const std::array<std::array<double, 4>, 4>& pose,
                                                   const std::array<Double3, 3>& k, std::uint32_t width,
                                                   std::uint32_t height);

/// A value of a field: a text as on a command line, or what has such a text.
class SPLATRAY_API Value {
 public:
  Value(const char* text) : text_(text) {}              // NOLINT(google-explicit-constructor): as are all
  Value(std::string text) : text_(std::move(text)) {}   // NOLINT
  Value(bool on) : text_(on ? "on" : "off") {}          // NOLINT
  Value(double number);                                 // NOLINT
  Value(float number);                                  // NOLINT
  Value(int number) : text_(std::to_string(number)) {}  // NOLINT
  Value(unsigned number) : text_(std::to_string(number)) {}            // NOLINT
  Value(unsigned long number) : text_(std::to_string(number)) {}       // NOLINT
  Value(unsigned long long number) : text_(std::to_string(number)) {}  // NOLINT
  Value(const Double3& numbers);                                       // NOLINT
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// What can be asked for, under one name.
struct FieldInfo {
  std::string name;    ///< as on a command line without dashes, "environment-strength"; in Python with _
  std::string group;   ///< part of the help
  std::string kind;    ///< "flag", "number", "whole" or "text"
  std::string value;   ///< what the text is like, "X,Y,Z"; of a choice its names with | between
  std::string help;    ///< what it is, its unit, range and default
  bool repeated;       ///< several values count
  double least, most;  ///< of numbers
  bool opens;          ///< open() takes it: how a scene is read, made and first shown
  bool renders;        ///< render() takes it; of what is neither make() does
};

/// What is asked for of a scene and its picture: values of named fields, the same as the options of splatray-render, whose help
/// says what each is; fields() has them all. Names may have _ for -. It is a value; all that is not set is left to what suits the
/// scene.
class SPLATRAY_API Request {
 public:
  Request();
  /// With values set, as in {{"samples", 64}, {"look", "ao"}}; of a repeated field each is added.
  Request(std::initializer_list<std::pair<const char*, Value>> values);
  Request(const Request&);
  Request(Request&&) noexcept;
  Request& operator=(const Request&);
  Request& operator=(Request&&) noexcept;
  ~Request();

  /// Sets a field; a repeated one to this value alone. Throws Error (usage) for a name or value that is none.
  Request& set(const std::string& name, const Value& value);
  /// Adds a value to a repeated field, such as "light", "sun", "area-light", "object". Throws Error (usage).
  Request& add(const std::string& name, const Value& value);
  /// Sets eye, target, camera-up, fov or ortho-height, lens-shift and pixel-aspect.
  Request& set_camera(const Camera& camera);
  /// Adds an object's material; `object`: its name or index.
  Request& add_material(const std::string& object, const Material& material);

  /// The texts of a field; empty if it is unset and has no default in numbers.
  [[nodiscard]] std::vector<std::string> get(const std::string& name) const;
  /// All that is set, as splatray-render --request reads it.
  [[nodiscard]] std::string json() const;
  /// Throws Error (input).
  [[nodiscard]] static Request from_json(const std::string& text);
  /// What a picture that a splatray program wrote keeps. Throws Error (input).
  [[nodiscard]] static Request of_picture(const std::filesystem::path& picture);

  /// All fields, in the order of the help.
  [[nodiscard]] static std::vector<FieldInfo> fields();

  struct Impl;  ///< not for users

 private:
  friend struct RequestAccess;
  std::unique_ptr<Impl> impl_;
};

class Scene;
/// Reads scenes, models and scans in the formats that the guide's page formats.md lists, folders of scans, or one .soct alone. Of files in
/// levels (COPC) all points are read unless the request has "lod": then what its picture needs, and what each picture needs when it is made.
/// The request says how they are read and built, device, threads, colours, materials, up direction; automatic settings of pictures
/// are chosen once and reused for this scene. Throws Error (input, usage, cancelled, out_of_memory).
[[nodiscard]] SPLATRAY_API Scene open(std::span<const std::filesystem::path> files,
                                      const Request& request = {}, const Progress& progress = {});
[[nodiscard]] SPLATRAY_API Scene open(const std::filesystem::path& file, const Request& request = {},
                                      const Progress& progress = {});
/// A scene of one or several objects, up z unless the request has "up". Of the request: as open(), but for what files alone have.
/// Throws Error (usage) where arrays do not fit each other, (input) when no point is usable, and as open().
[[nodiscard]] SPLATRAY_API Scene make_scene(std::span<const Object> objects, const Request& request = {},
                                            const Progress& progress = {});
[[nodiscard]] SPLATRAY_API Scene make_scene(const Points& object, const Request& request = {},
                                            const Progress& progress = {});
[[nodiscard]] SPLATRAY_API Scene make_scene(const Mesh& object, const Request& request = {},
                                            const Progress& progress = {});

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
  /// Writes splatray's scene file (.soct), which opens without preprocess. Throws Error (failed, cancelled); then there is no
  /// file.
  void save(const std::filesystem::path& file, const Progress& progress = {}) const;

  struct Impl;  ///< not for users

 private:
  explicit Scene(std::shared_ptr<Impl> impl);
  friend struct SceneAccess;
  std::shared_ptr<Impl> impl_;
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

/// Something that was not asked for and was chosen to suit the scene: the field that asks for the same, and its value.
struct Choice {
  std::string field, value;
};

/// A picture; rows from the top.
struct SPLATRAY_API Image {
  std::uint32_t width = 0, height = 0;
  std::vector<std::array<float, 4>> pixels{};  ///< linear radiance r, g, b, and coverage
  /// Distance from the eye, world units, +inf on a miss; empty unless the request's "aov" asks for any.
  std::vector<float> depth{};
  std::vector<Float3> normal{};        ///< unit, world space, 0 on a miss; likewise
  std::vector<std::int32_t> object{};  ///< -1 on a miss; likewise
  /// Estimated error of the radiance, the root of the mean square of r, g, b; empty unless "aov" has error.
  std::vector<float> error{};
  std::vector<Float3> albedo{};  ///< base colour, linear, 0 to 1; empty unless "aov" has albedo
  /// Brightness of what is no .exr, stops, and its tone curve, "neutral", "agx", "soft" or "none": as asked for, or what suits the
  /// picture.
  double exposure = 0.0;
  std::string tone = "neutral";
  std::vector<Choice> choices{};  ///< view, colours, look, exposure, noise
  /// Where "lod-error" is asked for: what the points of a scan in levels that were not read change, and how sure that is, as
  /// "mean +2.03 % (+0.09 to +3.96), PSNR 31.8 dB (29.0 to 42.5)"; empty where all were read.
  std::string lod_error{};

  /// Writes .png, .jpg (without alpha) or .webp (sRGB, 8 bit, through exposure and tone) or .exr (linear float; with Z, N.X N.Y N.Z,
  /// id, error and albedo where there are such channels). WebP needs the package splatray-oiio, which wheels do not have. Throws Error (usage, failed); an older file then stays as it was.
  void save(const std::filesystem::path& file) const;
  /// The bytes of the .png.
  [[nodiscard]] std::vector<unsigned char> png() const;
};

/// The picture of a scene that a request asks for, the same as splatray-render's: the same scene, request and device give the
/// same bits (but for "time"). How the scene is read is not looked at. Throws Error.
[[nodiscard]] SPLATRAY_API Image render(const Scene& scene, const Request& request = {},
                                        const Progress& progress = {});
/// What make() has written.
struct Made {
  /// Pictures, drawings or a page; without what lies beside a drawing.
  std::vector<std::filesystem::path> files{};
  std::vector<Choice> choices{};     ///< as Image::choices
  std::vector<std::string> notes{};  ///< sentences
};
/// Writes what a request asks for to its "output", as splatray-render does, with what made it inside: a picture, a sequence
/// ("turntable", "camera-path"), a page ("orbit", .html) or a drawing to scale ("sheet", .png .tif .svg .pdf .exr). Drawings other than
/// .png and .exr need the package splatray-sheet, which wheels do not have. Throws Error: usage, also where a file that was read would be
/// replaced, and failed; then a file is whole or as it was.
[[nodiscard]] SPLATRAY_API Made make(const Scene& scene, const Request& request,
                                     const Progress& progress = {});
/// The picture of the files that the request names as "inputs". Throws Error.
[[nodiscard]] SPLATRAY_API Image make_picture(const Request& request, const Progress& progress = {});

/// What rays hit, an element a ray. The surface is what pictures show: discs near each other are blended.
struct Hits {
  std::vector<double> t{};             ///< distance from the origin, world units; +inf on a miss
  std::vector<Float3> normal{};        ///< unit, against the ray; 0 on a miss
  std::vector<std::int32_t> object{};  ///< -1 on a miss
  std::vector<std::int64_t> splat{};   ///< the first disc hit, as in Scene::splat(); -1 on a miss
  /// Which of the object's Points that disc is; -1 on a miss, for meshes and for files.
  std::vector<std::int64_t> point{};
};
/// Traces rays exactly: a ray hits what brute force over all discs finds, of the ray rounded to float32 in a cube about the scene
/// (so t errs by up to 1e-6 of the scene's size). Directions have any length > 0; rays outside one-sided objects see front faces
/// alone. `origins` and `directions` are of one length. `t_max`, world units, 0 and more: rays whose first disc is not nearer than that
/// miss; one of each ray, one of all, or none: rays without end. Throws Error (usage) with the number of a ray that is not finite or has
/// no direction.
[[nodiscard]] SPLATRAY_API Hits trace(const Scene& scene, std::span<const Double3> origins,
                                      std::span<const Double3> directions, std::span<const double> t_max = {},
                                      const Progress& progress = {});
[[nodiscard]] SPLATRAY_API Hits trace(const Scene& scene, std::span<const Float3> origins,
                                      std::span<const Float3> directions, std::span<const double> t_max = {},
                                      const Progress& progress = {});

/// Whether rays hit anything, 1 or 0, of rays and errors as of trace(), in less time: each ends at whatever it hits.
[[nodiscard]] SPLATRAY_API std::vector<std::uint8_t> occluded(const Scene& scene,
                                                              std::span<const Double3> origins,
                                                              std::span<const Double3> directions,
                                                              std::span<const double> t_max = {},
                                                              const Progress& progress = {});
[[nodiscard]] SPLATRAY_API std::vector<std::uint8_t> occluded(const Scene& scene,
                                                              std::span<const Float3> origins,
                                                              std::span<const Float3> directions,
                                                              std::span<const double> t_max = {},
                                                              const Progress& progress = {});

/// Where to measure: a place, which goes to the nearest surface and is refused where that is farther than four spacings of its points, or
/// a ray from there, whose first hit counts.
struct MeasurePlace {
  Double3 at{};
  std::optional<Double3> direction{};  ///< of a ray; any length > 0
};
/// A value, and the half-width of its 95 % confidence interval: from the scan's noise and
/// how smooth its surface is there, not from the scans' registration and scale.
struct MeasureValue {
  std::string name;  ///< such as "distance", "horizontal", "area", "perimeter", "radius", "x"
  double value = 0.0;
  double within = 0.0;
  std::string unit;  ///< "length" (world units), "area", "volume" or "degrees"
};
struct Measure {
  std::vector<Double3> points{};  ///< the places on the surface
  std::vector<MeasureValue> values{};
};
/// What is measured, and how.
struct Measuring {
  /// A point (its coordinates), the distance along two and more, the horizontal distance of two, the vertical one, which is the height of
  /// a second above a first ("height" before), the angle at the second of three, the area of the polygon of three and more, the radius of a sphere or cylinder around one, the
  /// tilt of a plane around one, the volume over an outline of three and more or, without places, over all.
  std::string kind = "distance";
  std::vector<MeasurePlace> places{};
  /// Spheres and cylinders are fitted to the surface within this distance of the place, world units.
  double reach = 0.0;
  /// What a volume's surface is compared with, as --volume has it: "z=HEIGHT", "plane=X,Y,Z,NX,NY,NZ", "corners", the plane through the
  /// places on the surface, or "earlier=FILE".
  std::string base{};
};
/// Measures what the request's region ("keep-box", "drop-box", "cut") holds, as splatray-measure does. Throws Error (usage)
/// for places that make no such measure, (failed) where there is nothing.
[[nodiscard]] SPLATRAY_API Measure measure(const Scene& scene, const Measuring& measuring,
                                           const Request& request = {}, const Progress& progress = {});

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
