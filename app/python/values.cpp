#include <nanobind/stl/array.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "app/python/module.h"

namespace splatray::python {
namespace {

void add_scene_values(nb::module_& module) {
  nb::class_<api::Material>(module, "Material")
      .def(nb::init<>())
      .def_rw("diffuse", &api::Material::diffuse)
      .def_rw("specular", &api::Material::specular)
      .def_rw("shininess", &api::Material::shininess)
      .def_rw("tint", &api::Material::tint)
      .def_rw("mirror", &api::Material::mirror)
      .def_rw("ior", &api::Material::ior)
      .def_rw("glass", &api::Material::glass)
      .def_rw("two_sided", &api::Material::two_sided)
      .def_rw("hidden", &api::Material::hidden);
  nb::class_<api::OpenOptions>(module, "OpenOptions")
      .def(nb::init<>())
      .def_rw("radius_scale", &api::OpenOptions::radius_scale)
      .def_rw("mesh_points", &api::OpenOptions::mesh_points)
      .def_rw("data", &api::OpenOptions::data)
      .def_rw("color_by", &api::OpenOptions::color_by)
      .def_rw("up", &api::OpenOptions::up)
      .def_rw("threads", &api::OpenOptions::threads)
      .def_rw("device", &api::OpenOptions::device)
      .def_rw("cache", &api::OpenOptions::cache);
}

void add_picture_values(nb::module_& module) {
  nb::class_<api::Camera>(module, "Camera")
      .def(nb::init<>())
      .def_rw("eye", &api::Camera::eye)
      .def_rw("target", &api::Camera::target)
      .def_rw("up", &api::Camera::up)
      .def_rw("fov", &api::Camera::fov_y_deg)
      .def_rw("ortho_height", &api::Camera::ortho_height);
  nb::class_<api::Light>(module, "Light")
      .def(nb::init<>())
      .def_prop_rw(
          "point", [](const api::Light& light) { return light.kind == api::Light::Kind::point; },
          [](api::Light& light, bool point) {
            light.kind = point ? api::Light::Kind::point : api::Light::Kind::directional;
          })
      .def_rw("position", &api::Light::position)
      .def_rw("size", &api::Light::size)
      .def_rw("power", &api::Light::power);
  nb::class_<api::Look>(module, "Look")
      .def(nb::init<>())
      .def_prop_rw(
          "style", [](const api::Look& look) { return static_cast<int>(look.style); },
          [](api::Look& look, int style) { look.style = static_cast<api::Style>(style); })
      .def_rw("lights", &api::Look::lights)
      .def_rw("environment", &api::Look::environment)
      .def_rw("environment_strength", &api::Look::environment_strength)
      .def_rw("environment_turn", &api::Look::environment_turn)
      .def_rw("materials", &api::Look::materials);
  nb::class_<api::Settings>(module, "Settings")
      .def(nb::init<>())
      .def_rw("samples", &api::Settings::samples)
      .def_rw("seed", &api::Settings::seed)
      .def_rw("bounces", &api::Settings::max_bounces)
      .def_rw("shadows", &api::Settings::shadows)
      .def_rw("channels", &api::Settings::channels);
}

}  // namespace

void add_values(nb::module_& module) {
  add_scene_values(module);
  add_picture_values(module);
}

}  // namespace splatray::python
