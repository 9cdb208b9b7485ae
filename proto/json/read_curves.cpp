#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <variant>

#include "core/splines/spline.h"
#include "proto/json/read_mesh.h"
#include "proto/json/words.h"

namespace subdivd::proto::json {
namespace {

constexpr std::array<std::string_view, 4> kTypes = {"cubic", "linear", "nurbs", "bsplineSurface"};
enum class CurveType { cubic, linear, nurbs, surface };

}  // namespace

const std::array<CurvesReader::Member, CurvesReader::kMembers>& CurvesReader::members() {
  using C = CurvesReader;
  static constexpr std::array<Member, kMembers> table = {{
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

const std::array<CurvesReader::Member, CurvesReader::kSurfaceMembers>& CurvesReader::surface_members() {
  using C = CurvesReader;
  static constexpr std::array<Member, kSurfaceMembers> table = {{
      {"name", &C::name},
      {"type", &C::type},
      {"degree", &C::degree},
      {"wrap", &C::wrap},
      {"points", &C::points},
      {"uVertexCount", &C::u_vertex_count},
      {"vVertexCount", &C::v_vertex_count},
      {"uDegree", &C::u_degree},
      {"vDegree", &C::v_degree},
      {"uWrap", &C::u_wrap},
      {"vWrap", &C::v_wrap},
      {"faceVertexCounts", &C::face_vertex_counts},
      {"faceVertexIndices", &C::face_vertex_indices},
      {"normals", &C::normals},
  }};
  return table;
}

void CurvesReader::expect_surface() { type_ = static_cast<std::size_t>(CurveType::surface); }

bool CurvesReader::name() { return cursor_.read_string(out_.curves.name); }

bool CurvesReader::type() { return read_word(kTypes, type_); }

bool CurvesReader::basis() { return cursor_.read_word(basis_words(), basis_) && given(Part::basis); }

bool CurvesReader::degree() { return read_whole_number(cursor_, bspline_.degree) && given(Part::degree); }

bool CurvesReader::wrap() { return read_wrap(out_.curves.wrap) && given(Part::wrap); }

bool CurvesReader::tension() { return read_number(four_point_.tension) && given(Part::tension); }

bool CurvesReader::ratio() { return read_number(corner_cutting_.ratio) && given(Part::ratio); }

bool CurvesReader::spacing() {
  std::size_t word = 0;
  if (!cursor_.read_word(spacing_words(), word)) return false;
  catmull_rom_.spacing = static_cast<Spacing>(word);
  return given(Part::spacing);
}

bool CurvesReader::points() {
  has_points_ = true;
  Tuples tuples;
  if (!read_tuples(cursor_, 0, kMaxCurveWidth, "point", tuples)) return false;
  out_.form.points = tuples.form;
  out_.curves.width = tuples.width > 0 ? tuples.width : 3;
  if (tuples.values.size() % out_.curves.width != 0)
    return cursor_.fail(
        ErrorCode::wrong_length,
        std::string("the flat array holds ") + std::to_string(tuples.values.size()) +
            " numbers; it must hold a multiple of 3 (points of another width must be nested)");
  out_.curves.points = std::move(tuples.values);
  return true;
}

bool CurvesReader::curve_vertex_counts() {
  return read_indices(cursor_, out_.curves.vertex_counts) && given(Part::vertex_counts);
}

// One for all curves, as a number, or one for each.
bool CurvesReader::order() {
  out_.form.order_list = cursor_.type() == Type::array;
  if (out_.form.order_list) {
    if (!read_indices(cursor_, nurbs_.orders)) return false;
  } else {
    Index one = 0;
    if (!read_whole_number(cursor_, one)) return false;
    nurbs_.orders = {one};
  }
  return given(Part::order);
}

bool CurvesReader::knots() { return read_numbers(nurbs_.knots) && given(Part::knots); }

bool CurvesReader::ranges() {
  Tuples tuples;
  if (!read_tuples(cursor_, 2, 2, "range", tuples)) return false;
  out_.form.ranges = tuples.form;
  nurbs_.ranges = std::move(tuples.values);
  return given(Part::ranges);
}

bool CurvesReader::point_weights() { return read_numbers(nurbs_.weights) && given(Part::point_weights); }

bool CurvesReader::tangents() {
  Tuples unused;
  out_.had_tangents = true;
  return read_tuples(cursor_, 0, kMaxCurveWidth, "tangent", unused);
}

bool CurvesReader::u_vertex_count() {
  return read_whole_number(cursor_, surface_.u_count) && given(Part::u_count);
}

bool CurvesReader::v_vertex_count() {
  return read_whole_number(cursor_, surface_.v_count) && given(Part::v_count);
}

bool CurvesReader::u_degree() {
  return read_whole_number(cursor_, surface_.u_degree) && given(Part::u_degree);
}

bool CurvesReader::v_degree() {
  return read_whole_number(cursor_, surface_.v_degree) && given(Part::v_degree);
}

bool CurvesReader::u_wrap() { return read_wrap(surface_.u_wrap) && given(Part::u_wrap); }

bool CurvesReader::v_wrap() { return read_wrap(surface_.v_wrap) && given(Part::v_wrap); }

// Members of an answer, which is a valid request: faces of a surface follow from its counts.
bool CurvesReader::face_vertex_counts() {
  std::vector<Index> unused;
  return read_indices(cursor_, unused) && given(Part::faces);
}

bool CurvesReader::face_vertex_indices() {
  Lists unused;
  return read_lists(cursor_, "face", unused) && given(Part::faces);
}

bool CurvesReader::normals() {
  Tuples unused;
  return read_tuples(cursor_, 3, 3, "normal", unused) && given(Part::normals);
}

bool CurvesReader::finish() {
  const bool surface = type_ == static_cast<std::size_t>(CurveType::surface);
  if (!has_points_)
    return cursor_.fail(ErrorCode::missing_field, surface ? "a surface needs points" : "a curve needs points",
                        {"points"});
  out_.curves.basis = chosen_basis();
  if (!check_members()) return false;
  return surface ? settle_surface() : settle_type();
}

// The kind that type and basis name, with the members that have been read of it.
CurveBasis CurvesReader::chosen_basis() {
  if (type_ == static_cast<std::size_t>(CurveType::nurbs)) return std::move(nurbs_);
  CurveBasis all[] = {bspline_, four_point_, corner_cutting_, Bezier{}, catmull_rom_, Hermite{}};
  static_assert(std::size(all) + 1 == std::variant_size_v<CurveBasis>);
  const auto named = [&](const CurveBasis& basis) { return word_of(basis) == basis_words()[basis_]; };
  return *std::ranges::find_if(all, named);
}

// What belongs to one kind may not stand at another: it would be ignored.
bool CurvesReader::check_members() {
  const ControlCurves& curves = out_.curves;
  const bool surface = type_ == static_cast<std::size_t>(CurveType::surface);
  const bool on_knots = std::holds_alternative<Nurbs>(curves.basis);
  const bool is_bspline = std::holds_alternative<UniformBSpline>(curves.basis);
  struct Rule {
    Part part;
    const char *name, *belongs_to;
    bool fits;
  };
  constexpr const char* of_surface = "type \"bsplineSurface\"";
  const std::array<Rule, static_cast<std::size_t>(Part::count)> rules = {{
      {Part::basis, "basis", "type \"cubic\" or \"linear\"", !on_knots && !surface},
      {Part::wrap, "wrap", "type \"cubic\" or \"linear\"", !on_knots},
      {Part::degree, "degree", "basis \"bspline\"", is_bspline},
      {Part::tension, "tension", "basis \"fourPoint\"", std::holds_alternative<FourPoint>(curves.basis)},
      {Part::ratio, "ratio", "basis \"cornerCutting\"", std::holds_alternative<CornerCutting>(curves.basis)},
      {Part::spacing, "spacing", "basis \"catmullRom\"", std::holds_alternative<CatmullRom>(curves.basis)},
      {Part::order, "order", "type \"nurbs\"", on_knots},
      {Part::knots, "knots", "type \"nurbs\"", on_knots},
      {Part::ranges, "ranges", "type \"nurbs\"", on_knots},
      {Part::point_weights, "pointWeights", "type \"nurbs\"", on_knots},
      {Part::vertex_counts, "curveVertexCounts", "curves", !surface},
      {Part::u_count, "uVertexCount", of_surface, surface},
      {Part::v_count, "vVertexCount", of_surface, surface},
      {Part::u_degree, "uDegree", of_surface, surface},
      {Part::v_degree, "vDegree", of_surface, surface},
      {Part::u_wrap, "uWrap", of_surface, surface},
      {Part::v_wrap, "vWrap", of_surface, surface},
      {Part::faces, "faceVertexIndices", of_surface, surface},
      {Part::normals, "normals", of_surface, surface},
  }};
  for (const Rule& rule : rules)
    if (is_given(rule.part) && !rule.fits)
      return cursor_.fail(ErrorCode::unknown_field,
                          std::string(rule.name) + " belongs to " + rule.belongs_to + ", which this is not",
                          {rule.name});
  if (on_knots && !(is_given(Part::order) && is_given(Part::knots)))
    return cursor_.fail(ErrorCode::missing_field, "a curve of type \"nurbs\" needs order and knots",
                        {is_given(Part::order) ? "knots" : "order"});
  return true;
}

// One of the two counts follows from the other.
bool CurvesReader::settle_surface() {
  ControlCurves& read = out_.curves;
  surface_.name = std::move(read.name);
  surface_.width = read.width;
  surface_.points = std::move(read.points);
  const Count points = surface_.points.size() / surface_.width;
  const auto infer = [&](Index known, Index& unknown) {
    if (known > 0 && points % known == 0) unknown = static_cast<Index>(points / known);
  };
  if (!is_given(Part::u_count) && !is_given(Part::v_count))
    return cursor_.fail(ErrorCode::missing_field,
                        "a surface needs uVertexCount, how many points there are in a row", {"uVertexCount"});
  if (!is_given(Part::v_count)) infer(surface_.u_count, surface_.v_count);
  if (!is_given(Part::u_count)) infer(surface_.v_count, surface_.u_count);
  if (!(surface_.u_count > 0 && surface_.v_count > 0) || Count{surface_.u_count} * surface_.v_count != points)
    return cursor_.fail(
        ErrorCode::wrong_length,
        "there are " + std::to_string(points) + " points, which are no rows of " +
            std::to_string(surface_.u_count) + " points" +
            (is_given(Part::v_count) ? ", " + std::to_string(surface_.v_count) + " rows" : std::string()),
        {"points"});
  // One degree or wrap for both directions, unless a direction has its own.
  if (is_given(Part::degree)) {
    if (!is_given(Part::u_degree)) surface_.u_degree = bspline_.degree;
    if (!is_given(Part::v_degree)) surface_.v_degree = bspline_.degree;
  }
  if (is_given(Part::wrap)) {
    if (!is_given(Part::u_wrap)) surface_.u_wrap = read.wrap;
    if (!is_given(Part::v_wrap)) surface_.v_wrap = read.wrap;
  }
  out_.surface_form = {.points = out_.form.points,
                       .u_degree = is_given(Part::u_degree) || !is_given(Part::degree),
                       .v_degree = is_given(Part::v_degree) || !is_given(Part::degree),
                       .u_count = is_given(Part::u_count),
                       .v_count = is_given(Part::v_count)};
  out_.surface = std::move(surface_);
  return true;
}

// "cubic" and "linear" say the degree of a B-spline, too.
bool CurvesReader::settle_type() {
  if (!type_ || *type_ == static_cast<std::size_t>(CurveType::nurbs)) return true;
  UniformBSpline* bspline = std::get_if<UniformBSpline>(&out_.curves.basis);
  const bool linear = *type_ == static_cast<std::size_t>(CurveType::linear);
  if (linear && bspline == nullptr)
    return cursor_.fail(ErrorCode::wrong_type, "a curve of type \"linear\" has no basis but \"bspline\"",
                        {"basis"});
  if (bspline == nullptr) return true;
  const Index degree = linear ? 1 : 3;
  if (is_given(Part::degree) && bspline->degree != degree)
    return cursor_.fail(ErrorCode::out_of_range,
                        "the type says degree " + std::to_string(degree) + "; leave out one of the two",
                        {"degree"});
  bspline->degree = degree;
  return true;
}

bool CurvesReader::read_word(std::span<const std::string_view> words, std::optional<std::size_t>& out) {
  std::size_t word = 0;
  if (!cursor_.read_word(words, word)) return false;
  out = word;
  return true;
}

bool CurvesReader::read_wrap(CurveWrap& out) {
  std::size_t word = 0;
  if (!cursor_.read_word(wrap_words(), word)) return false;
  out = static_cast<CurveWrap>(word);
  return true;
}

bool CurvesReader::read_number(double& out) { return cursor_.read_number(out, "a number"); }

bool CurvesReader::read_numbers(std::vector<double>& out) { return read_reals(cursor_, out); }

bool read_curves(Cursor& cursor, CurvesRead& out) {
  if (!cursor.open_object("a curve, an object")) return false;
  CurvesReader reader(cursor, out);
  std::bitset<CurvesReader::kMembers> seen;
  if (!cursor.read_members(CurvesReader::members(), reader, seen) || !reader.finish()) return false;
  return !out.surface || cursor.fail(ErrorCode::wrong_type,
                                     "a surface belongs into surfaces, not among the curves", {"type"});
}

bool read_surface(Cursor& cursor, CurvesRead& out) {
  if (!cursor.open_object("a surface, an object")) return false;
  CurvesReader reader(cursor, out);
  reader.expect_surface();
  std::bitset<CurvesReader::kSurfaceMembers> seen;
  if (!cursor.read_members(CurvesReader::surface_members(), reader, seen) || !reader.finish()) return false;
  return out.surface ||
         cursor.fail(ErrorCode::wrong_type,
                     "a surface has the type \"bsplineSurface\"; curves belong into curves", {"type"});
}

}  // namespace subdivd::proto::json
