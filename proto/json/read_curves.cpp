#include "proto/json/read_mesh.h"
#include "proto/json/words.h"

namespace subdivd::proto::json {
namespace {

class CurvesReader {
 public:
  CurvesReader(Cursor& cursor, CurvesRead& out) : cursor_(cursor), out_(out) {}

  static constexpr std::size_t kMembers = 7;
  static constexpr std::array<Cursor::Member<CurvesReader>, kMembers> members() {
    return {{{"name", &CurvesReader::name},
             {"type", &CurvesReader::type},
             {"basis", &CurvesReader::basis},
             {"wrap", &CurvesReader::wrap},
             {"points", &CurvesReader::points},
             {"curveVertexCounts", &CurvesReader::curve_vertex_counts},
             {"tangents", &CurvesReader::tangents}}};
  }

  bool name(Value value) { return cursor_.read_string(value, out_.curves.name); }
  // USD knows more types and bases than we do: those are valid but unsupported, anything else is a slip.
  bool type(Value value) {
    static constexpr std::array<std::string_view, 2> kTypes = {"cubic", "linear"};
    return read_supported(value, kTypes);
  }
  bool basis(Value value) {
    static constexpr std::array<std::string_view, 3> kBases = {"bspline", "bezier", "catmullRom"};
    return read_supported(value, kBases);
  }

  bool wrap(Value value) {
    std::size_t word = 0;
    if (!cursor_.read_word(value, wrap_words(), word)) return false;
    out_.curves.wrap = static_cast<CurveWrap>(word);
    return true;
  }

  bool points(Value value) {
    has_points_ = true;
    Tuples tuples;
    if (!read_tuples(cursor_, value, 0, kMaxCurveWidth, "point", tuples)) return false;
    out_.form = tuples.form;
    out_.curves.width = tuples.width > 0 ? tuples.width : 3;
    if (tuples.values.size() % out_.curves.width != 0)
      return cursor_.fail(
          ErrorCode::wrong_length,
          std::string("the flat array holds ") + std::to_string(tuples.values.size()) +
              " numbers; it must hold a multiple of 3 (points of another width must be nested)");
    out_.curves.points = std::move(tuples.values);
    return true;
  }

  bool curve_vertex_counts(Value value) { return read_indices(cursor_, value, out_.curves.vertex_counts); }

  bool tangents(Value value) {
    Tuples unused;
    out_.had_tangents = true;
    return read_tuples(cursor_, value, 0, kMaxCurveWidth, "tangent", unused);
  }

  bool finish() {
    return has_points_ ? true : cursor_.fail(ErrorCode::missing_field, "a curve needs points", {"points"});
  }

 private:
  // The first word is the one we support.
  bool read_supported(Value value, std::span<const std::string_view> words) {
    std::size_t word = 0;
    if (!cursor_.read_word(value, words, word)) return false;
    if (word == 0) return true;
    return cursor_.fail(ErrorCode::unsupported, std::string("this is ") + in_quotes(words[word]) + "; only " +
                                                    in_quotes(words[0]) + " curves can be refined");
  }

  Cursor& cursor_;
  CurvesRead& out_;
  bool has_points_ = false;
};

}  // namespace

bool read_curves(Cursor& cursor, Value value, CurvesRead& out) {
  simdjson::ondemand::object object;
  if (value.get_object().get(object)) return cursor.fail_type(value, "a curve, an object");
  CurvesReader reader(cursor, out);
  std::bitset<CurvesReader::kMembers> seen;
  return cursor.read_members(object, CurvesReader::members(), reader, seen) && reader.finish();
}

}  // namespace subdivd::proto::json
