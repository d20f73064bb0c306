/// The library that is loaded when a file of VTK's is opened: all of VTK that this project uses.
#pragma once
#include <filesystem>
#include <vector>

#include "preprocess/points.h"
#include "preprocess/read/read_listener.h"

/// Reads files that check_vtk_xml or check_vtk_legacy has seen, the pieces of one whole. Throws as read_vtk does.
extern "C" void splatray_read_vtk(const std::vector<std::filesystem::path>& files,
                                  const splatray::ReadListener& listener, splatray::Mesh& mesh);
