#include "app/library/picture/lod_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "app/library/display_image.h"
#include "app/library/shot/picture_lights.h"
#include "app/library/shot/resolve.h"
#include "app/library/user_folders.h"
#include "engine/base/error.h"
#include "engine/base/interrupt.h"

namespace splatray {
namespace {

constexpr std::uint32_t COLUMNS = 5, ROWS = 4, PART_PX = 32;

/// Student's distribution: 97.5 % lie below, for so many degrees of freedom; Cornish and Fisher's expansion (1937), within 0.5 % from 4 on.
double student_975(double degrees) {
  constexpr double NORMAL = 1.959964;
  const double z2 = NORMAL * NORMAL;
  return NORMAL * (1.0 + (z2 + 1.0) / (4.0 * degrees) +
                   (5.0 * z2 * z2 + 16.0 * z2 + 3.0) / (96.0 * degrees * degrees));
}

/// The sum of one value of the parts over that of another, and half of its 95 % interval.
template <class Above, class Below>
std::array<double, 2> ratio_of(const std::vector<LodErrorPart>& parts, Above above, Below below) {
  double sum_above = 0.0, sum_below = 0.0, squares = 0.0;
  for (const LodErrorPart& part : parts) {
    sum_above += above(part);
    sum_below += below(part);
  }
  if (!(sum_below > 0.0)) return {0.0, 0.0};
  const double ratio = sum_above / sum_below;
  for (const LodErrorPart& part : parts) {
    const double rest = above(part) - ratio * below(part);
    squares += rest * rest;
  }
  const auto count = static_cast<double>(parts.size());
  return {ratio, student_975(count - 1.0) * std::sqrt(squares * count / (count - 1.0)) / sum_below};
}

/// +inf for no error, and for less than none, which is found where noise hides it.
double decibels(double squared_error) {
  return squared_error > 0.0 ? -10.0 * std::log10(squared_error) : std::numeric_limits<double>::infinity();
}

/// A scene on a device in the light of the shot.
struct Traced {
  SceneOnDevice& shown;
  Look look;
};

Image trace(const Traced& traced, const View& view, const Settings& settings) {
  return traced.shown.tracer().render(traced.look, view, settings, [](double) { return !interrupted(); });
}

/// Another picture's samples: seeds of people are small.
constexpr std::uint32_t OTHER_SEED = 0x9E3779B9U;

LodErrorPart compare_part(const Shot& shot, const Traced& some, const Traced& all, const View& view) {
  Settings settings = shot.settings;
  settings.aov = settings.estimate_error = settings.counters = false;
  const Display display{shot.request.look.exposure_ev.value_or(0.0), resolve_tone(shot.request)};
  std::array<Image, 2> read, whole;
  for (std::size_t i = 0; i < 2; ++i) {
    if (i == 1) settings.seed ^= OTHER_SEED;
    read[i] = trace(some, view, settings);
    whole[i] = trace(all, view, settings);
  }
  LodErrorPart part;
  const auto difference = [&](std::size_t i, std::size_t pixel) {
    return display_value(vec3(read[i].rgba[pixel]), display) -
           display_value(vec3(whole[i].rgba[pixel]), display);
  };
  for (std::size_t pixel = 0; pixel < read[0].rgba.size(); ++pixel) {
    for (std::size_t i = 0; i < 2; ++i) {
      part.radiance += double{glm::dot(vec3(read[i].rgba[pixel]), vec3(1.0F))};
      part.radiance_of_all += double{glm::dot(vec3(whole[i].rgba[pixel]), vec3(1.0F))};
    }
    // The pairs are independent: what noise adds to their product is 0 in the mean.
    part.squares += double{glm::dot(difference(0, pixel), difference(1, pixel))};
    part.values += 3;
  }
  return part;
}

std::string signed_text(const char* format, double value) {
  std::array<char, 32> text{};
  (void)std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

}  // namespace

LodError lod_error_of(const std::vector<LodErrorPart>& parts) {
  const auto [bias, bias_half] = ratio_of(
      parts, [](const LodErrorPart& part) { return part.radiance - part.radiance_of_all; },
      [](const LodErrorPart& part) { return part.radiance_of_all; });
  const auto [error, error_half] = ratio_of(
      parts, [](const LodErrorPart& part) { return part.squares; },
      [](const LodErrorPart& part) { return double(part.values); });
  return {{bias, bias - bias_half, bias + bias_half},
          {decibels(error), decibels(error + error_half), decibels(error - error_half)}};
}

std::string lod_error_text(const LodError& error) {
  const auto percent = [](double share) { return signed_text("%+.2f", 100.0 * share); };
  const auto db = [](double value) { return signed_text("%.1f", value); };
  return "mean " + percent(error.bias.value) + " % (" + percent(error.bias.low) + " to " +
         percent(error.bias.high) + "), PSNR " + db(error.psnr_db.value) + " dB (" + db(error.psnr_db.low) +
         " to " + db(error.psnr_db.high) + ")";
}

std::vector<PixelWindow> lod_error_windows(const PixelWindow& made, std::uint32_t seed) {
  std::vector<PixelWindow> windows;
  std::mt19937 dice(seed);
  const std::uint32_t columns = std::min(COLUMNS, made.width), rows = std::min(ROWS, made.height);
  // Where a part of a divided side begins, and its length.
  const auto part = [&dice](std::uint32_t side, std::uint32_t parts, std::uint32_t i) {
    const std::uint32_t low = side * i / parts, field = side * (i + 1) / parts - low;
    const std::uint32_t length = std::min(field, PART_PX);
    return std::pair{low + static_cast<std::uint32_t>(dice() % (field - length + 1)), length};
  };
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column) {
      const auto [x, width] = part(made.width, columns, column);
      const auto [y, height] = part(made.height, rows, row);
      windows.push_back({made.x + x, made.y + y, width, height});
    }
  return windows;
}

void measure_lod_error(Shot& shot, SceneOnDevice& shown, const LoadedScene& loaded,
                       const std::function<void(const std::string&)>& note) {
  if (!shot.request.output.lod_error) return;
  if (!loaded.facts.overview) {
    note("--lod-error: all points were read, nothing differs");
    return;
  }
  if (shot.settings.cutaway) {
    note(
        "--lod-error: nothing is said of --view dollhouse, as walls that are left out by their sides may be "
        "others of other points");
    return;
  }
  const Camera camera = first_camera(shot, *loaded.facts.overview);
  std::vector<View> parts;
  for (const PixelWindow& window : lod_error_windows(shot.view.made(), shot.settings.seed))
    parts.push_back({camera, shot.view.width, shot.view.height, window});
  const ChosenNodes nodes = with_all_seen(shot.request, parts, in_levels(shot.request), loaded.nodes);
  Scene scene = load_nodes_of(shot.request, loaded.facts, nodes,
                              {[](const char*, double) { return !interrupted(); }, {}});
  SceneOnDevice whole(shown.device(),
                      {.pipeline_folder = user_cache_folder(), .threads = shot.request.source.threads});
  whole.open_and_free(scene);
  whole.show_environment(shot.environment);
  whole.show_materials(shown.look().materials);
  const Traced some{shown, lit_look(shot, shown, camera).look};
  Traced all{whole, whole.look()};
  all.look.lights = some.look.lights;
  std::vector<LodErrorPart> found;
  for (const View& part : parts) found.push_back(compare_part(shot, some, all, part));
  shot.lod_error = lod_error_text(lod_error_of(found));
  note("what was not read changes the picture's " + shot.lod_error + ", with 95 %, as " +
       std::to_string(parts.size()) + " parts of it say");
}

}  // namespace splatray
