#include "preprocess/read/text/unnamed_columns.h"

#include <cmath>
#include <iterator>

#include "engine/scene/columns.h"
#include "preprocess/read/scan/column_names.h"

namespace splatray {
namespace {

using Lists = std::vector<const std::vector<float>*>;

enum class ColumnsKind { colors, normals, unknown };

ColumnsKind kind_of(const Lists& columns, std::size_t first) {
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
  if (known > 0 && 10 * unit >= 9 * known) return ColumnsKind::normals;
  const bool in_range = least >= 0.0F && (most <= 1.0F || (whole && most <= 65535.0F));
  return known > 0 && in_range ? ColumnsKind::colors : ColumnsKind::unknown;
}

}  // namespace

bool are_normals(const Lists& columns, std::size_t first) {
  return kind_of(columns, first) == ColumnsKind::normals;
}

std::vector<std::string> guess_columns(const Lists& columns, std::vector<std::string>& notes) {
  const std::size_t count = columns.size();
  std::vector<std::string> meanings(count);
  const std::size_t triples = count % 3 == 1 ? 1 : 0;  // where they begin
  if (count == 0 || count > 7 || count % 3 == 2) {
    if (count > 0)
      notes.push_back("its " + std::to_string(count) +
                      " columns behind x, y and z have no names and were left out; name them by --columns");
    return meanings;
  }
  if (triples == 1) meanings[0] = COLUMN_INTENSITY;
  bool taken[2] = {false, false};
  std::string said = triples == 1 ? "intensity" : "";
  for (std::size_t first = triples; first + 2 < count; first += 3) {
    const ColumnsKind kind = kind_of(columns, first);
    const auto which = static_cast<std::size_t>(kind);
    said += said.empty() ? "" : ", ";
    if (kind == ColumnsKind::unknown || taken[which]) {
      said += "three unknown ones, left out";
      continue;
    }
    taken[which] = true;
    said += kind == ColumnsKind::colors ? "colours" : "normals";
    const auto& names = kind == ColumnsKind::colors ? COLUMN_COLORS : COLUMN_NORMALS;
    for (std::size_t i = 0; i < 3; ++i) meanings[first + i] = names[i];
  }
  notes.push_back("its columns have no names and are taken as x, y, z, " + said +
                  "; --columns names them otherwise");
  return meanings;
}

}  // namespace splatray
