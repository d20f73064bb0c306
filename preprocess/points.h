/// What readers deliver and preprocess works on: objects of points in world space, float64.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/progress.h"
#include "engine/scene/columns.h"
#include "engine/scene/scene.h"
#include "engine/scene/station.h"

namespace splatray {

struct Texture;
struct TextureFactor;

/// Points::grid_cell of a point that is in no grid.
inline constexpr std::uint32_t NO_CELL = 0xFFFFFFFF;

/// Where the surface ends beside a point: up to two lines that its disc ends at. World units.
struct PointClip {
  /// Unit, square to the normal, out of the surface; zero = no line.
  glm::vec3 dir[2]{glm::vec3(0.0F), glm::vec3(0.0F)};
  float distance[2]{};  ///< from the point to the line, >= 0
  /// Discs of larger radius are not clipped, as what they cover was not searched so far away.
  float reach = 0.0F;

  bool operator==(const PointClip&) const = default;

  [[nodiscard]] std::size_t lines() const {
    return dir[0] == glm::vec3(0.0F) ? 0 : (dir[1] == glm::vec3(0.0F) ? 1 : 2);
  }
  /// Whether an offset from the point lies beyond one of the lines.
  [[nodiscard]] bool cuts(const glm::dvec3& offset) const {
    for (std::size_t i = 0; i < lines(); ++i)
      if (glm::dot(glm::dvec3(dir[i]), offset) > static_cast<double>(distance[i])) return true;
    return false;
  }
};

/// The shape of a splat that is longer than wide.
struct PointEllipse {
  glm::vec3 short_axis{0.0F};  ///< unit, square to the normal
  float aspect = 1.0F;         ///< its length over its width, 1 or more
  float half_length = 0.0F;    ///< world units; 0 = a disc

  bool operator==(const PointEllipse&) const = default;
};

/// Where a sensor that moved was at a time.
struct TrackPlace {
  double time;  ///< of the same clock as COLUMN_TIME
  glm::dvec3 sensor_world;
};

/// The column that numbers the points of an input, where it is asked afterwards which of them a scene leaves out. No file's column: its
/// name has blanks.
inline constexpr std::string_view COLUMN_INPUT_NUMBER = "number of the input's point";

/// A point set. All arrays that are not empty have the same length, but for `stations` and `track`.
struct Points {
  std::vector<glm::dvec3> position;  ///< world units
  std::vector<glm::vec3> normal;     ///< any length; empty = none given. A zero normal means "estimate me"
  /// Unit normals that light sees, where they are not those of the points' planes, else zero; empty = none
  std::vector<glm::vec3> shading;
  std::vector<glm::vec3> color;  ///< linear rgb, 0..1; empty = none
  std::vector<float> radius;     ///< world units; empty = none given
  std::vector<PointClip> clip;   ///< where the surface ends; empty = nowhere
  /// Shapes of splats that are longer than wide; `radius` is half their length; empty = all are discs
  std::vector<PointEllipse> ellipse;
  /// Display-encoded rgb of scans as stored, instead of `color`; empty = none. 1.0 is at `stored_color_most`, which 0 leaves
  /// to be judged from all files of the input: LAS has 8-bit colours in 16-bit fields.
  std::vector<glm::u16vec3> stored_color;
  std::uint16_t stored_color_most = 0;
  std::vector<Column> columns;           ///< further attributes, each beside `position`
  std::vector<Station> stations;         ///< where the points were measured from; empty = not known
  std::vector<std::uint16_t> station;    ///< indices into `stations`; empty = all points are of the first
  std::vector<std::uint32_t> grid_cell;  ///< row * columns + column in the station's grid; empty = no grids
  /// How many points each is the mean of, as only levels say; 0 = it is a point; empty = all are
  std::vector<std::uint32_t> mean_of;
  /// Where points with COLUMN_TIME were measured from, by time; empty = unknown
  std::vector<TrackPlace> track;
  std::string crs;               ///< Scene::crs
  std::optional<glm::dvec3> up;  ///< Input::up, where a file says it beside points
  /// For points that were splats, the lattice that these were on, and their words of normal fields and clip lines (splat.h,
  /// clip.h), each empty = none (lattice.h).
  std::optional<RootTransform> lattice;
  std::vector<std::uint32_t> field_words, clip_words;

  [[nodiscard]] std::size_t size() const { return position.size(); }
};

/// One channel of a texture that is a factor of the surface.
struct MapChannel {
  const TextureFactor* factor = nullptr;  ///< one of texture_factors()
  int channel = 0;                        ///< of the texture: 0 red to 3 alpha
};

/// A texture whose channels are factors of the surface (glTF 2.0: metallic-roughness, emissive and the like). Those of colours
/// are read as sRGB, all others as they are stored.
struct SurfaceMap {
  std::shared_ptr<const Texture> texture;  ///< never null; its factor is 1, but alpha's may be less
  std::vector<MapChannel> channels;
  float normal_scale = 0.0F;  ///< of a normal map: factor on its normals' x and y; 0: it is none
  std::shared_ptr<const std::vector<glm::vec2>> texcoord;  ///< beside the mesh's vertices
};

/// Triangles over points (attributes per vertex). Also the truth that pictures are measured against.
struct Mesh {
  Points vertices;                    ///< position, maybe normal and colour
  std::vector<glm::vec2> texcoord;    ///< beside vertices, or empty
  std::vector<glm::uvec3> triangles;  ///< indices < vertices.size()
  std::vector<float> alpha;           ///< multiplies the texture's, beside vertices; empty = 1 everywhere
  std::shared_ptr<const Texture> texture;  ///< base colour by texcoord, times the vertex colour; null = none
  std::vector<SurfaceMap> maps;            ///< further textures (mesh/surface_maps.h); empty = none
};

/// What a scan's file holds and what its reader left out.
struct ScanCounts {
  std::uint64_t stored = 0;     ///< records that the header or the grid names
  std::uint64_t missing = 0;    ///< of those, the ones the file ends before
  std::uint64_t no_return = 0;  ///< grid cells and records without a position
  std::uint64_t withheld = 0;   ///< deleted by convention (LAS's withheld bit)
  std::uint64_t noise = 0;      ///< of the classes 7 and 18, and not withheld

  ScanCounts& operator+=(const ScanCounts& more) {
    stored += more.stored;
    missing += more.missing;
    no_return += more.no_return;
    withheld += more.withheld;
    noise += more.noise;
    return *this;
  }
};

/// Something that a file's head says: what, and a text for people.
struct FileFact {
  std::string name;
  std::string text;
};

/// A file of points without materials, which joins the others of its kind in one object.
struct ScanFile {
  Points points;
  ScanCounts counts;
  glm::dvec3 up{0.0, 0.0, 1.0};      ///< the format's own: z for what surveyors use
  std::optional<bool> in_degrees{};  ///< x and y: degrees, or lengths; unset where the file does not say
  std::vector<FileFact> facts{};     ///< version, how points are stored, by what and when it was made
  /// The lowest and highest corner by the file's head, which may be wrong; unset where it says none.
  std::optional<std::array<glm::dvec3, 2>> said_box{};
};

/// The material of an object whose file says nothing: light grey, a soft highlight, two-sided. `colored`: points have colours, of
/// which it keeps white below the display's white.
[[nodiscard]] Material default_material(bool colored = false);

/// One object of the input: points, and what they are made of.
struct InputObject {
  std::string name;
  Points points;
  Material material = default_material();
  /// Normals are known to point outwards (closed mesh); else they may be turned either way.
  bool oriented = false;
  bool measured = true;  ///< points without a surface and sides known are a scanner's, with strays and noise
  double surface_area = 0.0;  ///< of the source mesh, world units^2; 0 = unknown
  std::uint64_t samples = 0;  ///< points the scene asks for on this object's meshes; 0 = it does not say
  std::vector<Mesh> meshes;   ///< source triangles in world space, kept only when ReadOptions::keep_meshes
};

/// Everything read from the input files.
struct Input {
  std::vector<InputObject> objects;
  std::vector<SceneLight> lights;
  std::optional<Camera> camera;
  std::optional<glm::dvec3> up;  ///< the format's own up axis (glTF: +y, scans: +z)
  ScanCounts scan_counts;        ///< of all files of scans
  std::string crs;               ///< Scene::crs; of files that differ unknown
  std::string environment_path;  ///< resolved path of the environment map the scene names; empty = none
  /// One sentence each: unknown properties, skipped parts, ignored extensions.
  std::vector<std::string> notes;
};

/// How scans are read.
struct ScanOptions {
  bool strict = false;            ///< a file that holds less than it says is refused
  bool ignore_checksums = false;  ///< pages whose checksum is wrong are read (E57)
  bool keep_withheld = false;     ///< points that are marked as deleted or as noise are kept
  std::string columns;  ///< of text files: names by comma, such as "x,y,z,intensity,-,r,g,b"; empty = found
  /// Further ones to keep, by name (extra bytes and fields of LAS, columns of text, PCD, PLY).
  std::vector<std::string> attributes;

  /// Where the scanner stood, world units after z_scale, for points whose file does not say; it decides the sides of their
  /// normals.
  std::optional<glm::dvec3> sensor_world;
  /// Text of times and places, where the sensor of points with times moved; empty = not known.
  std::filesystem::path trajectory;
  double z_scale = 1.0;  ///< factor on heights, > 0: 0.3048 where they are in feet beside metres

  bool operator==(const ScanOptions&) const = default;
};

/// Points of a file as they are read, for whoever shows them before all are.
struct SeenPoints {
  /// As the file has them: before ScanOptions::z_scale; of stored colours the scale may be open.
  const Points& points;
  std::size_t first;             ///< those before it were seen earlier, of the same file; 0 = a file begins
  bool measured;                 ///< a scanner's, else a mesh's vertices
  glm::dvec3 up{0.0, 0.0, 1.0};  ///< the format's own, of what is measured
};
/// Hears them on the reading thread, at intervals.
using PointsListener = std::function<void(const SeenPoints&)>;

/// Which nodes of files in levels (base/levels.h) are read, ascending, by the files' paths; files that are not named are read whole.
using ChosenNodes = std::map<std::filesystem::path, std::vector<std::uint32_t>>;

struct ReadOptions {
  /// Points to sample on all meshes together, by area; 0 = one point per used vertex.
  std::uint64_t samples = 0;
  std::uint64_t seed = 1;
  /// Folders searched for models a scene names, after the scene's own folder.
  std::vector<std::filesystem::path> data_paths;
  bool keep_meshes = false;
  /// For scans whose head counts their points, which are not read then; those of other formats are.
  bool heads_only = false;
  ChosenNodes nodes;  ///< of scans in levels
  bool clip = true;   ///< points on meshes know where the surface ends or has a crease
  /// Edges that turn by more, and are not shaded smoothly, are creases.
  double crease_degrees = BuildParams{}.crease_degrees;
  bool turn_outwards = false;  ///< closed meshes of all objects, not only of dielectrics, are turned outwards
  ScanOptions scans;
  unsigned threads = 0;     ///< 0 = all cores
  Progress progress{};      ///< of the stages "reading" and "sampling"; may be empty
  PointsListener points{};  ///< of files that are scans, or one mesh; may be empty
};

/// Reads one or more files into one Input (several files: one object each, but all scans together one; glTF: its own objects), by
/// their extensions (read/formats.h). A folder stands for the scans in it, by name, .ply among them; text and .bin that turn out
/// to be something else are left out there, with a note. Scans and stations without points are left out beside others, with a
/// note, too. Throws Error (input_unreadable), one sentence
/// with path, found and expected, or (interrupted) when `options.progress` says so.
[[nodiscard]] Input read_input(const std::vector<std::filesystem::path>& paths, const ReadOptions& options);

/// What read_input does with objects once they are read: points with times get the options' trajectory, heights and scanners are
/// adjusted, meshes become points (mesh/mesh_points.h). Throws Error as read_input does.
void finish_objects(Input& input, const ReadOptions& options);

}  // namespace splatray
