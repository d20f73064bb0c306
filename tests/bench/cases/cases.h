/// The committed list of what is measured: scenes, and the settings tried on each.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/image/view.h"
#include "tests/bench/truth/analytic.h"

namespace splatray::testing {

/// Where a case's points come from.
enum class Origin {
  model,  ///< a model of data/models.h
  mesh,   ///< a file of the data folder (SPLATRAY_DATA_DIR)
  scene,  ///< a glTF scene of data/scenes or data/figures
};

/// What is measured of a case.
enum class Measure {
  picture,  ///< ms per frame, and the picture against the truth: Case::shape if there is one, else the mesh
  frame,    ///< ms per frame only
  brute_force,  ///< answers to rays against brute force over all splats
  wedge,        ///< mirrored rays between two planes
  ball,         ///< mirrored rays inside a sphere
  leaks,        ///< paths that leave a glass object without crossing its surface
  samples,      ///< noise against a render of REFERENCE_SAMPLES samples
};

/// One scene file of a case: how many points, and how they became splats.
struct Variant {
  std::uint64_t points = 0;  ///< in all, about; 0 = a mesh's vertices, or what a scene asks for
  bool even = true;          ///< models: even points; false = independent random ones (white noise)
  BuildParams build;         ///< `samples` is not used

  bool operator==(const Variant& other) const;
};

/// One line of the report: a scene file and the method it is shown with.
struct Run {
  Variant variant;
  Settings settings;
  /// The knob that is not at its default, as the record's settings name it; empty = none.
  std::string varied;
};

struct Case {
  std::string name;   ///< "bunny 1M"; unique
  std::string scene;  ///< "bunny": cases of one scene share a figure
  Measure measure = Measure::picture;
  Origin origin = Origin::model;
  std::string source;          ///< name of the model, or path inside the data folder or the repository
  std::optional<Shape> shape;  ///< the exact shape of the model
  double wedge_deg = 90.0;     ///< opening angle; Measure::wedge only
  std::uint32_t width = 512, height = 512;  ///< pixels
  double fill = 0.8;  ///< share of the picture's height that the model fills; 0 = the scene's own camera
  /// That probe an analytic shape, or paths that are followed or compared with brute force.
  std::size_t rays = 1U << 18U;
  std::vector<Run> runs;  ///< the first is the default, whose splats the camera is fitted to
};

inline constexpr std::uint32_t REFERENCE_SAMPLES = 1024;

/// All cases, or with `quick` those that take less than a minute in all.
[[nodiscard]] std::vector<Case> cases(bool quick);

/// The different variants of a case's runs, in order.
[[nodiscard]] std::vector<Variant> variants_of(const Case& one);

/// File names of a case's folder and of a variant in it (".soct"): letters, digits and hyphens.
[[nodiscard]] std::string folder_name(const Case& one);
[[nodiscard]] std::string file_name(const Variant& variant);

/// Words of settings as the programs' options have them: overlap, coverage, window, rim, side.
[[nodiscard]] std::string word(Insertion insertion);
[[nodiscard]] std::string word(RadiusRule rule);
[[nodiscard]] std::string blend_word(std::uint32_t blend);
[[nodiscard]] std::string kernel_word(std::uint32_t kernel);
[[nodiscard]] std::string side_word(std::uint32_t side);

}  // namespace splatray::testing
