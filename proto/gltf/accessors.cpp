#include "proto/gltf/accessors.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <iterator>
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

// Walks over packed components and converts them: a vector made of it is written once, not zeroed first.
template <class T, class Out, class Convert>
class Converting {
 public:
  using iterator_category = std::random_access_iterator_tag;  // a vector then knows its size at once
  using value_type = Out;
  using difference_type = std::ptrdiff_t;
  using pointer = const Out*;
  using reference = Out;

  Converting(const std::byte* at, const Convert& convert) : at_(at), convert_(&convert) {}
  Out operator*() const { return (*convert_)(load<T>(at_)); }
  Converting& operator++() {
    at_ += sizeof(T);
    return *this;
  }
  Converting operator++(int) {
    Converting before = *this;
    ++*this;
    return before;
  }
  friend difference_type operator-(const Converting& a, const Converting& b) {
    return (a.at_ - b.at_) / difference_type{sizeof(T)};
  }
  bool operator==(const Converting& other) const { return at_ == other.at_; }

 private:
  const std::byte* at_;
  const Convert* convert_;
};

// Writes over out[i * width ..] what the sparse part says of elements i.
template <class T, class Out, class Convert>
void read_sparse(const tinygltf::Model& model, const Buffers& buffers, const tinygltf::Accessor& accessor,
                 std::size_t width, std::vector<Out>& out, const Convert& convert) {
  const auto& sparse = accessor.sparse;
  const std::size_t packed = width * sizeof(T);
  with_component(sparse.indices.componentType, [&](auto component) {
    using IndexType = decltype(component);
    if constexpr (std::is_unsigned_v<IndexType>) {
      const Source places = source_of(model, buffers, sparse.indices.bufferView,
                                      static_cast<std::size_t>(sparse.indices.byteOffset), sizeof(IndexType));
      const Source values = source_of(model, buffers, sparse.values.bufferView,
                                      static_cast<std::size_t>(sparse.values.byteOffset), packed);
      for (std::size_t i = 0; i < static_cast<std::size_t>(sparse.count); ++i) {
        const std::size_t element = load<IndexType>(places.first + i * sizeof(IndexType));
        for (std::size_t k = 0; k < width; ++k)
          out[element * width + k] = convert(load<T>(values.first + i * packed + k * sizeof(T)));
      }
    }
  });
}

// Every element's `width` components, the sparse elements over the dense ones.
template <class T, class Out, class Convert>
std::vector<Out> read_elements(const tinygltf::Model& model, const Buffers& buffers,
                               const tinygltf::Accessor& accessor, std::size_t width,
                               const Convert& convert) {
  const std::size_t packed = width * sizeof(T);
  std::vector<Out> out;
  if (accessor.bufferView >= 0) {
    const Source dense = source_of(model, buffers, accessor.bufferView, accessor.byteOffset, packed);
    if (dense.stride == packed) {
      out = std::vector<Out>(Converting<T, Out, Convert>(dense.first, convert),
                             Converting<T, Out, Convert>(dense.first + accessor.count * packed, convert));
    } else {
      out.resize(accessor.count * width);
      for (std::size_t i = 0; i < accessor.count; ++i)
        for (std::size_t k = 0; k < width; ++k)
          out[i * width + k] = convert(load<T>(dense.first + i * dense.stride + k * sizeof(T)));
    }
  } else {
    out.resize(accessor.count * width);
  }
  if (accessor.sparse.isSparse) read_sparse<T>(model, buffers, accessor, width, out, convert);
  return out;
}

}  // namespace

std::vector<double> read_reals(const tinygltf::Model& model, const Buffers& buffers, Index index) {
  const tinygltf::Accessor& accessor = model.accessors[index];
  const auto width =
      static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
  std::vector<double> out;
  with_component(accessor.componentType, [&](auto component) {
    using T = decltype(component);
    out = accessor.normalized ? read_elements<T, double>(model, buffers, accessor, width,
                                                         [](T value) { return normalize(value); })
                              : read_elements<T, double>(model, buffers, accessor, width,
                                                         [](T value) { return static_cast<double>(value); });
  });
  return out;
}

std::vector<Index> read_indices(const tinygltf::Model& model, const Buffers& buffers, Index index) {
  const tinygltf::Accessor& accessor = model.accessors[index];
  std::vector<Index> out;
  with_component(accessor.componentType, [&](auto component) {
    using T = decltype(component);
    if constexpr (std::is_unsigned_v<T>)
      out = read_elements<T, Index>(model, buffers, accessor, 1, [](T value) { return Index{value}; });
  });
  return out;
}

}  // namespace subdivd::proto::gltf
