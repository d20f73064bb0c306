#include <algorithm>

#include "app/library/api/guard.h"
#include "app/library/api/request_impl.h"
#include "app/library/api/scene_impl.h"
#include "app/library/picture/reproduce.h"
#include "app/library/request/fields.h"
#include "app/library/request/request_json.h"
#include "engine/base/nearest_name.h"
#include "engine/base/number_text.h"

namespace splatray::api {
namespace {

/// Whether render() takes it.
bool renders(const Field& field) {
  const bool of_files = field.group == FieldGroup::input || field.group == FieldGroup::output ||
                        field.group == FieldGroup::files;
  return field.is(OF_PICTURES) || !(of_files || field.is(OF_SCENES));
}

/// The field of a name, in which _ stands for -.
const Field& field_of(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  const Field* field = find_field(name, DOOR_LIBRARY);
  if (field == nullptr || field->name != name)
    refuse("'" + name + "'",
           "the name of a field (Request::fields)" + did_you_mean(name, names_of(DOOR_LIBRARY)));
  return *field;
}

/// Takes the field's values out of the request; those of all its family where it is named as that.
void take_out(const Field& field, splatray::Request& request) {
  const std::vector<FieldText> values = family_values(field, request);
  field.clear(request);
  if (field.name == field.family_name()) return;
  for (const FieldText& value : values)
    if (value.name != field.name) read_value(field_of(value.name), value.text, request);
}

const char* kind_name(FieldKind kind) {
  switch (kind) {
    case FieldKind::flag:
      return "flag";
    case FieldKind::number:
      return "number";
    case FieldKind::whole:
      return "whole";
    case FieldKind::text:
      break;
  }
  return "text";
}

std::unique_ptr<Request::Impl> holding(splatray::Request request) {
  return std::make_unique<Request::Impl>(Request::Impl{std::move(request)});
}

}  // namespace

Value::Value(double number) : text_(number_text(number)) {}
Value::Value(float number) : text_(number_text(number)) {}
Value::Value(const Double3& numbers) : text_(number_text(vector(numbers))) {}

Request::Request() : impl_(std::make_unique<Impl>()) {}
Request::~Request() = default;
Request::Request(const Request& other) : impl_(std::make_unique<Impl>(*other.impl_)) {}
Request::Request(Request&& other) noexcept : impl_(std::move(other.impl_)) {
  other.impl_ = std::make_unique<Impl>();
}
Request& Request::operator=(const Request& other) {
  *impl_ = *other.impl_;
  return *this;
}
Request& Request::operator=(Request&& other) noexcept {
  std::swap(impl_, other.impl_);
  return *this;
}

Request::Request(std::initializer_list<std::pair<const char*, Value>> values) : Request() {
  for (const auto& [name, value] : values) field_of(name).repeated ? add(name, value) : set(name, value);
}

Request& Request::set(const std::string& name, const Value& value) {
  guarded([&] {
    const Field& field = field_of(name);
    splatray::Request changed = impl_->request;
    if (field.repeated) take_out(field, changed);
    read_value(field, value.text(), changed);
    impl_->request = std::move(changed);
  });
  return *this;
}

Request& Request::add(const std::string& name, const Value& value) {
  guarded([&] {
    const Field& field = field_of(name);
    if (!field.repeated) refuse("several values of '" + field.name + "'", "one, by set()");
    splatray::Request changed = impl_->request;
    read_value(field, value.text(), changed);
    impl_->request = std::move(changed);
  });
  return *this;
}

Request& Request::set_camera(const Camera& camera) {
  splatray::set_camera(impl_->request.view, {vector(camera.eye),
                                             vector(camera.target),
                                             vector(camera.up),
                                             camera.fov_y_deg,
                                             camera.ortho_height,
                                             {camera.lens_shift[0], camera.lens_shift[1]},
                                             camera.pixel_aspect,
                                             camera.panorama});
  return *this;
}

Request& Request::add_material(const std::string& object, const Material& material) {
  guarded([&] { impl_->request.look.objects.push_back(object_change(object, material)); });
  return *this;
}

std::vector<std::string> Request::get(const std::string& name) const {
  return guarded([&] { return texts_of(field_of(name), impl_->request); });
}

std::string Request::json() const {
  return guarded([&] { return request_json(impl_->request); });
}

Request Request::from_json(const std::string& text) {
  return guarded([&] {
    Request made;
    made.impl_ = holding(read_request_text(text, "the text"));
    return made;
  });
}

Request Request::of_picture(const std::filesystem::path& picture) {
  return guarded([&] {
    Request made;
    made.impl_ = holding(read_picture_request(picture));
    return made;
  });
}

std::vector<FieldInfo> Request::fields() {
  std::vector<FieldInfo> infos;
  for (const Field& field : splatray::fields())
    if (field.in(DOOR_LIBRARY))
      infos.push_back({field.name, group_title(field.group), kind_name(field.kind), field.value, field.help,
                       field.repeated, field.least, field.most, field.is(OF_SCENES), renders(field)});
  return infos;
}

const splatray::Request& RequestAccess::inner(const Request& request) { return request.impl_->request; }

}  // namespace splatray::api
