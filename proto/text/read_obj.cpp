#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/pace.h"
#include "proto/suggest.h"
#include "proto/text/obj_file.h"
#include "proto/text/obj_tags.h"
#include "proto/text/obj_words.h"
#include "proto/text/request.h"
#include "proto/text/text.h"
#include "proto/text/text_cursor.h"

namespace subdivd::proto::text {
namespace {

constexpr auto kContinuation = TextCursor::Continuation::backslash;

std::string number(Count n) { return std::to_string(n); }

// What the lines will take, from a first look at the body.
struct ObjCounts {
  Count points = 0, colored_points = 0, texcoords = 0, normals = 0;
  Count faces = 0, corners = 0, lines = 0, line_points = 0, objects = 1, tag_words = 0;
  std::array<Count, kLabelKinds> labels = {};
  Count libraries = 0, library_bytes = 0;

  Count bytes() const {
    constexpr Count kPoint = 3 * sizeof(double), kTexcoord = 2 * sizeof(double);
    Count sum = (colored_points > 0 ? 2 : 1) * points * kPoint + texcoords * kTexcoord;
    sum += (2 * corners + faces + line_points + 2 * lines) * sizeof(Index) + line_points * kPoint;
    // Integers, numbers and what is kept of them, in arrays that grow.
    sum += tag_words * 4 * sizeof(ObjCrease);
    // For every line itself, its place in an order, which name it has and where that is in a mesh, and for every
    // face the name's number. Names are taken when it is known in how many meshes they stand.
    for (const Count lines_of_kind : labels)
      if (lines_of_kind > 0)
        sum += (lines_of_kind + 1) * (sizeof(ObjLabel) + 5 * sizeof(Index)) + faces * sizeof(double);
    sum += libraries * sizeof(Count) + library_bytes;
    if (objects == 1 && lines == 0) return sum;
    // Of several meshes each has its own arrays, and no more points than corners; so has one beside curves.
    sum += (2 * corners + faces) * sizeof(Index) + corners * (2 * kPoint + kTexcoord + 2 * sizeof(Index));
    sum += 2 * (points + texcoords) * sizeof(Index);
    constexpr Count kObject = 2 * (sizeof(ObjObject) + sizeof(ControlMesh) + sizeof(ControlCurves)) + 1024;
    return sum + objects * kObject;
  }
};

// What is wrong with a line the reader will say: a line too long to be read is counted all the same.
ObjCounts count_lines(std::string_view body, const Pace& pace) {
  TextCursor cursor(body, pace, kContinuation);
  ObjCounts counts;
  while (cursor.next_line()) {
    const std::string_view word = cursor.word();
    if (word == "v") {
      ++counts.points;
      if (cursor.skip_words() == 6) ++counts.colored_points;
    } else if (word == "vt") {
      ++counts.texcoords;
    } else if (word == "vn") {
      ++counts.normals;
    } else if (word == "f" || word == "fo") {
      ++counts.faces;
      counts.corners += cursor.skip_words();
    } else if (word == "l") {
      ++counts.lines;
      counts.line_points += cursor.skip_words();
    } else if (word == "o") {
      ++counts.objects;
      cursor.rest();
    } else if (word == "g" || word == "usemtl") {
      ++counts.labels[word == "g" ? kGroup : kMaterial];
      cursor.rest();
    } else if (word == "mtllib") {
      ++counts.libraries;
      counts.library_bytes += cursor.rest().size();
    } else if (word == "t") {
      counts.tag_words += cursor.skip_words();
    }
  }
  return counts;
}

class ObjReader {
 public:
  ObjReader(std::string_view body, const Pace& pace)
      : pace_(pace), cursor_(body, pace, kContinuation), counts_(count_lines(body, pace)) {}

  Result<RefineRequest> read() {
    if (std::max({counts_.points, counts_.texcoords, counts_.corners, counts_.line_points}) >= kMaxIndexCount)
      return Error{ErrorCode::too_large, "the OBJ has more points or corners than 32-bit indices can number"};
    if (auto stopped = take(pace_.budget(), counts_.bytes())) return *std::move(stopped);
    reserve();
    while (cursor_.next_line())
      if (!read_line(cursor_.word())) break;
    if (cursor_.failed()) return cursor_.error();
    // Indices were compared with what was counted.
    assert(file_.points.size() == 3 * counts_.points && file_.texcoords.size() == 2 * counts_.texcoords);
    if (file_.face_counts.empty() && file_.line_counts.empty())
      return Error{ErrorCode::missing_field,
                   "the OBJ has neither faces (f) nor lines (l): there is nothing to do"};
    return make_meshes(std::move(file_), pace_);
  }

 private:
  void reserve() {
    file_.points.reserve(3 * counts_.points);
    if (counts_.colored_points > 0) file_.colors.reserve(3 * counts_.points);
    file_.texcoords.reserve(2 * counts_.texcoords);
    file_.face_counts.reserve(counts_.faces);
    file_.corner_points.reserve(counts_.corners);
    file_.corner_texcoords.reserve(counts_.corners);
    file_.line_counts.reserve(counts_.lines);
    file_.line_points.reserve(counts_.line_points);
    file_.objects.reserve(counts_.objects);
    file_.objects.emplace_back();
    for (std::size_t kind = 0; kind < kLabelKinds; ++kind) {
      if (counts_.labels[kind] == 0) continue;
      file_.labels[kind].reserve(counts_.labels[kind] + 1);
      file_.labels[kind].push_back({{}, 0});
    }
    file_.material_libraries.reserve(counts_.libraries, counts_.library_bytes);
  }

  // What is not read is not looked at either: the next line is.
  bool read_line(std::string_view word) {
    if (word == "v") return read_point();
    if (word == "vt") return read_texcoord();
    if (word == "vn") return ++normals_read_ > 0;
    if (word == "f" || word == "fo") return read_face();
    if (word == "l") return read_polyline();
    if (word == "o") return begin_object();
    if (word == "t") return read_obj_tag(cursor_, counts_.points, counts_.faces, file_);
    if (word == "g") return add_label(kGroup);
    if (word == "usemtl") return add_label(kMaterial);
    if (word == "mtllib") return add_library();
    if (is_among(word, kObjGroupWords)) return file_.has_groups = true;
    if (is_among(word, kOtherObjWords)) return file_.has_others = true;
    return cursor_.fail(ErrorCode::malformed, in_quotes(word) + " begins no line of an OBJ");
  }

  // x y z, and w, which polygons have no use for, or r g b.
  bool read_point() {
    std::array<double, 6> numbers{};
    std::size_t count = 0;
    for (; count < 3; ++count)
      if (!cursor_.next_number("a coordinate", numbers[count])) return false;
    for (std::string_view word = cursor_.word(); !word.empty(); word = cursor_.word()) {
      if (count == numbers.size()) return wrong_point();
      if (!cursor_.to_number(word, "a weight or a colour", numbers[count++])) return false;
    }
    if (cursor_.failed()) return false;
    if (count == 5) return wrong_point();
    file_.points.insert(file_.points.end(), numbers.begin(), numbers.begin() + 3);
    if (counts_.colored_points == 0) return true;
    if (count != 6) std::fill(numbers.begin() + 3, numbers.end(), kNoColor);
    file_.colors.insert(file_.colors.end(), numbers.begin() + 3, numbers.end());
    return true;
  }
  bool wrong_point() {
    return cursor_.fail(ErrorCode::wrong_length,
                        "a point has 3 numbers, 4 with its weight or 6 with its colour");
  }

  bool read_texcoord() {
    double u = 0, v = 0;
    if (!cursor_.next_number("a texture coordinate", u)) return false;
    const std::string_view word = cursor_.word();
    if (!word.empty() && !cursor_.to_number(word, "a texture coordinate", v)) return false;
    if (cursor_.failed()) return false;
    file_.texcoords.push_back(u);
    file_.texcoords.push_back(v);
    return true;
  }

  // Counted from 1 from the first, or from -1 back from the last so far.
  bool resolve(std::string_view word, std::string_view what, Count so_far, Count total, const char* of,
               Index& out) {
    std::int64_t index = 0;
    if (!cursor_.to_whole(word, what, index)) return false;
    if (index > 0 && static_cast<Count>(index) <= total) {
      out = static_cast<Index>(index - 1);
      return true;
    }
    const std::string text = std::string(what) + ' ' + std::to_string(index);
    if (index == 0) return cursor_.fail(ErrorCode::out_of_range, text + ": OBJ counts from 1");
    if (index < 0 && Count{0} - static_cast<Count>(index) > so_far)
      return cursor_.fail(ErrorCode::out_of_range,
                          text + " is before the first of the " + number(so_far) + ' ' + of + " so far");
    if (index > 0)
      return cursor_.fail(ErrorCode::out_of_range, text + " is past the " + number(total) + ' ' + of);
    out = static_cast<Index>(so_far + static_cast<Count>(index));
    return true;
  }

  // "7", "7/2", "7//3" or "7/2/3".
  bool read_vertex(std::string_view word, Index& point, Index& texcoord) {
    const std::size_t first = std::min(word.find('/'), word.size());
    if (!resolve(word.substr(0, first), "face index", file_.points.size() / 3, counts_.points, "points",
                 point))
      return false;
    texcoord = kNoIndex;
    if (first == word.size()) return true;
    const std::string_view rest = word.substr(first + 1);
    const std::size_t second = std::min(rest.find('/'), rest.size());
    const bool skips = second == 0 && rest.size() > 1;
    if (!skips && !resolve(rest.substr(0, second), "texture index", file_.texcoords.size() / 2,
                           counts_.texcoords, "texture coordinates", texcoord))
      return false;
    if (second == rest.size()) return true;
    Index normal = 0;
    return resolve(rest.substr(second + 1), "normal index", normals_read_, counts_.normals, "normals",
                   normal);
  }

  bool read_face() {
    Index count = 0;
    for (std::string_view word = cursor_.word(); !word.empty(); word = cursor_.word(), ++count) {
      Index point = 0, texcoord = 0;
      if (!read_vertex(word, point, texcoord)) return false;
      file_.corner_points.push_back(point);
      file_.corner_texcoords.push_back(texcoord);
    }
    if (cursor_.failed()) return false;
    if (count < 3)
      return cursor_.fail(ErrorCode::not_a_triangle,
                          "a face of " + number(count) + " vertices; a face has 3 or more");
    file_.face_counts.push_back(count);
    return true;
  }

  bool read_polyline() {
    Index count = 0;
    for (std::string_view word = cursor_.word(); !word.empty(); word = cursor_.word(), ++count) {
      Index point = 0, texcoord = 0;
      if (!read_vertex(word, point, texcoord)) return false;
      file_.line_points.push_back(point);
    }
    if (cursor_.failed()) return false;
    if (count < 2)
      return cursor_.fail(ErrorCode::too_few_points,
                          "a line of " + number(count) + " points; it has 2 or more");
    file_.line_counts.push_back(count);
    return true;
  }

  bool add_label(LabelKind kind) {
    file_.labels[kind].push_back({cursor_.rest(), file_.face_counts.size()});
    return !cursor_.failed();
  }

  bool add_library() {
    file_.material_libraries.add(joined_line(cursor_.rest()));
    return !cursor_.failed();
  }

  bool begin_object() {
    ObjObject object;
    object.name = cursor_.rest();
    object.first_face = file_.face_counts.size();
    object.first_corner = file_.corner_points.size();
    object.first_line = file_.line_counts.size();
    object.first_line_point = file_.line_points.size();
    file_.objects.push_back(object);
    return !cursor_.failed();
  }

  const Pace& pace_;
  TextCursor cursor_;
  const ObjCounts counts_;
  Count normals_read_ = 0;
  ObjFile file_;
};

}  // namespace

Result<RefineRequest> read_obj(std::string_view body, const Budget& budget) {
  return stoppable(budget, [&](const Pace& pace) { return ObjReader(body, pace).read(); });
}

}  // namespace subdivd::proto::text
