#include "proto/gltf/accessors.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

#include "proto/gltf/layout.h"

namespace subdivd::proto::gltf {
namespace {

struct Source {
  const std::byte* first = nullptr;
  std::size_t stride = 0;
};

template <class T>
T load(const std::byte* from) {
  T value;
  std::memcpy(&value, from,
              sizeof value);  // the data need not be aligned in memory; the host is little-endian
  return value;
}

// c / max, and never below -1.  [glTF 2.0, 3.6.2.2]
template <class T>
double normalize(T value) {
  return std::max(static_cast<double>(value) / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
}

// Calls use(T{}) with the C++ type of a component.
template <class F>
void with_component(int component, const F& use) {
  switch (component) {
    case kByte:
      return use(std::int8_t{});
    case kUnsignedByte:
      return use(std::uint8_t{});
    case kShort:
      return use(std::int16_t{});
    case kUnsignedShort:
      return use(std::uint16_t{});
    case kUnsignedInt:
      return use(std::uint32_t{});
    default:
      return use(float{});
  }
}

Source source_of(const tinygltf::Model& model, const Buffers& buffers, int view_index, std::size_t offset,
                 std::size_t packed) {
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(view_index)];
  return {buffers.bytes[static_cast<std::size_t>(view.buffer)].data() + view.byteOffset + offset,
          view.byteStride != 0 ? view.byteStride : packed};
}

// Reads into out[i * width ..] what stands at element i, then the sparse elements over it.
template <class T, class Out, class Convert>
void read_elements(const tinygltf::Model& model, const Buffers& buffers, const tinygltf::Accessor& accessor,
                   std::size_t width, std::vector<Out>& out, const Convert& convert) {
  const std::size_t packed = width * sizeof(T);
  const auto copy = [&](const std::byte* from, std::size_t element) {
    for (std::size_t k = 0; k < width; ++k) out[element * width + k] = convert(load<T>(from + k * sizeof(T)));
  };
  if (accessor.bufferView >= 0) {
    const Source dense = source_of(model, buffers, accessor.bufferView, accessor.byteOffset, packed);
    for (std::size_t i = 0; i < accessor.count; ++i) copy(dense.first + i * dense.stride, i);
  }
  if (!accessor.sparse.isSparse) return;
  const auto& sparse = accessor.sparse;
  with_component(sparse.indices.componentType, [&](auto component) {
    using IndexType = decltype(component);
    if constexpr (std::is_unsigned_v<IndexType>) {
      const Source places = source_of(model, buffers, sparse.indices.bufferView,
                                      static_cast<std::size_t>(sparse.indices.byteOffset), sizeof(IndexType));
      const Source values = source_of(model, buffers, sparse.values.bufferView,
                                      static_cast<std::size_t>(sparse.values.byteOffset), packed);
      for (std::size_t i = 0; i < static_cast<std::size_t>(sparse.count); ++i)
        copy(values.first + i * packed, load<IndexType>(places.first + i * sizeof(IndexType)));
    }
  });
}

}  // namespace

std::vector<double> read_reals(const tinygltf::Model& model, const Buffers& buffers, Index index) {
  const tinygltf::Accessor& accessor = model.accessors[index];
  const auto width =
      static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
  std::vector<double> out(accessor.count * width);
  with_component(accessor.componentType, [&](auto component) {
    using T = decltype(component);
    read_elements<T>(model, buffers, accessor, width, out, [&](T value) {
      return accessor.normalized ? normalize(value) : static_cast<double>(value);
    });
  });
  return out;
}

std::vector<Index> read_indices(const tinygltf::Model& model, const Buffers& buffers, Index index) {
  const tinygltf::Accessor& accessor = model.accessors[index];
  std::vector<Index> out(accessor.count);
  with_component(accessor.componentType, [&](auto component) {
    using T = decltype(component);
    if constexpr (std::is_unsigned_v<T>)
      read_elements<T>(model, buffers, accessor, 1, out, [](T value) { return Index{value}; });
  });
  return out;
}

}  // namespace subdivd::proto::gltf
