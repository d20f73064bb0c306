/// The examples of the library's page; main.cpp runs them.
#pragma once
#include <filesystem>
#include <string>

#include <splatray.h>

splatray::api::Image picture_of_a_file(const std::filesystem::path& file);
splatray::api::Scene scene_of_arrays();
splatray::api::Scene ball_on_a_floor();
splatray::api::Image as_photographed(const splatray::api::Scene& scene);
splatray::api::Image gold_at_night(const splatray::api::Scene& scene);
void turntable(const splatray::api::Scene& scene, const std::filesystem::path& folder);
std::vector<float> simulated_lidar(const splatray::api::Scene& scene, const splatray::api::Double3& place);
std::vector<splatray::api::Image> depth_of_poses(const splatray::api::Scene& scene,
                                                 const std::vector<splatray::api::Camera>& poses);
std::string give_up_after(const splatray::api::Scene& scene, double seconds);
