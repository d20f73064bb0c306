#include "preprocess/read/las/las_extra_bytes.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include "engine/base/utf8.h"
#include "preprocess/base/little_endian.h"
#include "preprocess/read/las/las_further_fields.h"
#include "preprocess/read/scan/column_names.h"
#include "preprocess/read/scan/missing_attributes.h"

namespace splatray {
namespace {

constexpr std::size_t EXTRA_DESCRIPTOR_BYTES = 192;
constexpr unsigned EXTRA_TYPES = 10;
constexpr std::size_t TYPE_BYTES[EXTRA_TYPES + 1] = {0, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
constexpr unsigned MOST_FLOAT_INTEGER = 4;  ///< types up to i16
constexpr unsigned FLOAT = 9;
constexpr unsigned OPTION_SCALE = 8;
constexpr unsigned OPTION_OFFSET = 16;

/// A finite number, or what stands for one.
double finite_or(double value, double otherwise) { return std::isfinite(value) ? value : otherwise; }

/// The component `i` of `width` of an attribute.
LasExtraBytes component(const unsigned char* descriptor, std::string_view name, unsigned type, unsigned i,
                        unsigned width) {
  const unsigned options = descriptor[3];
  LasExtraBytes one;
  one.name = to_utf8(name) + (width > 1 ? "[" + std::to_string(i) + "]" : "");
  one.type = type;
  if ((options & OPTION_SCALE) != 0) one.scale = finite_or(load<double>(descriptor + 112 + 8 * i), 1.0);
  if ((options & OPTION_OFFSET) != 0) one.offset = finite_or(load<double>(descriptor + 136 + 8 * i), 0.0);
  return one;
}

/// A name with its component by a letter: "normalx" of "normal[0]".
std::string lettered(const std::string& name) {
  const std::size_t bracket = name.size() - std::min<std::size_t>(name.size(), 3);
  const std::string_view suffix = std::string_view(name).substr(bracket);
  constexpr std::string_view SUFFIXES[] = {"[0]", "[1]", "[2]"};
  const auto* const found = std::find(std::begin(SUFFIXES), std::end(SUFFIXES), suffix);
  return found == std::end(SUFFIXES) ? name : name.substr(0, bracket) + "xyz"[found - std::begin(SUFFIXES)];
}

std::optional<std::array<LasExtraBytes, 3>> find_normal(const std::vector<LasExtraBytes>& all) {
  std::vector<std::string> names(all.size());
  std::transform(all.begin(), all.end(), names.begin(),
                 [](const LasExtraBytes& one) { return lettered(one.name); });
  const std::vector<std::string> meanings = known_columns(names);
  std::array<LasExtraBytes, 3> normal;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto found = std::find(meanings.begin(), meanings.end(), COLUMN_NORMALS[axis]);
    if (found == meanings.end()) return std::nullopt;
    normal[axis] = all[static_cast<std::size_t>(found - meanings.begin())];
  }
  return normal;
}

}  // namespace

std::size_t LasExtraBytes::bytes() const { return TYPE_BYTES[type]; }

bool LasExtraBytes::fits_float() const {
  return (type <= MOST_FLOAT_INTEGER || type == FLOAT) && scale == 1.0 && offset == 0.0;
}

double LasExtraBytes::value(const unsigned char* record) const {
  const unsigned char* bytes = record + at;
  const double number = [&]() -> double {
    switch (type) {
      case 1:
        return (load<std::uint8_t>(bytes) >> shift) & mask;
      case 2:
        return load<std::int8_t>(bytes);
      case 3:
        return load<std::uint16_t>(bytes);
      case 4:
        return load<std::int16_t>(bytes);
      case 5:
        return load<std::uint32_t>(bytes);
      case 6:
        return load<std::int32_t>(bytes);
      case 7:
        return static_cast<double>(load<std::uint64_t>(bytes));
      case 8:
        return static_cast<double>(load<std::int64_t>(bytes));
      case FLOAT:
        return load<float>(bytes);
      default:
        return load<double>(bytes);
    }
  }();
  return scale * number + offset;
}

bool LasExtraBytes::may_be_rounded(double value) const {
  constexpr unsigned U64 = 7, I64 = 8;
  constexpr double MOST_EXACT = 0x1p53;
  return (type == U64 || type == I64) && std::abs((value - offset) / scale) >= MOST_EXACT;
}

std::vector<LasExtraBytes> las_extra_bytes(std::span<const unsigned char> descriptors, std::size_t begin,
                                           std::size_t end) {
  std::vector<LasExtraBytes> all;
  for (std::size_t at = begin; descriptors.size() >= EXTRA_DESCRIPTOR_BYTES;
       descriptors = descriptors.subspan(EXTRA_DESCRIPTOR_BYTES)) {
    const unsigned char* descriptor = descriptors.data();
    const unsigned stored_type = descriptor[2];
    if (stored_type == 0) {  // bytes of no known meaning, as many as the options say
      at += descriptor[3];
      continue;
    }
    if (stored_type > 3 * EXTRA_TYPES) break;  // of unknown length
    const unsigned type = (stored_type - 1) % EXTRA_TYPES + 1;
    const unsigned width = (stored_type - 1) / EXTRA_TYPES + 1;
    std::string_view name(reinterpret_cast<const char*>(descriptor + 4), 32);
    name = name.substr(0, name.find('\0'));
    for (unsigned i = 0; i < width; ++i) {
      LasExtraBytes one = component(descriptor, name, type, i, width);
      one.at = at;
      at += one.bytes();
      if (at <= end) all.push_back(std::move(one));
    }
  }
  return all;
}

LasExtras chosen_extra_bytes(unsigned point_format, const std::vector<LasExtraBytes>& all,
                             const std::vector<std::string>& asked) {
  LasExtras chosen;
  for (const std::string& name : asked) {
    const std::size_t before = chosen.columns.size();
    std::copy_if(all.begin(), all.end(), std::back_inserter(chosen.columns),
                 [&](const LasExtraBytes& one) { return asks_for(name, one.name); });
    if (chosen.columns.size() > before) continue;
    if (auto field = las_further_field(point_format, name)) chosen.columns.push_back(*std::move(field));
  }
  chosen.normal = find_normal(all);
  const auto radius = std::find_if(all.begin(), all.end(),
                                   [](const LasExtraBytes& one) { return plain_name(one.name) == "radius"; });
  if (radius != all.end()) chosen.radius = *radius;
  return chosen;
}

}  // namespace splatray
