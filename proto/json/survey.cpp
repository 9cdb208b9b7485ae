#include "proto/json/survey.h"

#include <algorithm>
#include <array>
#include <string>

#include "proto/json/cursor.h"
#include "proto/json/marks.h"

namespace subdivd::proto::json {
namespace {

constexpr std::size_t kBytesPerPoll = std::size_t{1} << 20;
template <std::size_t n>
bool is_one_of(std::string_view name, const std::array<std::string_view, n>& names) {
  return std::ranges::find(names, name) != names.end();
}

constexpr std::array<std::string_view, 4> kCurveTypes = {"cubic", "linear", "nurbs", "bsplineSurface"};
constexpr std::array<std::string_view, 10> kOfMeshes = {"faceVertexIndices",
                                                        "faceVertexCounts",
                                                        "subdivisionScheme",
                                                        "interpolateBoundary",
                                                        "creaseIndices",
                                                        "cornerIndices",
                                                        "holeIndices",
                                                        "primvars",
                                                        "meshes",
                                                        "faceVaryingLinearInterpolation"};
constexpr std::array<std::string_view, 6> kOfSurfaces = {"uVertexCount", "vVertexCount", "uDegree",
                                                         "vDegree",      "uWrap",        "vWrap"};
constexpr std::array<std::string_view, 3> kIgnored = {"statistics", "warnings", "verification"};

template <std::size_t n>
constexpr std::size_t longest(const std::array<std::string_view, n>& names) {
  std::size_t most = 0;
  for (const std::string_view name : names) most = std::max(most, name.size());
  return most;
}
// Every letter may be an escape of six, as the reader reads it.
constexpr std::size_t kLongestName =
    6 * std::max({longest(kCurveTypes), longest(kOfMeshes), longest(kOfSurfaces), longest(kIgnored)});

// What a string between its quotes says; empty when it is no string, or longer than any that matters.
std::string plain(std::string_view quoted) {
  if (quoted.find('\\') == std::string_view::npos) return std::string(quoted);
  if (quoted.size() > kLongestName) return {};
  const Budget unlimited;
  const std::string text = '"' + std::string(quoted) + '"';
  Cursor cursor(text, unlimited);
  std::string out;
  return cursor.read_string(out) ? out : std::string();
}

class Surveyor {
 public:
  Surveyor(std::string_view body, const Budget& budget) : body_(body), budget_(budget) {}

  Result<Survey> look() {
    while (at_ < body_.size()) {
      if (auto stop = budget_.poll()) return *stop;
      const std::size_t stop = at_ + std::min(kBytesPerPoll, body_.size() - at_);
      if (quoted_)
        look_at_string(stop);
      else
        look_at_rest(stop);
    }
    return result_;
  }

 private:
  // Strings are cut at polls; of names only the first cut is looked at.
  void look_at_string(std::size_t stop) {
    while (at_ < stop) {
      const char c = body_[at_++];
      if (c == '\\') {
        ++at_;
      } else if (c == '"') {
        quoted_ = false;
        const std::size_t length = at_ - 1 - string_;
        if (!ignored_) result_.string_bytes += length;
        if (depth_ == 1) last_ = body_.substr(string_, std::min(length, kLongestName + 1));
        if (depth_ == 1 && value_of_type_) {
          result_.has_curve_type = is_one_of(std::string_view(plain(last_)), kCurveTypes);
          value_of_type_ = false;
        }
        return;
      }
    }
  }

  void look_at_rest(std::size_t stop) {
    while (at_ < stop && !quoted_) {
      skip_blocks(stop);
      look_at_bytes(std::min(stop, at_ + Marks::kBytes));
    }
  }

  void look_at_bytes(std::size_t stop) {
    for (; at_ < stop; ++at_) {
      switch (body_[at_]) {
        case '"':
          quoted_ = true;
          string_ = ++at_;
          return;
        case ',':
          if (!ignored_) ++result_.commas;
          if (depth_ == 1) end_member();
          break;
        case '[':
          ++depth_;
          if (!ignored_) ++result_.brackets;
          break;
        case '{':
          ++depth_;
          if (!ignored_) ++result_.braces;
          break;
        case ']':
        case '}':
          if (depth_ > 0) --depth_;
          break;
        case ':':
          if (depth_ == 1) begin_member(plain(last_));
          break;
        default:
          break;
      }
    }
  }

  // While no string begins and nothing stands among the members at the top.
  void skip_blocks(std::size_t stop) {
    for (; at_ + Marks::kBytes <= stop; at_ += Marks::kBytes) {
      const Marks marks = marks_in(body_.data() + at_);
      if (marks.quote || depth_ <= 1 + marks.closing) return;
      depth_ = depth_ + marks.brackets + marks.braces - marks.closing;
      if (ignored_) continue;
      result_.commas += marks.commas;
      result_.brackets += marks.brackets;
      result_.braces += marks.braces;
    }
  }

  void begin_member(const std::string& name) {
    result_.has_asset |= name == "asset";
    result_.has_basis |= name == "basis";
    result_.has_type |= name == "type";
    result_.of_mesh |= is_one_of(std::string_view(name), kOfMeshes);
    result_.of_surface |= is_one_of(std::string_view(name), kOfSurfaces);
    value_of_type_ = name == "type";
    ignored_ = is_one_of(std::string_view(name), kIgnored);
  }
  void end_member() {
    ignored_ = false;
    value_of_type_ = false;
    last_ = {};
  }

  const std::string_view body_;
  const Budget& budget_;
  Survey result_;
  std::size_t at_ = 0, depth_ = 0, string_ = 0;
  bool quoted_ = false, ignored_ = false, value_of_type_ = false;
  std::string_view last_;  // string at the top
};

}  // namespace

Count Survey::reading_bytes() const {
  // A number takes a double, or an index; of lists their lengths, too. Arrays are allocated at once, as long
  // as there are commas in them. Objects are meshes, curves, surfaces and primvars in vectors that grow.
  constexpr Count kNumber = 8, kObject = 1024, kSomething = 65536;
  return kSomething + kNumber * (commas + 2 * brackets) + kObject * braces + 4 * string_bytes;
}

Result<Survey> survey(std::string_view body, const Budget& budget) { return Surveyor(body, budget).look(); }

}  // namespace subdivd::proto::json
