#include "preprocess/read/gltf/gltf_accessor.h"

#include <algorithm>
#include <cstring>

namespace splatray {
namespace {

/// Elements as they are stored.
struct Elements {
  const unsigned char* bytes = nullptr;  ///< nullptr: all zero (a sparse accessor without a base)
  std::size_t count = 0;
  std::size_t stride = 0;
  std::size_t components = 0;
  int component_type = 0;
  bool normalized = false;

  [[nodiscard]] std::size_t component_bytes() const {
    return static_cast<std::size_t>(
        tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component_type)));
  }
  [[nodiscard]] std::size_t element_bytes() const { return components * component_bytes(); }
};

template <class T>
double load_number(const unsigned char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<double>(value);
}

/// One component; normalised integers by the rules of glTF 2.0, section 3.11.
double component(const Elements& elements, const unsigned char* bytes) {
  const auto scaled = [&](double value, double most) {
    return elements.normalized ? std::max(value / most, -1.0) : value;
  };
  switch (elements.component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return scaled(load_number<std::int8_t>(bytes), 127.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return scaled(load_number<std::uint8_t>(bytes), 255.0);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return scaled(load_number<std::int16_t>(bytes), 32767.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return scaled(load_number<std::uint16_t>(bytes), 65535.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return load_number<std::uint32_t>(bytes);
    default:
      return load_number<float>(bytes);
  }
}

/// Checks that `elements` fit into a view from `offset` on and points them there.
void place(const GltfFile& file, Elements& elements, int view_index, std::size_t offset,
           const std::string& what) {
  const std::span<const unsigned char> view = buffer_view_bytes(file, view_index);
  const std::size_t element = elements.element_bytes();
  elements.stride = std::max(elements.stride, element);
  const bool fits =
      elements.count == 0 || (offset <= view.size() && element <= view.size() - offset &&
                              elements.count - 1 <= (view.size() - offset - element) / elements.stride);
  if (!fits) {
    file.fail(what + ": found a buffer view of " + std::to_string(view.size()) + " bytes, too short for " +
              std::to_string(elements.count) + " elements of " + std::to_string(element) +
              " bytes from byte " + std::to_string(offset));
  }
  elements.bytes = view.data() + offset;
}

Elements open_accessor(const GltfFile& file, int index, const std::string& what) {
  constexpr std::size_t MOST_WITHOUT_DATA = std::size_t{1} << 20U;
  const tinygltf::Accessor& accessor =
      file.model.accessors[file.checked(index, file.model.accessors.size(), "accessor")];
  Elements elements;
  elements.count = accessor.count;
  elements.component_type = accessor.componentType;
  elements.normalized = accessor.normalized;
  const int components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
  const int bytes = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType));
  if (components <= 0 || bytes <= 0 || accessor.componentType == TINYGLTF_COMPONENT_TYPE_DOUBLE ||
      accessor.componentType == TINYGLTF_COMPONENT_TYPE_INT) {
    file.fail(what + ": found an accessor of unknown type");
  }
  elements.components = static_cast<std::size_t>(components);
  if (accessor.bufferView >= 0) {
    const std::size_t view = file.checked(accessor.bufferView, file.model.bufferViews.size(), "buffer view");
    elements.stride = file.model.bufferViews[view].byteStride;
    place(file, elements, accessor.bufferView, accessor.byteOffset, what);
  } else if (!accessor.sparse.isSparse || elements.count > MOST_WITHOUT_DATA) {
    file.fail(what + ": found an accessor without data");
  }
  return elements;
}

/// Puts a sparse accessor's entries over the rows read.
void apply_sparse(const GltfFile& file, const tinygltf::Accessor& accessor, const Elements& base,
                  std::size_t components, const std::string& what, std::vector<float>& rows) {
  Elements indices;
  indices.count = static_cast<std::size_t>(std::max(accessor.sparse.count, 0));
  indices.components = 1;
  indices.component_type = accessor.sparse.indices.componentType;
  Elements values = base;
  values.count = indices.count;
  values.stride = 0;
  if (indices.component_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
      indices.component_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
      indices.component_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
    file.fail(what + ": found sparse indices of unknown type");
  }
  place(file, indices, accessor.sparse.indices.bufferView,
        static_cast<std::size_t>(std::max(accessor.sparse.indices.byteOffset, 0)), what);
  place(file, values, accessor.sparse.values.bufferView,
        static_cast<std::size_t>(std::max(accessor.sparse.values.byteOffset, 0)), what);
  for (std::size_t i = 0; i < indices.count; ++i) {
    const double target = component(indices, indices.bytes + i * indices.stride);
    if (target >= static_cast<double>(base.count)) {
      file.fail(what + ": found a sparse index beyond the accessor's end");
    }
    for (std::size_t c = 0; c < components; ++c) {
      const unsigned char* bytes = values.bytes + i * values.stride + c * values.component_bytes();
      rows[static_cast<std::size_t>(target) * components + c] = static_cast<float>(component(values, bytes));
    }
  }
}

}  // namespace

std::span<const unsigned char> buffer_view_bytes(const GltfFile& file, int view) {
  const tinygltf::BufferView& found =
      file.model.bufferViews[file.checked(view, file.model.bufferViews.size(), "buffer view")];
  const std::vector<unsigned char>& data =
      file.model.buffers[file.checked(found.buffer, file.model.buffers.size(), "buffer")].data;
  if (found.byteOffset > data.size() || found.byteLength > data.size() - found.byteOffset) {
    file.fail("buffer view " + std::to_string(view) + " ends at byte " +
              std::to_string(found.byteOffset + found.byteLength) + " of a buffer of " +
              std::to_string(data.size()));
  }
  return {data.data() + found.byteOffset, found.byteLength};
}

std::vector<float> read_floats(const GltfFile& file, int accessor, std::size_t components,
                               const std::string& what) {
  const Elements elements = open_accessor(file, accessor, what);
  if (elements.components < components) {
    file.fail(what + ": found " + std::to_string(elements.components) + " components, expected " +
              std::to_string(components));
  }
  std::vector<float> rows(elements.count * components, 0.0F);
  const std::size_t step = elements.component_bytes();
  for (std::size_t i = 0; i < elements.count && elements.bytes != nullptr; ++i) {
    for (std::size_t c = 0; c < components; ++c) {
      const unsigned char* bytes = elements.bytes + i * elements.stride + c * step;
      rows[i * components + c] = static_cast<float>(component(elements, bytes));
    }
  }
  const tinygltf::Accessor& source = file.model.accessors[static_cast<std::size_t>(accessor)];
  if (source.sparse.isSparse) {
    apply_sparse(file, source, elements, components, what, rows);
  }
  return rows;
}

std::vector<glm::uint> read_indices(const GltfFile& file, int accessor, std::size_t vertex_count) {
  const std::string what = "indices";
  Elements elements = open_accessor(file, accessor, what);
  if (elements.bytes == nullptr || elements.component_type == TINYGLTF_COMPONENT_TYPE_FLOAT) {
    file.fail("indices: found an accessor that is sparse or holds floats, expected plain whole numbers");
  }
  elements.normalized = false;
  std::vector<glm::uint> indices(elements.count);
  for (std::size_t i = 0; i < elements.count; ++i) {
    const double index = component(elements, elements.bytes + i * elements.stride);
    if (!(index >= 0.0 && index < static_cast<double>(vertex_count))) {
      file.fail("indices: found vertex " + std::to_string(static_cast<long long>(index)) +
                ", expected less than " + std::to_string(vertex_count));
    }
    indices[i] = static_cast<glm::uint>(index);
  }
  return indices;
}

}  // namespace splatray
