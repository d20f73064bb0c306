/// One field of an E57 record, as the prototype in the XML describes it (ASTM E2807-11, section 8.3).
#pragma once
#include <filesystem>
#include <string>

#include "preprocess/read/e57/description.h"
#include "preprocess/read/e57/xml_stream.h"

namespace splatray {

/// The field of this name and attributes. An integer without minimum and maximum, or with a scale that is no number but 0,
/// gets a `defect`: by the standard its values have 64 bits, but files that say nothing mean something else. Throws Error
/// (input_unreadable) for a type that no record has.
[[nodiscard]] E57Field prototype_field(const std::string& name, const XmlAttributes& attributes,
                                       const std::filesystem::path& path);

}  // namespace splatray
