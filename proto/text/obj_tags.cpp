#include "proto/text/obj_tags.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "proto/suggest.h"

namespace subdivd::proto::text {
namespace {

constexpr std::array<std::string_view, 7> kTags = {
    "crease",       "corner",         "hole", "interpolateboundary", "facevaryinginterpolateboundary",
    "creasemethod", "smoothtriangles"};
// Of RenderMan's hierarchical edits, and one that OpenSubdiv dropped: without a meaning here.
constexpr std::array<std::string_view, 4> kOtherTags = {"facevaryingpropagatecorners", "vertexedit",
                                                        "edgeedit", "faceedit"};

class TagReader {
 public:
  TagReader(TextCursor& cursor, Count point_count, Count face_count, ObjFile& file)
      : cursor_(cursor), points_(point_count), faces_(face_count), file_(file) {}

  bool read() {
    name_ = cursor_.word();
    if (std::ranges::find(kOtherTags, name_) != kOtherTags.end()) return file_.has_other_tags = true;
    if (std::ranges::find(kTags, name_) == kTags.end())
      return !cursor_.failed() &&
             cursor_.fail(ErrorCode::bad_enum, in_quotes(name_) + " is no tag" + hint(name_, kTags));
    return read_arguments() && apply();
  }

 private:
  // "2/1/0": so many whole numbers, numbers and words follow.
  bool read_arguments() {
    std::string_view counts = cursor_.word();
    std::array<std::int64_t, 3> count{};
    for (std::size_t k = 0; k < count.size(); ++k) {
      const std::size_t slash = std::min(counts.find('/'), counts.size());
      if (!cursor_.to_whole(counts.substr(0, slash), "one of a tag's three counts (as in 2/1/0)", count[k]))
        return false;
      counts.remove_prefix(std::min(counts.size(), slash + 1));
      if (count[k] < 0 || static_cast<Count>(count[k]) > cursor_.bytes_left())
        return cursor_.fail(ErrorCode::wrong_length, "the tag counts more arguments than the body holds");
    }
    for (std::int64_t k = 0; k < count[0]; ++k)
      if (!cursor_.to_whole(cursor_.word(), "a tag's whole number", wholes_.emplace_back())) return false;
    for (std::int64_t k = 0; k < count[1]; ++k)
      if (!cursor_.to_number(cursor_.word(), "a tag's number", numbers_.emplace_back())) return false;
    if (count[2] > 1) return wrong_arguments();
    if (count[2] == 1) word_ = cursor_.word();
    const std::string_view more = cursor_.word();
    if (more.empty()) return !cursor_.failed();
    return cursor_.fail(ErrorCode::wrong_length, in_quotes(more) + " follows the tag's arguments");
  }

  bool wrong_arguments() {
    return cursor_.fail(ErrorCode::wrong_length,
                        "the tag " + std::string(name_) +
                            " does not take these arguments; right would be crease 2/1/0, corner 1/1/0, hole "
                            "1/0/0, interpolateboundary 1/0/0, facevaryinginterpolateboundary 1/0/0, "
                            "creasemethod 0/0/1 or smoothtriangles 0/0/1");
  }

  bool apply() {
    if (name_ == "crease") return sharp_ok(2) && add_creases();
    if (name_ == "corner") return sharp_ok(1) && add_corners();
    if (name_ == "hole") return numbers_.empty() && word_.empty() ? add_holes() : wrong_arguments();
    if (name_ == "creasemethod" || name_ == "smoothtriangles") {
      if (!wholes_.empty() || !numbers_.empty()) return wrong_arguments();
      return name_ == "creasemethod" ? set_method() : set_triangle_rule();
    }
    if (wholes_.size() != 1 || !word_.empty()) return wrong_arguments();
    return name_ == "interpolateboundary" ? set_boundary() : set_face_varying();
  }

  // One sharpness for all, or one for each edge or point.
  bool sharp_ok(std::size_t width) {
    const std::size_t tagged = wholes_.size() / width;
    const bool fits = !wholes_.empty() && wholes_.size() % width == 0 && word_.empty() &&
                      (numbers_.size() == 1 || numbers_.size() == tagged);
    if (!fits) return wrong_arguments();
    for (const double sharpness : numbers_)
      if (!(sharpness >= 0))
        return cursor_.fail(ErrorCode::out_of_range, "sharpness must be 0 or more; 10 is infinite");
    return true;
  }
  float sharpness(std::size_t k) const {
    return static_cast<float>(std::min(numbers_[numbers_.size() == 1 ? 0 : k], 1e38));
  }

  bool in_range(std::int64_t index, Count count, const char* what) {
    if (index >= 0 && static_cast<Count>(index) < count) return true;
    return cursor_.fail(
        ErrorCode::out_of_range,
        std::string(what) + ' ' + std::to_string(index) +
            (index < 0 ? " is below 0" : " is past the " + std::to_string(count) + ' ' + what + 's') +
            "; tags count from 0");
  }

  std::size_t object() const { return file_.objects.size() - 1; }

  bool add_creases() {
    for (std::size_t k = 0; k < wholes_.size(); k += 2) {
      if (!in_range(wholes_[k], points_, "point") || !in_range(wholes_[k + 1], points_, "point"))
        return false;
      file_.creases.push_back({static_cast<Index>(wholes_[k]), static_cast<Index>(wholes_[k + 1]),
                               sharpness(k / 2), cursor_.line(), object()});
    }
    return true;
  }
  bool add_corners() {
    for (std::size_t k = 0; k < wholes_.size(); ++k) {
      if (!in_range(wholes_[k], points_, "point")) return false;
      file_.corners.push_back({static_cast<Index>(wholes_[k]), sharpness(k), cursor_.line(), object()});
    }
    return true;
  }
  bool add_holes() {
    for (const std::int64_t face : wholes_) {
      if (!in_range(face, faces_, "face")) return false;
      file_.holes.push_back({static_cast<Index>(face), cursor_.line(), object()});
    }
    return true;
  }

  bool set_method() {
    if (word_ != "normal" && word_ != "chaikin")
      return cursor_.fail(ErrorCode::bad_enum, in_quotes(word_) + " is no creasemethod: normal or chaikin");
    file_.crease_method = word_ == "chaikin" ? CreaseMethod::chaikin : CreaseMethod::uniform;
    return true;
  }

  bool set_triangle_rule() {
    if (word_ != "catmark" && word_ != "smooth")
      return cursor_.fail(ErrorCode::bad_enum,
                          in_quotes(word_) + " is no rule of smoothtriangles: catmark or smooth");
    file_.triangle_rule = word_ == "smooth" ? TriangleRule::smooth : TriangleRule::catmull_clark;
    return true;
  }

  // RenderMan's numbers, which are not those of OpenSubdiv's own enumeration.
  bool set_boundary() {
    using enum BoundaryInterpolation;
    constexpr std::array<BoundaryInterpolation, 3> kNumbers = {none, edge_and_corner, edge_only};
    if (wholes_[0] < 0 || wholes_[0] > 2)
      return cursor_.fail(ErrorCode::bad_enum,
                          "interpolateboundary is 0 (none), 1 (edgeAndCorner) or 2 (edgeOnly)");
    file_.boundary = kNumbers[static_cast<std::size_t>(wholes_[0])];
    return true;
  }
  bool set_face_varying() {
    using enum FaceVaryingInterpolation;
    constexpr std::array<FaceVaryingInterpolation, 6> kNumbers = {none,          corners_only, corners_plus1,
                                                                  corners_plus2, boundaries,   all};
    if (wholes_[0] < 0 || wholes_[0] > 5)
      return cursor_.fail(ErrorCode::bad_enum,
                          "facevaryinginterpolateboundary is 0 (none), 1 (cornersOnly), 2 (cornersPlus1), 3 "
                          "(cornersPlus2), 4 (boundaries) or 5 (all)");
    file_.face_varying = kNumbers[static_cast<std::size_t>(wholes_[0])];
    return true;
  }

  TextCursor& cursor_;
  const Count points_, faces_;
  ObjFile& file_;
  std::string_view name_, word_;
  std::vector<std::int64_t> wholes_;
  std::vector<double> numbers_;
};

}  // namespace

bool read_obj_tag(TextCursor& cursor, Count point_count, Count face_count, ObjFile& file) {
  return TagReader(cursor, point_count, face_count, file).read();
}

}  // namespace subdivd::proto::text
