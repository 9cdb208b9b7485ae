#include "proto/gltf/layout.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "proto/gltf/fields.h"
#include "proto/gltf/polled_sort.h"

namespace subdivd::proto::gltf {
namespace {

constexpr Count kMaxOffset = (Count{1} << 31) - 1;  // of a buffer, see buffers.cpp

struct ElementType {
  std::string_view name;
  Count rows, columns;
};
constexpr auto kTypes = std::to_array<ElementType>({{"SCALAR", 1, 1},
                                                    {"VEC2", 2, 1},
                                                    {"VEC3", 3, 1},
                                                    {"VEC4", 4, 1},
                                                    {"MAT2", 2, 2},
                                                    {"MAT3", 3, 3},
                                                    {"MAT4", 4, 4}});

// Where `count` elements begin in a view and how they follow each other.
struct Run {
  Count offset = 0, stride = 0, element = 0, count = 0, alignment = 1;
};

Result<void> check_run(const Run& run, const ViewInfo& view, const Place& place) {
  if (run.offset % run.alignment != 0 || (view.offset + run.offset) % run.alignment != 0)
    return error_at(place.at("byteOffset"), ErrorCode::out_of_range,
                    "the data begins at byte " + std::to_string(view.offset + run.offset) +
                        "; components of " + std::to_string(run.alignment) + " bytes must be aligned");
  if (run.stride < run.element)
    return error_at(place, ErrorCode::out_of_range,
                    "elements of " + std::to_string(run.element) + " bytes overlap: byteStride is " +
                        std::to_string(run.stride));
  // Divided, not multiplied: a count near 2^53 times the stride would wrap around.
  const bool fits = run.offset <= view.length && run.element <= view.length - run.offset &&
                    run.count - 1 <= (view.length - run.offset - run.element) / run.stride;
  if (!fits)
    return error_at(place, ErrorCode::out_of_range,
                    std::to_string(run.count) + " elements from byte " + std::to_string(run.offset) +
                        " on do not fit the " + std::to_string(view.length) + " bytes of the bufferView");
  return {};
}

Result<ViewInfo> check_view(const Json& json, const Place& place, const Buffers& buffers) {
  if (auto is = expect_object(json, place); !is) return is.error();
  if (const Json* extensions = json.find("extensions");
      extensions != nullptr && extensions->find("EXT_meshopt_compression") != nullptr)
    return error_at(place, ErrorCode::unsupported,
                    "EXT_meshopt_compression is not decoded by this version: store the data uncompressed");
  const auto buffer = required_reference(json, "buffer", place, "buffers", buffers.bytes.size());
  if (!buffer) return buffer.error();
  const auto offset = optional_integer(json, "byteOffset", place, {0, kMaxOffset});
  if (!offset) return offset.error();
  const auto length = required_integer(json, "byteLength", place, {1, kMaxOffset});
  if (!length) return length.error();
  const auto stride = optional_integer(json, "byteStride", place, {4, 252});
  if (!stride) return stride.error();
  if (stride->value_or(4) % 4 != 0)
    return error_at(place.at("byteStride"), ErrorCode::out_of_range,
                    "\"byteStride\" is " + std::to_string(**stride) + "; a multiple of 4 is needed");
  const Count size = buffers.bytes[*buffer].size();
  if (offset->value_or(0) + *length > size)
    return error_at(place, ErrorCode::out_of_range,
                    "the bufferView ends at byte " + std::to_string(offset->value_or(0) + *length) +
                        " of a buffer of " + std::to_string(size));
  return ViewInfo{*buffer, offset->value_or(0), *length, stride->value_or(0)};
}

// The elements of a list of sparse indices, counted in its buffer from the first on: lists are aligned.
struct SparseList {
  Index buffer = 0;
  Count size = 0;            // of an element: 1, 2 or 4
  Count begin = 0, end = 0;  // first and last but one element
  Count limit = 0;           // the accessor's count
  Index accessor = 0;        // whose list it is
};

Count sparse_index(const Buffers& buffers, const SparseList& list, Count i) {
  const std::byte* from = buffers.bytes[list.buffer].data() + i * list.size;
  Count index = 0;
  for (Count byte = 0; byte < list.size; ++byte) index |= std::to_integer<Count>(from[byte]) << (8 * byte);
  return index;
}

Error bad_sparse_index(const Buffers& buffers, const SparseList& list, Count i) {
  const Place root, all = root.at("accessors"), accessor = all.at(list.accessor),
                    sparse = accessor.at("sparse");
  return error_at(sparse.at("indices"), ErrorCode::out_of_range,
                  "sparse index number " + std::to_string(i - list.begin) + " is " +
                      std::to_string(sparse_index(buffers, list, i)) +
                      "; indices must ascend and be less than " + std::to_string(list.limit));
}

// Sparse indices must ascend strictly and stay below the accessor's count. Thousands of accessors may share a
// list, or have lists that overlap: in the order of their beginnings no element is looked at twice.
Result<void> check_sparse_lists(std::vector<SparseList> lists, const Buffers& buffers, Work& work) {
  const auto by_place = [](const SparseList& a, const SparseList& b) {
    return std::tie(a.buffer, a.size, a.begin, a.accessor) < std::tie(b.buffer, b.size, b.begin, b.accessor);
  };
  if (auto sorted = polled_sort(lists, by_place, work); !sorted) return sorted;
  const SparseList* last = nullptr;
  Count ascends_to = 0;  // from the last list's begin on
  for (const SparseList& list : lists) {
    if (last == nullptr || last->buffer != list.buffer || last->size != list.size) ascends_to = 0;
    ascends_to = std::max(ascends_to, list.begin + 1);
    while (ascends_to < list.end) {
      if (auto stop = work.spend(1)) return *std::move(stop);
      if (sparse_index(buffers, list, ascends_to) <= sparse_index(buffers, list, ascends_to - 1))
        return bad_sparse_index(buffers, list, ascends_to);
      ++ascends_to;
    }
    if (sparse_index(buffers, list, list.end - 1) >= list.limit) {
      // The first of those that are too large: they ascend.
      Count low = list.begin, high = list.end - 1;
      while (low < high) {
        const Count middle = (low + high) / 2;
        sparse_index(buffers, list, middle) >= list.limit ? high = middle : low = middle + 1;
      }
      return bad_sparse_index(buffers, list, low);
    }
    last = &list;
  }
  return {};
}

// What is known of the layout while it is checked.
struct Checker {
  const Buffers& buffers;
  Layout& layout;
  std::vector<SparseList> lists;

  Result<void> sparse(const Json& json, const Place& place, const AccessorInfo& accessor,
                      Count element_bytes);
  Result<AccessorInfo> accessor(const Json& json, const Place& place);
};

Result<void> Checker::sparse(const Json& json, const Place& place, const AccessorInfo& accessor,
                             Count element_bytes) {
  const auto count = required_integer(json, "count", place, {1, accessor.count});
  if (!count) return count.error();
  const auto indices = required_object(json, "indices", place);
  if (!indices) return indices.error();
  const auto values = required_object(json, "values", place);
  if (!values) return values.error();
  const Place at_indices = place.at("indices"), at_values = place.at("values");

  const auto part_view =
      required_reference(**indices, "bufferView", at_indices, "bufferViews", layout.views.size());
  if (!part_view) return part_view.error();
  const auto offset = optional_integer(**indices, "byteOffset", at_indices, {0, kMaxOffset});
  if (!offset) return offset.error();
  const auto component =
      required_integer(**indices, "componentType", at_indices, {kUnsignedByte, kUnsignedInt});
  if (!component) return component.error();
  if (*component != kUnsignedByte && *component != kUnsignedShort && *component != kUnsignedInt)
    return error_at(at_indices.at("componentType"), ErrorCode::bad_enum,
                    "sparse indices are 5121, 5123 or 5125 (unsigned integers)");
  const Count size = component_size(*component);
  const Run run{offset->value_or(0), size, size, *count, size};
  const ViewInfo& index_view = layout.views[*part_view];
  if (auto fits = check_run(run, index_view, at_indices); !fits) return fits.error();

  const auto value_view =
      required_reference(**values, "bufferView", at_values, "bufferViews", layout.views.size());
  if (!value_view) return value_view.error();
  const auto value_offset = optional_integer(**values, "byteOffset", at_values, {0, kMaxOffset});
  if (!value_offset) return value_offset.error();
  const ViewInfo& values_in = layout.views[*value_view];
  if (auto fits = check_run({value_offset->value_or(0), element_bytes, element_bytes, *count,
                             component_size(accessor.component)},
                            values_in, at_values);
      !fits)
    return fits.error();
  const Count begin = (index_view.offset + run.offset) / size;
  lists.push_back({index_view.buffer, size, begin, begin + *count, accessor.count,
                   static_cast<Index>(layout.accessors.size())});
  return {};
}

// Bytes from one element's first to its last: columns of matrices begin at multiples of 4.
Count element_size(const ElementType& type, Count component) {
  const Count column = type.rows * component;
  const Count aligned = type.columns == 1 ? column : (column + 3) / 4 * 4;
  return (type.columns - 1) * aligned + column;
}

Result<AccessorInfo> Checker::accessor(const Json& json, const Place& place) {
  if (auto is = expect_object(json, place); !is) return is.error();
  AccessorInfo info;
  const auto view = optional_reference(json, "bufferView", place, "bufferViews", layout.views.size());
  if (!view) return view.error();
  info.view = *view;
  const auto offset = optional_integer(json, "byteOffset", place, {0, kMaxOffset});
  if (!offset) return offset.error();
  const auto component = required_integer(json, "componentType", place, {kByte, kFloat});
  if (!component) return component.error();
  const Count size = component_size(info.component = *component);
  if (size == 0)
    return error_at(place.at("componentType"), ErrorCode::bad_enum,
                    "\"componentType\" is " + std::to_string(*component) +
                        "; valid are 5120, 5121, 5122, 5123, 5125 and 5126");
  const auto count = required_integer(json, "count", place, {1, kMaxIndexCount - 1});
  if (!count) return count.error();
  info.count = *count;
  const auto normalized = optional_boolean(json, "normalized", place);
  if (!normalized) return normalized.error();
  info.normalized = *normalized;
  if (info.normalized && (info.component == kFloat || info.component == kUnsignedInt))
    return error_at(place.at("normalized"), ErrorCode::wrong_type,
                    "only components of 8 and 16 bits can be normalized");
  const auto type_name = optional_string(json, "type", place);
  if (!type_name) return type_name.error();
  if (*type_name == nullptr) return error_at(place, ErrorCode::missing_field, "\"type\" is missing");
  const auto type =
      std::find_if(kTypes.begin(), kTypes.end(), [&](const ElementType& t) { return t.name == **type_name; });
  if (type == kTypes.end())
    return error_at(place.at("type"), ErrorCode::bad_enum,
                    "\"type\" is none of SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3, MAT4");
  info.type = type->name;
  info.components = type->rows * type->columns;

  const Count bytes = element_size(*type, size);
  if (info.view) {
    const ViewInfo& data = layout.views[*info.view];
    const Count packed = type->columns > 1 ? (bytes + 3) / 4 * 4 : bytes;
    const Run run{offset->value_or(0), data.stride != 0 ? data.stride : packed, bytes, info.count, size};
    if (auto fits = check_run(run, data, place); !fits) return fits.error();
  } else if (*offset) {
    return error_at(place.at("byteOffset"), ErrorCode::unknown_field,
                    "\"byteOffset\" has no meaning without \"bufferView\"");
  }
  const auto sparse = optional_object(json, "sparse", place);
  if (!sparse) return sparse.error();
  if (*sparse != nullptr) {
    if (auto good = this->sparse(**sparse, place.at("sparse"), info, bytes); !good) return good.error();
  }
  return info;
}

}  // namespace

Count component_size(Count component) {
  switch (component) {
    case kByte:
    case kUnsignedByte:
      return 1;
    case kShort:
    case kUnsignedShort:
      return 2;
    case kUnsignedInt:
    case kFloat:
      return 4;
    default:
      return 0;
  }
}

Result<Layout> check_layout(const Json& document, const Buffers& buffers, Work& work) {
  Layout layout;
  const Place root;
  const auto views = optional_array(document, "bufferViews", root);
  if (!views) return views.error();
  const auto accessors = optional_array(document, "accessors", root);
  if (!accessors) return accessors.error();
  Checker checker{buffers, layout, {}};
  if (*views != nullptr) {
    const Place place = root.at("bufferViews");
    const Json::Array& list = *(*views)->array();
    if (auto kept = work.keep(list.size() * sizeof(ViewInfo) + kBlockBytes); !kept) return kept.error();
    layout.views.reserve(list.size());
    for (const Json& json : list) {
      if (auto stop = work.spend(16)) return *std::move(stop);
      const auto info = check_view(json, place.at(layout.views.size()), buffers);
      if (!info) return info.error();
      layout.views.push_back(*info);
    }
  }
  if (*accessors == nullptr) return layout;
  const Place place = root.at("accessors");
  const Json::Array& list = *(*accessors)->array();
  const auto sparse = static_cast<Count>(std::count_if(
      list.begin(), list.end(), [](const Json& json) { return json.find("sparse") != nullptr; }));
  if (auto kept = work.keep(list.size() * sizeof(AccessorInfo) + kBlockBytes); !kept) return kept.error();
  const auto held = work.hold(sparse * sizeof(SparseList) + kBlockBytes);
  if (!held) return held.error();
  layout.accessors.reserve(list.size());
  checker.lists.reserve(sparse);
  for (const Json& json : list) {
    if (auto stop = work.spend(32)) return *std::move(stop);
    auto info = checker.accessor(json, place.at(layout.accessors.size()));
    if (!info) return info.error();
    layout.accessors.push_back(*info);
  }
  if (auto good = check_sparse_lists(std::move(checker.lists), buffers, work); !good) return good.error();
  return layout;
}

}  // namespace subdivd::proto::gltf
