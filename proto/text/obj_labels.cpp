#include "proto/text/obj_labels.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "proto/text/request.h"
#include "proto/text/text_cursor.h"

namespace subdivd::proto::text {
namespace {

constexpr Count kNoEnd = static_cast<Count>(-1);

}  // namespace

Result<ObjLabels> ObjLabels::make(const ObjFile& file, const Pace& pace) {
  ObjLabels made;
  for (std::size_t kind = 0; kind < kLabelKinds; ++kind) {
    made.kinds_[kind].labels = file.labels[kind];
    if (auto sorted = made.sort(made.kinds_[kind], pace); !sorted) return std::move(sorted).error();
  }
  return made;
}

Result<void> ObjLabels::sort(Kind& kind, const Pace& pace) {
  std::vector<Index> order;
  order.reserve(kind.labels.size());
  pace.for_each(kind.labels.size(), [&](Count k) { order.push_back(static_cast<Index>(k)); });
  const auto name = [&](Index label) { return kind.labels[label].name; };
  pace.sort(order.begin(), order.end(), [&](Index a, Index b) { return name(a) < name(b); });
  pace.fill(kind.ids, kind.labels.size(), kNoIndex);
  Index ids = 0;
  pace.for_each(order.size(), [&](Count k) {
    if (name(order[k]).empty()) return;
    const bool again = k > 0 && name(order[k]) == name(order[k - 1]);
    kind.ids[order[k]] = again ? ids - 1 : ids++;
  });
  if (ids >= kMostNames)
    return Error{.code = ErrorCode::too_large,
                 .message = "the OBJ has " + std::to_string(ids) + " groups or materials; " +
                            std::to_string(kMostNames - 1) + " are allowed",
                 .predicted = ids,
                 .allowed = kMostNames - 1};
  pace.fill(kind.owners, Count{ids} + 1, kNoIndex);
  pace.fill(kind.numbers, Count{ids} + 1, 0);
  return {};
}

// Calls f(number, label, is_first, begin, end) for the runs of faces with one name; returns how many names there
// are, 0 where no face has any.
template <class F>
Count ObjLabels::walk(Kind& kind, Range faces, const Pace& pace, F&& f) {
  const auto next = [&] {
    return kind.at + 1 < kind.labels.size() ? kind.labels[kind.at + 1].first_face : kNoEnd;
  };
  Index count = 0;
  bool named = false;
  for (Count face = faces.begin; face < faces.end;) {
    for (; next() <= face; ++kind.at) pace.spend(1);
    const Count end = std::min(next(), faces.end);
    const Index id = std::min<Index>(kind.ids[kind.at], static_cast<Index>(kind.owners.size() - 1));
    const bool first = std::exchange(kind.owners[id], kind.mesh) != kind.mesh;
    if (first) kind.numbers[id] = count++;
    named |= kind.ids[kind.at] != kNoIndex;
    pace.spend(4);
    f(kind.numbers[id], kind.labels[kind.at].name, first, face, end);
    face = end;
  }
  ++kind.mesh;
  return named ? count : 0;
}

Count ObjLabels::name_bytes(std::span<const Range> meshes, const Pace& pace) {
  Count bytes = 0;
  for (Kind& kind : kinds_) {
    if (kind.labels.empty()) continue;
    for (const Range& mesh : meshes) {
      Count text = 0;
      const Count names = walk(kind, mesh, pace, [&](Index, std::string_view name, bool first, Count, Count) {
        text += first ? name.size() : 0;
      });
      bytes += NameList::bytes_of(names, text);
    }
    kind.at = 0;
  }
  return bytes;
}

void ObjLabels::add(Range faces, ControlMesh& mesh, std::vector<NameList>& names, const Pace& pace) {
  names.resize(mesh.primvars.size());
  for (std::size_t which = 0; which < kLabelKinds; ++which) {
    Kind& kind = kinds_[which];
    if (kind.labels.empty()) continue;
    NameList list;
    std::vector<double> numbers;
    numbers.reserve(faces.end - faces.begin);
    const Count count =
        walk(kind, faces, pace, [&](Index number, std::string_view name, bool first, Count begin, Count end) {
          if (first) list.add(joined_line(name));
          pace.in_blocks(end - begin, [&](Count from, Count to) {
            numbers.insert(numbers.end(), to - from, static_cast<double>(number));
          });
        });
    if (count == 0) continue;
    add_primvar(mesh, kLabelPrimvars[which], Interpolation::uniform, 1, std::move(numbers));
    names.push_back(std::move(list));
  }
}

}  // namespace subdivd::proto::text
