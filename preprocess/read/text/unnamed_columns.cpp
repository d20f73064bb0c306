#include "preprocess/read/text/unnamed_columns.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/scene/columns.h"
#include "preprocess/read/scan/column_names.h"

namespace splatray {
namespace {

using Lists = std::vector<const std::vector<float>*>;

enum class ColumnsKind { colors, normals, unknown };

/// What three columns are, and how surely: of each kind, 3 normals, 2 colours of 8 bits, 1 other colours, 0 unknown.
struct Triple {
  ColumnsKind kind = ColumnsKind::unknown;
  int evidence = 0;
};

Triple triple_of(const Lists& columns, std::size_t first) {
  const std::vector<float>& a = *columns[first];
  const std::vector<float>& b = *columns[first + 1];
  const std::vector<float>& c = *columns[first + 2];
  bool whole = true;
  float least = INFINITY;
  float most = -INFINITY;
  std::size_t unit = 0;
  std::size_t known = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const float length = std::sqrt(a[i] * a[i] + b[i] * b[i] + c[i] * c[i]);
    if (!std::isfinite(length)) continue;
    ++known;
    unit += std::fabs(length - 1.0F) < 0.05F ? 1 : 0;
    for (const float value : {a[i], b[i], c[i]}) {
      whole = whole && value == std::floor(value);
      least = std::fmin(least, value);
      most = std::fmax(most, value);
    }
  }
  if (known > 0 && 10 * unit >= 9 * known) return {ColumnsKind::normals, 3};
  const bool in_range = least >= 0.0F && (most <= 1.0F || (whole && most <= 65535.0F));
  if (known == 0 || !in_range) return {};
  return {ColumnsKind::colors, most > 1.0F && most <= 255.0F ? 2 : 1};
}

/// How sure all triples are where intensity is in this column.
int evidence_of(const Lists& columns, std::size_t intensity) {
  int sum = 0;
  for (std::size_t first = intensity == 0 ? 1 : 0; first + 2 < columns.size();
       first += first + 3 == intensity ? 4 : 3)
    sum += triple_of(columns, first).evidence;
  return sum;
}

}  // namespace

bool are_normals(const Lists& columns, std::size_t first) {
  return triple_of(columns, first).kind == ColumnsKind::normals;
}

IntensityPlace find_intensity(const Lists& columns) {
  IntensityPlace found;
  int best = evidence_of(columns, 0);
  for (std::size_t column = 3; column < columns.size(); column += 3) {
    const int evidence = evidence_of(columns, column);
    if (evidence > best)
      found = {column, true};
    else if (evidence == best && best > 0)
      found.is_sure = false;
    best = std::max(best, evidence);
  }
  return found;
}

std::vector<std::string> guess_columns(const Lists& columns, std::vector<std::string>& notes) {
  const std::size_t count = columns.size();
  std::vector<std::string> meanings(count);
  if (count == 0 || count > 7 || count % 3 == 2) {
    if (count > 0)
      notes.push_back("its " + std::to_string(count) +
                      " columns behind x, y and z have no names and were left out; name them by --columns");
    return meanings;
  }
  const IntensityPlace intensity = count % 3 == 1 ? find_intensity(columns) : IntensityPlace{count, true};
  bool taken[2] = {false, false};
  std::string said;
  for (std::size_t first = 0; first < count;) {
    if (first == intensity.column) {
      meanings[first++] = COLUMN_INTENSITY;
      said += ", intensity";
      continue;
    }
    const ColumnsKind kind = triple_of(columns, first).kind;
    const auto which = static_cast<std::size_t>(kind);
    const bool is_known = kind != ColumnsKind::unknown && !taken[which];
    said += !is_known                     ? ", three unknown ones, left out"
            : kind == ColumnsKind::colors ? ", colours"
                                          : ", normals";
    const auto& names = kind == ColumnsKind::colors ? COLUMN_COLORS : COLUMN_NORMALS;
    for (std::size_t i = 0; i < 3 && is_known; ++i) meanings[first + i] = names[i];
    if (is_known) taken[which] = true;
    first += 3;
  }
  notes.push_back(
      "its columns have no names and are taken as x, y, z" + said +
      (intensity.is_sure ? "" : ", though by its values intensity could stand elsewhere among them") +
      "; --columns names them otherwise");
  return meanings;
}

}  // namespace splatray
