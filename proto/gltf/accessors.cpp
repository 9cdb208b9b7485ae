#include "proto/gltf/accessors.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <limits>
#include <type_traits>

namespace subdivd::proto::gltf {
namespace {

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

// Reads one accessor, whose components are of type T.
template <class T, class Out, class Convert>
class ElementReader {
 public:
  ElementReader(const Elements& from, Index accessor, const Convert& convert, Work& work)
      : model_(from.structure.model),
        buffers_(from.buffers),
        accessor_(from.structure.accessor(accessor)),
        width_(components_of(accessor_)),
        packed_(width_ * sizeof(T)),
        convert_(convert),
        work_(work) {}

  Result<void> append(std::span<const Index> chosen, std::vector<Out>& out) const {
    const std::size_t begin = out.size(), count = chosen.empty() ? accessor_.count : chosen.size();
    for (std::size_t first = 0; first < count; first += kPiece) {
      append_dense(chosen, first, std::min(count - first, kPiece), out);
      if (auto stop = work_.spend(kPiece * width_ / 4)) return *std::move(stop);
    }
    if (!accessor_.sparse.isSparse) return {};
    return lay_sparse(chosen, out.data() + begin);
  }

 private:
  static constexpr std::size_t kPiece = 8192;  // elements

  // Elements that are laid over the others: their numbers, ascending, and their values, both packed.
  struct Sparse {
    std::size_t count;
    const std::byte* indices;
    const std::byte* values;
  };

  const tinygltf::BufferView& view(int index) const {
    return model_.bufferViews[static_cast<std::size_t>(index)];
  }
  const std::byte* in_view(int index, std::size_t offset) const {
    return buffers_.bytes[static_cast<std::size_t>(view(index).buffer)].data() + view(index).byteOffset +
           offset;
  }

  void append_dense(std::span<const Index> chosen, std::size_t first, std::size_t count,
                    std::vector<Out>& out) const {
    if (accessor_.bufferView < 0) {
      out.resize(out.size() + count * width_);
      return;
    }
    const std::byte* const data = in_view(accessor_.bufferView, accessor_.byteOffset);
    const std::size_t view_stride = view(accessor_.bufferView).byteStride;
    const std::size_t stride = view_stride != 0 ? view_stride : packed_;
    std::size_t at = out.size();
    out.resize(at + count * width_);
    if (chosen.empty() && stride == packed_) {
      const std::byte* scalar = data + first * packed_;
      for (; at < out.size(); ++at, scalar += sizeof(T)) out[at] = convert_(load<T>(scalar));
      return;
    }
    for (std::size_t i = first; i < first + count; ++i) {
      const std::byte* const element = data + (chosen.empty() ? i : chosen[i]) * stride;
      for (std::size_t k = 0; k < width_; ++k) out[at++] = convert_(load<T>(element + k * sizeof(T)));
    }
  }

  // Lays what the sparse part says of the elements over them.
  Result<void> lay_sparse(std::span<const Index> chosen, Out* out) const {
    const auto& sparse = accessor_.sparse;
    const Sparse list{static_cast<std::size_t>(sparse.count),
                      in_view(sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset)),
                      in_view(sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset))};
    Result<void> done;
    with_component(sparse.indices.componentType, [&](auto component) {
      if constexpr (std::is_unsigned_v<decltype(component)>)
        done = chosen.empty() ? lay_all<decltype(component)>(list, out)
                              : lay_chosen<decltype(component)>(list, chosen, out);
    });
    return done;
  }

  template <class Number>
  static std::size_t sparse_element(const Sparse& sparse, std::size_t i) {
    return load<Number>(sparse.indices + i * sizeof(Number));
  }

  void lay(const Sparse& sparse, std::size_t i, Out* to) const {
    const std::byte* const from = sparse.values + i * packed_;
    for (std::size_t k = 0; k < width_; ++k) to[k] = convert_(load<T>(from + k * sizeof(T)));
  }

  template <class Number>
  Result<void> lay_all(const Sparse& sparse, Out* out) const {
    for (std::size_t i = 0; i < sparse.count; ++i) {
      if (auto stop = work_.spend(1)) return *std::move(stop);
      lay(sparse, i, out + sparse_element<Number>(sparse, i) * width_);
    }
    return {};
  }

  // Few elements may be chosen of a long list that many primitives share: they look for themselves in it.
  template <class Number>
  Result<void> lay_chosen(const Sparse& sparse, std::span<const Index> chosen, Out* out) const {
    std::size_t low = 0;
    for (std::size_t c = 0; c < chosen.size() && low < sparse.count; ++c) {
      if (auto stop = work_.spend(16)) return *std::move(stop);
      std::size_t high = sparse.count;
      while (low < high) {
        const std::size_t middle = low + (high - low) / 2;
        if (sparse_element<Number>(sparse, middle) < chosen[c])
          low = middle + 1;
        else
          high = middle;
      }
      if (low < sparse.count && sparse_element<Number>(sparse, low) == chosen[c])
        lay(sparse, low, out + c * width_);
    }
    return {};
  }

  const tinygltf::Model& model_;
  const Buffers& buffers_;
  const tinygltf::Accessor& accessor_;
  std::size_t width_, packed_;
  Convert convert_;
  Work& work_;
};

}  // namespace

Index components_of(const tinygltf::Accessor& accessor) {
  return static_cast<Index>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
}

Result<void> append_reals(const Elements& from, Index accessor, std::span<const Index> chosen,
                          std::vector<double>& out, Work& work) {
  const tinygltf::Accessor& info = from.structure.accessor(accessor);
  Result<void> done;
  with_component(info.componentType, [&](auto component) {
    using T = decltype(component);
    const auto append = [&](const auto& convert) {
      done = ElementReader<T, double, std::decay_t<decltype(convert)>>(from, accessor, convert, work)
                 .append(chosen, out);
    };
    if (info.normalized)
      append([](T value) { return normalize(value); });
    else
      append([](T value) { return static_cast<double>(value); });
  });
  return done;
}

Result<std::vector<Index>> read_indices(const Elements& from, Index accessor, Work& work) {
  std::vector<Index> out;
  const tinygltf::Accessor& info = from.structure.accessor(accessor);
  out.reserve(info.count);
  Result<void> done;
  with_component(info.componentType, [&](auto component) {
    using T = decltype(component);
    const auto widen = [](T value) { return static_cast<Index>(value); };
    if constexpr (std::is_unsigned_v<T>)
      done =
          ElementReader<T, Index, std::decay_t<decltype(widen)>>(from, accessor, widen, work).append({}, out);
  });
  if (!done) return done.error();
  return out;
}

}  // namespace subdivd::proto::gltf
