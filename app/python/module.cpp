// splatray._core: the library's interface as the Python files beside it use it. They check and convert what users give.
#include <nanobind/stl/array.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <tuple>

#include "app/python/module.h"

namespace splatray::python {
namespace {

api::Scene* open(const std::vector<std::filesystem::path>& files, const api::Request& request,
                 const nb::object& progress) {
  const api::Progress relay = progress_of(progress);
  return unlocked([&] { return new api::Scene(api::open(files, request, relay)); });
}

api::Camera frame(const api::Scene& scene, std::optional<double> azimuth, std::optional<double> elevation,
                  std::optional<double> fov, double aspect) {
  return unlocked([&] { return api::frame(scene, {azimuth, elevation, fov, aspect}); });
}

std::vector<std::pair<std::string, std::string>> choices_of(const std::vector<api::Choice>& choices) {
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const api::Choice& choice : choices) pairs.emplace_back(choice.field, choice.value);
  return pairs;
}

api::Image* render(const api::Scene& scene, const api::Request& request, const nb::object& progress) {
  const api::Progress relay = progress_of(progress);
  return unlocked([&] { return new api::Image(api::render(scene, request, relay)); });
}

/// The files written, names and values of what was chosen, and notes.
nb::tuple make(const api::Scene& scene, const api::Request& request, const nb::object& progress) {
  const api::Progress relay = progress_of(progress);
  const api::Made made = unlocked([&] { return api::make(scene, request, relay); });
  std::vector<std::string> files;
  for (const std::filesystem::path& file : made.files) files.push_back(file.string());
  return nb::make_tuple(files, choices_of(made.choices), made.notes);
}

api::Image* make_picture(const api::Request& request, const nb::object& progress) {
  const api::Progress relay = progress_of(progress);
  return unlocked([&] { return new api::Image(api::make_picture(request, relay)); });
}

std::span<const double> numbers(const Numbers<double>& array) { return {array.data(), array.shape(0)}; }

template <typename Value>
nb::tuple trace(const api::Scene& scene, const Rows<Value>& origins, const Rows<Value>& directions,
                const Numbers<double>& t_max, const nb::object& progress) {
  const api::Progress relay = progress_of(progress);
  api::Hits hits =
      unlocked([&] { return api::trace(scene, rows(origins), rows(directions), numbers(t_max), relay); });
  const std::size_t count = hits.t.size();
  return nb::make_tuple(owning_array<double>(std::move(hits.t), {count}),
                        owning_array<float>(std::move(hits.normal), {count, 3}),
                        owning_array<std::int32_t>(std::move(hits.object), {count}),
                        owning_array<std::int64_t>(std::move(hits.splat), {count}),
                        owning_array<std::int64_t>(std::move(hits.point), {count}));
}

template <typename Value>
nb::object occluded(const api::Scene& scene, const Rows<Value>& origins, const Rows<Value>& directions,
                    const Numbers<double>& t_max, const nb::object& progress) {
  const api::Progress relay = progress_of(progress);
  std::vector<std::uint8_t> met =
      unlocked([&] { return api::occluded(scene, rows(origins), rows(directions), numbers(t_max), relay); });
  const std::size_t count = met.size();
  return owning_array<bool>(std::move(met), {count});
}

using PythonPlace = std::pair<api::Double3, std::optional<api::Double3>>;
using PythonValue = std::tuple<std::string, double, double, std::string>;

/// Points (n, 3), and name, value, within, unit of each value.
nb::tuple measure(const api::Scene& scene, const std::string& kind, const std::vector<PythonPlace>& places,
                  double reach, const std::string& base, const api::Request& request,
                  const nb::object& progress) {
  api::Measuring measuring{kind, {}, reach, base};
  for (const auto& [at, direction] : places) measuring.places.push_back({at, direction});
  const api::Progress relay = progress_of(progress);
  api::Measure measure = unlocked([&] { return api::measure(scene, measuring, request, relay); });
  std::vector<PythonValue> values;
  for (const api::MeasureValue& value : measure.values)
    values.emplace_back(value.name, value.value, value.within, value.unit);
  const std::size_t count = measure.points.size();
  return nb::make_tuple(owning_array<double>(std::move(measure.points), {count, 3}), values);
}

nb::tuple splats(const api::Scene& scene) {
  const std::size_t count = scene.splats();
  std::vector<api::Double3> centers, normals;
  std::vector<double> radii;
  std::vector<std::int32_t> objects;
  for (std::size_t i = 0; i < count; ++i) {
    const api::Scene::Splat splat = scene.splat(i);
    centers.push_back(splat.center);
    normals.push_back(splat.normal);
    radii.push_back(splat.radius);
    objects.push_back(static_cast<std::int32_t>(splat.object));
  }
  return nb::make_tuple(owning_array<double>(std::move(centers), {count, 3}),
                        owning_array<double>(std::move(normals), {count, 3}),
                        owning_array<double>(std::move(radii), {count}),
                        owning_array<std::int32_t>(std::move(objects), {count}));
}

/// A channel of an image, which the array keeps alive; None where the image has no such channel.
template <typename Value, typename Element>
nb::object channel(api::Image& image, std::vector<Element>& values, std::size_t depth) {
  if (values.empty()) return nb::none();
  auto* data = reinterpret_cast<Value*>(values.data());
  const nb::object owner = nb::find(image);
  if (depth == 1) return nb::cast(nb::ndarray<nb::numpy, Value>(data, {image.height, image.width}, owner));
  return nb::cast(nb::ndarray<nb::numpy, Value>(data, {image.height, image.width, depth}, owner));
}

/// The elements of an array, as many as pixels; none where there is no array.
template <typename Element, typename Array>
std::vector<Element> elements(const std::optional<Array>& array, const api::Image& image) {
  if (!array) return {};
  if (array->shape(0) != image.height || array->shape(1) != image.width)
    throw nb::value_error(
        "found a channel of another size than the pixels, expected as many rows and columns");
  const auto* first = reinterpret_cast<const Element*>(array->data());
  return {first, first + std::size_t{image.width} * image.height};
}

template <typename Value>
using Channel = nb::ndarray<const Value, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
template <std::int64_t DEPTH>
using Vectors = nb::ndarray<const float, nb::shape<-1, -1, DEPTH>, nb::c_contig, nb::device::cpu>;

/// The image of its channels, which are copied.
api::Image* image_of(const Vectors<4>& pixels, const std::optional<Channel<float>>& depth,
                     const std::optional<Vectors<3>>& normal,
                     const std::optional<Channel<std::int32_t>>& object,
                     const std::optional<Channel<float>>& error, const std::optional<Vectors<3>>& albedo,
                     double exposure, const std::string& tone) {
  auto image = std::make_unique<api::Image>();
  image->height = static_cast<std::uint32_t>(pixels.shape(0));
  image->width = static_cast<std::uint32_t>(pixels.shape(1));
  image->pixels = elements<std::array<float, 4>>(std::optional(pixels), *image);
  image->depth = elements<float>(depth, *image);
  image->normal = elements<api::Float3>(normal, *image);
  image->object = elements<std::int32_t>(object, *image);
  image->error = elements<float>(error, *image);
  image->albedo = elements<api::Float3>(albedo, *image);
  image->exposure = exposure;
  image->tone = tone;
  return image.release();
}

nb::bytes png(const api::Image& image) {
  const auto bytes = unlocked([&] { return image.png(); });
  return nb::bytes(bytes.data(), bytes.size());
}

void add_scene(nb::module_& module) {
  nb::class_<api::Scene>(module, "Scene")
      .def_prop_ro("splat_count", [](const api::Scene& scene) { return scene.splats(); })
      .def_prop_ro(
          "bounds",
          [](const api::Scene& scene) { return std::make_tuple(scene.bounds_low(), scene.bounds_high()); })
      .def_prop_ro("up", [](const api::Scene& scene) { return scene.up(); })
      .def_prop_ro("objects", [](const api::Scene& scene) { return scene.objects(); })
      .def_prop_ro("materials", [](const api::Scene& scene) { return scene.materials(); })
      .def_prop_ro("notes", [](const api::Scene& scene) { return scene.notes(); })
      .def_prop_ro("device", [](const api::Scene& scene) { return unlocked([&] { return scene.device(); }); })
      .def("splats", splats)
      .def("save",
           [](const api::Scene& scene, const std::filesystem::path& file) {
             const nb::object no_progress = nb::none();
             const api::Progress signals = progress_of(no_progress);
             unlocked([&] { scene.save(file, signals); });
           })
      .def("frame", frame, nb::arg("azimuth").none(), nb::arg("elevation").none(), nb::arg("fov").none(),
           nb::arg("aspect"))
      .def("render", render, nb::arg("request"), nb::arg("progress").none())
      .def("make", make, nb::arg("request"), nb::arg("progress").none())
      .def("trace", trace<double>, nb::arg("origins"), nb::arg("directions"), nb::arg("t_max"),
           nb::arg("progress").none())
      .def("trace", trace<float>, nb::arg("origins"), nb::arg("directions"), nb::arg("t_max"),
           nb::arg("progress").none())
      .def("occluded", occluded<double>, nb::arg("origins"), nb::arg("directions"), nb::arg("t_max"),
           nb::arg("progress").none())
      .def("occluded", occluded<float>, nb::arg("origins"), nb::arg("directions"), nb::arg("t_max"),
           nb::arg("progress").none())
      .def("measure", measure, nb::arg("kind"), nb::arg("places"), nb::arg("reach"), nb::arg("base"),
           nb::arg("request"), nb::arg("progress").none());
  module.def("open", open, nb::arg("files"), nb::arg("request"), nb::arg("progress").none());
  module.def("make_picture", make_picture, nb::arg("request"), nb::arg("progress").none());
}

void add_image(nb::module_& module) {
  module.def("image_of", image_of, nb::arg("pixels"), nb::arg("depth").none(), nb::arg("normal").none(),
             nb::arg("object").none(), nb::arg("error").none(), nb::arg("albedo").none(), nb::arg("exposure"),
             nb::arg("tone"));
  nb::class_<api::Image>(module, "Image")
      .def_ro("width", &api::Image::width)
      .def_ro("height", &api::Image::height)
      .def_prop_ro("pixels", [](api::Image& image) { return channel<float>(image, image.pixels, 4); })
      .def_prop_ro("depth", [](api::Image& image) { return channel<float>(image, image.depth, 1); })
      .def_prop_ro("normal", [](api::Image& image) { return channel<float>(image, image.normal, 3); })
      .def_prop_ro("object", [](api::Image& image) { return channel<std::int32_t>(image, image.object, 1); })
      .def_prop_ro("error", [](api::Image& image) { return channel<float>(image, image.error, 1); })
      .def_prop_ro("albedo", [](api::Image& image) { return channel<float>(image, image.albedo, 3); })
      .def_ro("lod_error", &api::Image::lod_error)
      .def_prop_ro("choices", [](const api::Image& image) { return choices_of(image.choices); })
      .def_rw("exposure", &api::Image::exposure)
      .def_rw("tone", &api::Image::tone)
      .def("png", png)
      .def("save", [](const api::Image& image, const std::filesystem::path& file) {
        unlocked([&] { image.save(file); });
      });
}

/// Python's exception for each kind of error; its two own ones are beside them.
PyObject* exception_for(api::ErrorKind kind, PyObject* no_device, PyObject* cancelled) {
  switch (kind) {
    case api::ErrorKind::usage:
    case api::ErrorKind::input:
      return PyExc_ValueError;
    case api::ErrorKind::no_device:
      return no_device;
    case api::ErrorKind::out_of_memory:
      return PyExc_MemoryError;
    case api::ErrorKind::cancelled:
      return cancelled;
    default:
      return PyExc_RuntimeError;
  }
}

void add_exceptions(nb::module_& module) {
  static PyObject* no_device = PyErr_NewException("splatray.NoDeviceError", PyExc_RuntimeError, nullptr);
  static PyObject* cancelled = PyErr_NewException("splatray.Cancelled", nullptr, nullptr);
  module.attr("NoDeviceError") = nb::handle(no_device);
  module.attr("Cancelled") = nb::handle(cancelled);
  nb::register_exception_translator([](const std::exception_ptr& thrown, void*) {
    try {
      std::rethrow_exception(thrown);
    } catch (const api::Error& error) {
      PyErr_SetString(exception_for(error.kind(), no_device, cancelled), error.what());
    }
  });
}

std::vector<std::tuple<std::string, std::string, std::string, std::string>> devices() {
  std::vector<std::tuple<std::string, std::string, std::string, std::string>> found;
  for (const api::Device& device : unlocked([] { return api::devices(); }))
    found.emplace_back(device.name, device.type, device.driver, device.refused);
  return found;
}

}  // namespace
}  // namespace splatray::python

NB_MODULE(_core, module) {
  namespace python = splatray::python;
  python::add_exceptions(module);
  python::add_values(module);
  python::add_arrays(module);
  python::add_scene(module);
  python::add_image(module);
  module.def("named_material", splatray::api::named_material);
  module.def("devices", python::devices);
  module.def("version", splatray::api::version);
}
