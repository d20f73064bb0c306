#include <nanobind/stl/array.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "app/python/module.h"

namespace splatray::python {
namespace {

void add_material(nb::module_& module) {
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
      .def_rw("hidden", &api::Material::hidden)
      .def_rw("metallic", &api::Material::metallic, nb::arg().none())
      .def_rw("roughness", &api::Material::roughness, nb::arg().none())
      .def_rw("coat", &api::Material::coat, nb::arg().none())
      .def_rw("coat_roughness", &api::Material::coat_roughness, nb::arg().none())
      .def_rw("emission", &api::Material::emission, nb::arg().none());
}

void add_camera(nb::module_& module) {
  nb::class_<api::Camera>(module, "Camera")
      .def(nb::init<>())
      .def_rw("eye", &api::Camera::eye)
      .def_rw("target", &api::Camera::target)
      .def_rw("up", &api::Camera::up)
      .def_rw("fov", &api::Camera::fov_y_deg)
      .def_rw("ortho_height", &api::Camera::ortho_height)
      .def_rw("lens_shift", &api::Camera::lens_shift)
      .def_rw("pixel_aspect", &api::Camera::pixel_aspect)
      .def_rw("panorama", &api::Camera::panorama);
  module.def("camera_from_pose", api::camera_from_pose, nb::arg("pose"), nb::arg("k"), nb::arg("width"),
             nb::arg("height"));
}

/// Texts alone: the Python files beside this one make them of what users give.
void add_request(nb::module_& module) {
  nb::class_<api::FieldInfo>(module, "FieldInfo")
      .def_ro("name", &api::FieldInfo::name)
      .def_ro("group", &api::FieldInfo::group)
      .def_ro("kind", &api::FieldInfo::kind)
      .def_ro("value", &api::FieldInfo::value)
      .def_ro("help", &api::FieldInfo::help)
      .def_ro("repeated", &api::FieldInfo::repeated)
      .def_ro("least", &api::FieldInfo::least)
      .def_ro("most", &api::FieldInfo::most)
      .def_ro("opens", &api::FieldInfo::opens)
      .def_ro("renders", &api::FieldInfo::renders);
  nb::class_<api::Request>(module, "Request")
      .def(nb::init<>())
      .def("set", [](api::Request& request, const std::string& name,
                     const std::string& text) { request.set(name, text); })
      .def("add", [](api::Request& request, const std::string& name,
                     const std::string& text) { request.add(name, text); })
      .def("set_camera", [](api::Request& request, const api::Camera& camera) { request.set_camera(camera); })
      .def("add_material", [](api::Request& request, const std::string& object,
                              const api::Material& material) { request.add_material(object, material); })
      .def("get", &api::Request::get)
      .def("json", &api::Request::json)
      .def("copy", [](const api::Request& request) { return new api::Request(request); })
      .def_static("from_json",
                  [](const std::string& text) { return new api::Request(api::Request::from_json(text)); })
      .def_static("of_picture", [](const std::filesystem::path& picture) {
        return new api::Request(api::Request::of_picture(picture));
      });
  module.def("fields", api::Request::fields);
}

}  // namespace

void add_values(nb::module_& module) {
  add_material(module);
  add_camera(module);
  add_request(module);
}

}  // namespace splatray::python
