/// The library that is loaded when a file of VTK's is opened: all of VTK that this project uses.
#pragma once
#include <filesystem>

#include "preprocess/points.h"
#include "preprocess/read/read_listener.h"

/// Reads a VTP that check_vtp has seen. Throws as read_vtp does.
extern "C" void splatray_read_vtp(const std::filesystem::path& path, const splatray::ReadListener& listener,
                                  splatray::Mesh& mesh);
