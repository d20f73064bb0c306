#include "preprocess/write/write_points.h"

#include "engine/base/error.h"
#include "preprocess/base/file_extension.h"
#include "preprocess/write/point_output.h"

namespace splatray {
namespace {

struct PointFormat {
  const char* extension;
  void (*write)(const PointTable& table, PointOutput& out);
};

constexpr PointFormat WRITTEN_FORMATS[] = {
    {".ply", write_ply}, {".las", write_las}, {".csv", write_csv}, {".vtp", write_vtp}};

const PointFormat* point_format(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  for (const PointFormat& format : WRITTEN_FORMATS)
    if (extension == format.extension) return &format;
  return nullptr;
}

}  // namespace

void PointOutput::report(double share) const {
  if (progress_ && !progress_("writing", share))
    throw Error(ExitCode::interrupted, "writing the points was interrupted");
}

bool is_point_output(const std::filesystem::path& path) {
  if (point_format(path) != nullptr) return true;
  if (lower_extension(path) != ".soct")
    throw Error(ExitCode::usage, "found output '" + path.string() +
                                     "', expected .soct, or .ply, .las, .csv or .vtp for the points");
  return false;
}

void write_points(const PointTable& table, const std::filesystem::path& path, const Progress& progress) {
  AtomicFile file(path);
  PointOutput out(file, progress, table.size);
  point_format(path)->write(table, out);
  file.commit();
}

}  // namespace splatray
