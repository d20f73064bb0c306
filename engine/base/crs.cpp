#include "engine/base/crs.h"

#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <span>

#include "engine/base/length_unit.h"
#include "engine/base/number_text.h"

namespace splatray {
namespace {

constexpr std::string_view EPSG = "EPSG:";

/// Every `step`-th number from `first` to `last`.
struct CodeRun {
  std::uint16_t first, last, step;
};

// EPSG's registry, version 11.022 of 5 November 2024: the projected and vertical systems whose first axis is in the unit 9003 or 9002.
// Numbers in the runs that are no system's do not matter.
constexpr CodeRun IN_US_FEET[] = {
    {2155, 2155, 1},   {2194, 2194, 1},   {2204, 2204, 1},   {2225, 2250, 1},   {2254, 2263, 3},
    {2255, 2287, 4},   {2258, 2264, 1},   {2268, 2277, 3},   {2272, 2278, 2},   {2284, 2289, 1},
    {2870, 2895, 1},   {2899, 2919, 4},   {2900, 2928, 4},   {2902, 2906, 1},   {2917, 2918, 1},
    {2925, 2930, 1},   {2964, 2968, 1},   {3089, 3091, 2},   {3102, 3102, 1},   {3363, 3365, 2},
    {3404, 3404, 1},   {3417, 3438, 1},   {3441, 3446, 1},   {3451, 3459, 1},   {3485, 3487, 2},
    {3490, 3512, 2},   {3515, 3553, 2},   {3560, 3570, 1},   {3582, 3586, 2},   {3598, 3600, 2},
    {3608, 3632, 2},   {3640, 3642, 2},   {3650, 3662, 4},   {3652, 3652, 1},   {3660, 3672, 4},
    {3670, 3674, 2},   {3677, 3686, 3},   {3688, 3700, 4},   {3690, 3690, 1},   {3698, 3698, 1},
    {3728, 3739, 1},   {3753, 3760, 1},   {3991, 3992, 1},   {4217, 4217, 1},   {4399, 4413, 1},
    {4418, 4433, 1},   {4438, 4439, 1},   {4455, 4457, 1},   {5623, 5625, 1},   {5646, 5646, 1},
    {5654, 5655, 1},   {5702, 5702, 1},   {6200, 6202, 1},   {6358, 6360, 1},   {6411, 6413, 2},
    {6416, 6438, 2},   {6441, 6479, 2},   {6484, 6492, 2},   {6501, 6507, 2},   {6510, 6510, 1},
    {6517, 6543, 2},   {6549, 6555, 2},   {6563, 6565, 2},   {6568, 6576, 4},   {6574, 6590, 4},
    {6584, 6588, 2},   {6593, 6609, 2},   {6612, 6618, 2},   {6625, 6627, 1},   {6633, 6633, 1},
    {6880, 6880, 1},   {6923, 6925, 2},   {6966, 6966, 1},   {6997, 6997, 1},   {7057, 7070, 1},
    {7128, 7368, 4},   {7258, 7370, 2},   {7587, 7645, 1},   {8035, 8036, 1},   {8052, 8053, 1},
    {8091, 8093, 2},   {8096, 8182, 2},   {8177, 8189, 3},   {8185, 8197, 4},   {8200, 8210, 2},
    {8213, 8216, 3},   {8220, 8226, 3},   {8224, 8224, 1},   {8380, 8384, 2},   {8387, 8387, 1},
    {8518, 8540, 1},   {9748, 9749, 1},   {10481, 10481, 1}, {10516, 10516, 1}, {10622, 10622, 1},
    {23301, 23333, 1}, {26729, 26813, 1}, {26847, 26870, 1}, {32001, 32058, 1}, {32064, 32077, 1},
    {32099, 32099, 1}, {32164, 32167, 1}, {32664, 32667, 1},
};
constexpr CodeRun IN_FEET[] = {
    {2222, 2224, 1}, {2251, 2253, 1},   {2256, 2256, 1}, {2265, 2273, 4}, {2266, 2270, 4}, {2280, 2282, 1},
    {2867, 2869, 1}, {2896, 2898, 1},   {2901, 2901, 1}, {2909, 2910, 1}, {2913, 2914, 1}, {2921, 2923, 1},
    {2992, 2994, 2}, {3080, 3080, 1},   {3359, 3361, 2}, {3479, 3483, 2}, {3588, 3590, 2}, {3593, 3593, 1},
    {3605, 3605, 1}, {3634, 3636, 2},   {3644, 3648, 2}, {3656, 3656, 1}, {3676, 3682, 3}, {5588, 5588, 1},
    {5614, 5614, 1}, {6128, 6141, 1},   {6391, 6391, 1}, {6405, 6409, 2}, {6494, 6496, 2}, {6499, 6499, 1},
    {6515, 6515, 1}, {6545, 6547, 2},   {6557, 6561, 2}, {6570, 6570, 1}, {6785, 6863, 2}, {6868, 6868, 1},
    {6885, 6887, 2}, {7119, 7127, 1},   {8050, 8051, 1}, {8065, 8068, 1}, {8228, 8348, 4}, {8314, 8346, 2},
    {8897, 8897, 1}, {20050, 20050, 1},
};

bool is_in(std::span<const CodeRun> runs, unsigned code) {
  return std::any_of(runs.begin(), runs.end(), [code](const CodeRun& run) {
    return code >= run.first && code <= run.last && (code - run.first) % run.step == 0;
  });
}

/// The text from a keyword such as "PROJCS[" to the bracket that closes it; empty where it is not there.
std::string_view block(std::string_view text, std::string_view keyword) {
  const std::size_t begin = text.find(keyword);
  if (begin == std::string_view::npos) return {};
  int depth = 0;
  for (std::size_t i = begin; i < text.size(); ++i) {
    depth += text[i] == '[' ? 1 : 0;
    depth -= text[i] == ']' ? 1 : 0;
    if (text[i] == ']' && depth == 0) return text.substr(begin, i - begin);
  }
  return text.substr(begin);
}

template <typename Number>
Number leading_number(std::string_view text) {
  Number number{};
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

/// Metres of a block's last unit, which is its own: UNIT["foot",0.3048]; 0 = none.
double last_unit_metres(std::string_view text) {
  const std::size_t unit = text.rfind("UNIT[\"");
  if (unit == std::string_view::npos) return 0.0;
  text = text.substr(unit);
  return leading_number<double>(text.substr(std::min(text.find("\",") + 2, text.size())));
}

/// EPSG's number of the system that the whole text is, which stands last in it: AUTHORITY["EPSG","25832"]] or ID["EPSG",25832]].
unsigned own_number(std::string_view text) {
  for (const std::string_view keyword : {"AUTHORITY[\"EPSG\",", "ID[\"EPSG\","}) {
    const std::size_t begin = text.rfind(keyword);
    if (begin == std::string_view::npos) continue;
    std::string_view number = text.substr(begin + keyword.size());
    if (std::count(number.begin(), number.end(), ']') != 2) continue;
    number.remove_prefix(std::min(number.find_first_not_of(" \""), number.size()));
    return leading_number<unsigned>(number);
  }
  return 0;
}

/// The block of the first of some keywords that is there.
std::string_view first_block(std::string_view text, std::initializer_list<std::string_view> keywords) {
  for (const std::string_view keyword : keywords)
    if (const std::string_view found = block(text, keyword); !found.empty()) return found;
  return {};
}

Crs describe_wkt(std::string_view text) {
  Crs crs;
  const std::size_t name = text.find("[\"");
  if (name == std::string_view::npos) return crs;
  crs.name = text.substr(name + 2, text.substr(name + 2).find('"'));
  const std::string_view projected = first_block(text, {"PROJCS[", "PROJCRS["});
  const std::string_view vertical = first_block(text, {"VERT_CS[", "VERTCRS["});
  const bool has_angles = text.find("GEOGCS[") != std::string_view::npos ||
                          text.find("GEOGCRS[") != std::string_view::npos ||
                          text.find("GEODCRS[") != std::string_view::npos;
  crs.epsg = own_number(text);
  crs.is_projected = !projected.empty();
  crs.is_degrees = projected.empty() && has_angles;
  crs.horizontal_metres = last_unit_metres(projected);
  crs.vertical_metres = last_unit_metres(vertical);
  return crs;
}

Crs describe_numbers(std::string_view text) {
  Crs crs;
  crs.name = text.substr(0, text.find(';'));
  const std::string_view number = std::string_view(crs.name).substr(EPSG.size());
  crs.epsg = leading_number<unsigned>(number);
  if (const std::size_t plus = number.find('+'); plus != std::string_view::npos)
    crs.vertical_epsg = leading_number<unsigned>(number.substr(plus + 1));
  for (std::size_t at = text.find(';'); at != std::string_view::npos; at = text.find(';', at + 1)) {
    const std::string_view part = text.substr(at + 1);
    if (part.starts_with("deg")) crs.is_degrees = true;
    if (part.starts_with("xy=")) crs.horizontal_metres = leading_number<double>(part.substr(3));
    if (part.starts_with("z=")) crs.vertical_metres = leading_number<double>(part.substr(2));
  }
  if (crs.horizontal_metres == 0.0) crs.horizontal_metres = epsg_system_metres(crs.epsg);
  if (crs.vertical_metres == 0.0) crs.vertical_metres = epsg_system_metres(crs.vertical_epsg);
  crs.is_projected = crs.horizontal_metres > 0.0;
  return crs;
}

}  // namespace

std::string epsg_text(unsigned horizontal, unsigned vertical, const Crs& units) {
  std::string text = std::string(EPSG) + std::to_string(horizontal);
  if (vertical != 0) text += "+" + std::to_string(vertical);
  if (units.is_degrees) text += ";deg";
  if (units.horizontal_metres > 0.0) text += ";xy=" + number_text(units.horizontal_metres);
  if (units.vertical_metres > 0.0) text += ";z=" + number_text(units.vertical_metres);
  return text;
}

Crs describe_crs(std::string_view text) {
  return text.starts_with(EPSG) ? describe_numbers(text) : describe_wkt(text);
}

std::string horizontal_crs(const std::string& text) {
  Crs crs = describe_crs(text);
  if (text.starts_with(EPSG)) {
    crs.vertical_metres = 0.0;
    return epsg_text(crs.epsg, 0, crs);
  }
  if (first_block(text, {"VERT_CS[", "VERTCRS["}).empty()) return text;
  const std::string_view own = first_block(text, {"PROJCS[", "PROJCRS[", "GEOGCS[", "GEOGCRS[", "GEODCRS["});
  return own.empty() ? "" : std::string(own) + "]";
}

std::string different_units(const Crs& crs) {
  if (!(crs.horizontal_metres > 0.0 && crs.vertical_metres > 0.0)) return "";
  if (is_same_unit(crs.vertical_metres, crs.horizontal_metres)) return "";
  return "z is in " + length_name(crs.vertical_metres) + " while x and y are in " +
         length_name(crs.horizontal_metres);
}

bool is_same_crs(std::string_view a, std::string_view b) {
  if (a == b) return true;
  const Crs first = describe_crs(a), second = describe_crs(b);
  if (first.epsg != 0 && second.epsg != 0)
    return first.epsg == second.epsg && first.vertical_epsg == second.vertical_epsg;
  return !first.name.empty() && first.name == second.name;
}

double epsg_unit_metres(unsigned code) {
  for (const LengthUnit& unit : LENGTH_UNITS)
    if (unit.epsg != 0 && unit.epsg == code) return unit.metres;
  return 0.0;
}

double epsg_system_metres(unsigned code) {
  constexpr unsigned US_FOOT = 9003, FOOT = 9002;
  if (is_in(IN_US_FEET, code)) return epsg_unit_metres(US_FOOT);
  return is_in(IN_FEET, code) ? epsg_unit_metres(FOOT) : 0.0;
}

std::uint16_t epsg_unit(double metres) {
  const LengthUnit* unit = find_length_unit(metres);
  return unit != nullptr ? unit->epsg : std::uint16_t{0};
}

}  // namespace splatray
