#include "preprocess/read/vtk/read_vtk.h"

#include <string>
#include <vector>

#include "engine/base/module.h"
#include "preprocess/base/file_extension.h"
#include "preprocess/read/bytes/byte_reader.h"
#include "preprocess/read/find_file.h"
#include "preprocess/read/vtk/vtk_legacy_check.h"
#include "preprocess/read/vtk/vtk_module.h"
#include "preprocess/read/vtk/vtk_xml_check.h"

namespace splatray {
namespace {

using Path = std::filesystem::path;

bool is_list(const Path& path) {
  const std::string extension = lower_extension(path);
  return extension == ".pvtp" || extension == ".pvtu";
}

/// The files whose names a list gives, each checked.
std::vector<Path> checked_pieces(const Path& list, const ReadListener& listener) {
  const std::vector<std::string> names = check_vtk_xml(list, listener.part(0.0, 0.05));
  if (names.empty()) throw_unreadable(list, "found no pieces in it, expected names of files");
  const std::string kind = lower_extension(list) == ".pvtp" ? ".vtp" : ".vtu";
  std::vector<Path> pieces;
  for (const std::string& name : names) {
    if (!stays_inside(name))
      throw_unreadable(list, "found a piece '" + name + "', expected a file in its folder or below");
    if (lower_extension(name) != kind)
      throw_unreadable(list, "found a piece '" + name + "', expected a " + kind);
    pieces.push_back(list.parent_path() / name);
  }
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto share = [&](std::size_t n) {
      return 0.05 + 0.15 * static_cast<double>(n) / static_cast<double>(pieces.size());
    };
    if (!check_vtk_xml(pieces[i], listener.part(share(i), share(i + 1))).empty())
      throw_unreadable(pieces[i], "found pieces named in a piece, expected points");
  }
  return pieces;
}

std::vector<Path> checked_files(const Path& path, const ReadListener& listener) {
  if (is_list(path)) return checked_pieces(path, listener);
  if (lower_extension(path) == ".vtk")
    check_vtk_legacy(path, listener.part(0.0, 0.2));
  else
    static_cast<void>(check_vtk_xml(path, listener.part(0.0, 0.2)));
  return {path};
}

}  // namespace

Mesh read_vtk(const Path& path, const ReadListener& listener) {
  void* function = module_function("splatray_vtk", "splatray_read_vtk", ExitCode::input_unreadable,
                                   path.string() + ": cannot read VTK's format " + lower_extension(path),
                                   ": the package splatray-vtk (Python's wheel has no VTK)");
  const std::vector<Path> files = checked_files(path, listener);
  Mesh mesh;
  reinterpret_cast<decltype(&splatray_read_vtk)>(function)(files, listener.part(0.2, 1.0), mesh);
  return mesh;
}

}  // namespace splatray
