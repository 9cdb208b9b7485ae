#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "core/curves/spline.h"
#include "proto/json/read_mesh.h"
#include "proto/json/words.h"

namespace subdivd::proto::json {
namespace {

constexpr std::array<std::string_view, 3> kTypes = {"cubic", "linear", "nurbs"};
enum class Type { cubic, linear, nurbs };

}  // namespace

const std::array<Cursor::Member<CurvesReader>, CurvesReader::kMembers>& CurvesReader::members() {
  using C = CurvesReader;
  static constexpr std::array<Cursor::Member<C>, kMembers> table = {{
      {"name", &C::name},
      {"type", &C::type},
      {"basis", &C::basis},
      {"degree", &C::degree},
      {"wrap", &C::wrap},
      {"tension", &C::tension},
      {"ratio", &C::ratio},
      {"spacing", &C::spacing},
      {"points", &C::points},
      {"curveVertexCounts", &C::curve_vertex_counts},
      {"order", &C::order},
      {"knots", &C::knots},
      {"ranges", &C::ranges},
      {"pointWeights", &C::point_weights},
      {"tangents", &C::tangents},
  }};
  return table;
}

bool CurvesReader::name(Value value) { return cursor_.read_string(value, out_.curves.name); }

bool CurvesReader::type(Value value) { return read_word(value, kTypes, type_); }

bool CurvesReader::basis(Value value) {
  // Of the enumeration, knots have a type of their own.
  std::size_t word = 0;
  if (!cursor_.read_word(value, basis_words(), word)) return false;
  out_.curves.basis = static_cast<CurveBasis>(word);
  return given(Member::basis);
}

bool CurvesReader::degree(Value value) {
  return read_whole_number(cursor_, value, out_.curves.degree) && given(Member::degree);
}

bool CurvesReader::wrap(Value value) {
  std::size_t word = 0;
  if (!cursor_.read_word(value, wrap_words(), word)) return false;
  out_.curves.wrap = static_cast<CurveWrap>(word);
  return given(Member::wrap);
}

bool CurvesReader::tension(Value value) {
  return read_number(value, out_.curves.tension) && given(Member::tension);
}

bool CurvesReader::ratio(Value value) {
  return read_number(value, out_.curves.ratio) && given(Member::ratio);
}

bool CurvesReader::spacing(Value value) {
  std::size_t word = 0;
  if (!cursor_.read_word(value, spacing_words(), word)) return false;
  out_.curves.spacing = static_cast<Spacing>(word);
  return given(Member::spacing);
}

bool CurvesReader::points(Value value) {
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

bool CurvesReader::curve_vertex_counts(Value value) {
  return read_indices(cursor_, value, out_.curves.vertex_counts);
}

// One for all curves, as a number, or one for each.
bool CurvesReader::order(Value value) {
  simdjson::ondemand::json_type type{};
  if (value.type().get(type)) return cursor_.fail_syntax();
  if (type == simdjson::ondemand::json_type::array) {
    if (!read_indices(cursor_, value, out_.curves.orders)) return false;
  } else {
    Index one = 0;
    if (!read_whole_number(cursor_, value, one)) return false;
    out_.curves.orders = {one};
  }
  return given(Member::order);
}

bool CurvesReader::knots(Value value) {
  return read_numbers(value, out_.curves.knots) && given(Member::knots);
}

bool CurvesReader::ranges(Value value) {
  Tuples tuples;
  if (!read_tuples(cursor_, value, 2, 2, "range", tuples)) return false;
  out_.curves.ranges = std::move(tuples.values);
  return given(Member::ranges);
}

bool CurvesReader::point_weights(Value value) {
  return read_numbers(value, out_.curves.weights) && given(Member::point_weights);
}

bool CurvesReader::tangents(Value value) {
  Tuples unused;
  out_.had_tangents = true;
  return read_tuples(cursor_, value, 0, kMaxCurveWidth, "tangent", unused);
}

// What belongs to one kind of curve may not stand at another: it would be ignored.
bool CurvesReader::finish() {
  if (!has_points_) return cursor_.fail(ErrorCode::missing_field, "a curve needs points", {"points"});
  ControlCurves& curves = out_.curves;
  const bool on_knots = type_ == static_cast<std::size_t>(Type::nurbs);
  if (on_knots) curves.basis = CurveBasis::nurbs;
  const bool is_bspline = curves.basis == CurveBasis::bspline;
  struct Rule {
    Member member;
    const char *name, *belongs_to;
    bool fits;
  };
  const std::array<Rule, 10> rules = {{
      {Member::basis, "basis", "type \"cubic\" or \"linear\"", !on_knots},
      {Member::wrap, "wrap", "type \"cubic\" or \"linear\"", !on_knots},
      {Member::degree, "degree", "basis \"bspline\"", is_bspline},
      {Member::tension, "tension", "basis \"fourPoint\"", curves.basis == CurveBasis::four_point},
      {Member::ratio, "ratio", "basis \"cornerCutting\"", curves.basis == CurveBasis::corner_cutting},
      {Member::spacing, "spacing", "basis \"catmullRom\"", curves.basis == CurveBasis::catmull_rom},
      {Member::order, "order", "type \"nurbs\"", on_knots},
      {Member::knots, "knots", "type \"nurbs\"", on_knots},
      {Member::ranges, "ranges", "type \"nurbs\"", on_knots},
      {Member::point_weights, "pointWeights", "type \"nurbs\"", on_knots},
  }};
  for (const Rule& rule : rules)
    if (is_given(rule.member) && !rule.fits)
      return cursor_.fail(
          ErrorCode::unknown_field,
          std::string(rule.name) + " belongs to " + rule.belongs_to + ", which this curve is not",
          {rule.name});
  if (on_knots && !(is_given(Member::order) && is_given(Member::knots)))
    return cursor_.fail(ErrorCode::missing_field, "a curve of type \"nurbs\" needs order and knots",
                        {is_given(Member::order) ? "knots" : "order"});
  return settle_type();
}

// "cubic" and "linear" say the degree of a B-spline, too.
bool CurvesReader::settle_type() {
  if (!type_ || *type_ == static_cast<std::size_t>(Type::nurbs)) return true;
  ControlCurves& curves = out_.curves;
  const bool linear = *type_ == static_cast<std::size_t>(Type::linear);
  if (linear && curves.basis != CurveBasis::bspline)
    return cursor_.fail(ErrorCode::wrong_type, "a curve of type \"linear\" has no basis but \"bspline\"",
                        {"basis"});
  if (curves.basis != CurveBasis::bspline) return true;
  const Index degree = linear ? 1 : 3;
  if (is_given(Member::degree) && curves.degree != degree)
    return cursor_.fail(ErrorCode::out_of_range,
                        "the type says degree " + std::to_string(degree) + "; leave out one of the two",
                        {"degree"});
  curves.degree = degree;
  return true;
}

bool CurvesReader::read_word(Value value, std::span<const std::string_view> words,
                             std::optional<std::size_t>& out) {
  std::size_t word = 0;
  if (!cursor_.read_word(value, words, word)) return false;
  out = word;
  return true;
}

bool CurvesReader::read_number(Value value, double& out) {
  return get_number(value, out) || cursor_.fail_number(value, "a number");
}

bool CurvesReader::read_numbers(Value value, std::vector<double>& out) {
  return read_reals(cursor_, value, out);
}

bool read_curves(Cursor& cursor, Value value, CurvesRead& out) {
  simdjson::ondemand::object object;
  if (value.get_object().get(object)) return cursor.fail_type(value, "a curve, an object");
  CurvesReader reader(cursor, out);
  std::bitset<CurvesReader::kMembers> seen;
  return cursor.read_members(object, CurvesReader::members(), reader, seen) && reader.finish();
}

}  // namespace subdivd::proto::json
