#include "preprocess/read/e57/prototype_field.h"

#include <bit>
#include <cmath>

#include "preprocess/read/e57/parse_number.h"

namespace splatray {
namespace {

/// An attribute that is absent means `absent`.
double number_or(const XmlAttributes& attributes, const std::string& name, double absent) {
  const std::string text = attributes.value(name);
  return text.empty() ? absent : parse_number<double>(text).value_or(NAN);
}

void set_integer(E57Field& field, const XmlAttributes& attributes, bool scaled) {
  field.kind = E57Field::Kind::integer;
  const auto minimum = parse_number<std::int64_t>(attributes.value("minimum"));
  const auto maximum = parse_number<std::int64_t>(attributes.value("maximum"));
  if (scaled) {
    field.scale = number_or(attributes, "scale", 1.0);
    field.offset = number_or(attributes, "offset", 0.0);
  }
  if (!minimum || !maximum || *maximum < *minimum) {
    field.defect = "has no minimum and maximum, without which its bits are not known";
  } else if (!std::isfinite(field.scale) || !std::isfinite(field.offset) || field.scale == 0.0) {
    field.defect = "has a scale or offset that makes no numbers";
  } else {
    field.minimum = *minimum;
    field.bits = static_cast<unsigned>(
        std::bit_width(static_cast<std::uint64_t>(*maximum) - static_cast<std::uint64_t>(*minimum)));
    field.largest = static_cast<double>(*maximum) * field.scale + field.offset;
  }
}

}  // namespace

E57Field prototype_field(const std::string& name, const XmlAttributes& attributes,
                         const std::filesystem::path& path) {
  E57Field field;
  field.name = name;
  const std::string type = attributes.value("type");
  if (type == "Float") {
    const bool single = attributes.value("precision") == "single";
    field.kind = single ? E57Field::Kind::float32 : E57Field::Kind::float64;
    field.bits = single ? 32 : 64;
    field.largest = parse_number<double>(attributes.value("maximum"));
  } else if (type == "Integer" || type == "ScaledInteger") {
    set_integer(field, attributes, type == "ScaledInteger");
  } else if (type == "String") {
    field.kind = E57Field::Kind::text;
    field.defect = "is a text";
  } else {
    throw_unreadable(path, "found the field '" + name + "' of type '" + type +
                               "', expected Integer, ScaledInteger, Float or String");
  }
  return field;
}

}  // namespace splatray
