// The bodies of /v1/curves/*: one curve at the top or several in "curves", and what is asked about them.

#include <algorithm>
#include <array>
#include <string>

#include "proto/curve_task.h"
#include "proto/json/arrays.h"
#include "proto/json/cursor.h"
#include "proto/json/document.h"
#include "proto/json/read_mesh.h"
#include "proto/options.h"
#include "proto/prepare.h"

namespace subdivd::proto {
namespace json {
namespace {

using Kind = CurveTaskKind;

constexpr std::array<std::string_view, 5> kForms = {"nurbs", "bezier", "bspline", "catmullRom", "hermite"};

class CurveTaskReader {
 public:
  CurveTaskReader(Cursor& cursor, const Limits& limits, CurveRequest& out)
      : cursor_(cursor), limits_(limits), out_(out), top_curve_(cursor, top_) {}

  static constexpr std::size_t kOwnMembers = 20;
  static constexpr std::size_t kMembers = kOwnMembers + CurvesReader::kMembers;
  static const std::array<Cursor::Member<CurveTaskReader>, kMembers>& members() {
    using T = CurveTaskReader;
    using C = CurvesReader;
    static constexpr std::array<Cursor::Member<T>, kMembers> table = {{
        {"curves", &T::curves},
        {"options", &T::options},
        {"samples", &T::samples},
        {"derivatives", &T::derivatives},
        {"frames", &T::frames},
        {"insert", &T::insert},
        {"remove", &T::remove},
        {"tolerance", &T::tolerance},
        {"to", &T::to},
        {"toDegree", &T::to_degree},
        {"range", &T::range},
        {"domain", &T::domain},
        {"reversed", &T::reversed},
        {"closestTo", &T::closest_to},
        {"flatten", &T::flatten},
        {"equalLengths", &T::equal_lengths},
        {"convergence", &T::convergence},
        {"statistics", &T::ignored},
        {"warnings", &T::ignored},
        {"verification", &T::ignored},
        {"name", &T::of_curve<&C::name>},
        {"type", &T::of_curve<&C::type>},
        {"basis", &T::of_curve<&C::basis>},
        {"degree", &T::of_curve<&C::degree>},
        {"wrap", &T::of_curve<&C::wrap>},
        {"tension", &T::of_curve<&C::tension>},
        {"ratio", &T::of_curve<&C::ratio>},
        {"spacing", &T::of_curve<&C::spacing>},
        {"points", &T::of_curve<&C::points>},
        {"curveVertexCounts", &T::of_curve<&C::curve_vertex_counts>},
        {"order", &T::of_curve<&C::order>},
        {"knots", &T::of_curve<&C::knots>},
        {"ranges", &T::of_curve<&C::ranges>},
        {"pointWeights", &T::of_curve<&C::point_weights>},
        {"tangents", &T::of_curve<&C::tangents>},
    }};
    return table;
  }

  bool read(simdjson::ondemand::object object) {
    std::bitset<kMembers> seen;
    if (!cursor_.read_members(object, members(), *this, seen)) return false;
    if ((seen >> kOwnMembers).any()) {
      if (seen[0])
        return cursor_.fail(ErrorCode::duplicate_field,
                            "the body has curves and members of a single curve; give one or the other",
                            {"curves"});
      if (!top_curve_.finish()) return false;
      out_.curves.single_curve_at_top = true;
      out_.curves.curves.push_back(std::move(top_.curves));
      out_.curves.curve_forms.push_back(top_.form);
    } else if (!seen[0]) {
      return cursor_.fail(ErrorCode::missing_field, "the body holds no curve; give points, or curves");
    }
    return check_members(seen);
  }

  bool curves(Value value) { return read_curve_list(cursor_, value, out_.curves); }
  bool options(Value value) { return read_options(cursor_, value, out_.curves.options); }

  bool samples(Value value) {
    simdjson::ondemand::object object;
    if (value.get_object().get(object)) return cursor_.fail_type(value, "an object with curves and ts");
    static constexpr std::array<Cursor::Member<CurveTaskReader>, 2> table = {
        {{"curves", &CurveTaskReader::sample_curves}, {"ts", &CurveTaskReader::sample_ts}}};
    std::bitset<2> seen;
    if (!cursor_.read_members(object, table, *this, seen)) return false;
    if (!seen[1]) return cursor_.fail(ErrorCode::missing_field, "samples need parameters", {"ts"});
    if (!seen[0]) task().sample_curves.assign(task().sample_ts.size(), 0);
    if (task().sample_curves.size() == task().sample_ts.size()) return true;
    return cursor_.fail(ErrorCode::wrong_length,
                        "there are " + std::to_string(task().sample_curves.size()) + " curves for " +
                            std::to_string(task().sample_ts.size()) + " ts; every parameter has a curve",
                        {"curves"});
  }
  bool sample_curves(Value value) { return read_indices(cursor_, value, task().sample_curves); }
  bool sample_ts(Value value) { return read_reals(cursor_, value, task().sample_ts); }

  bool derivatives(Value value) { return read_count(value, kMostDerivatives, task().derivatives); }
  bool frames(Value value) { return read_truth(value, task().frames); }
  bool insert(Value value) { return read_reals(cursor_, value, task().insert); }
  bool remove(Value value) { return read_reals(cursor_, value, task().remove.emplace()); }
  bool tolerance(Value value) { return read_real(value, task().tolerance.emplace()); }
  bool to(Value value) {
    std::size_t word = 0;
    if (!cursor_.read_word(value, kForms, word)) return false;
    task().to = static_cast<CurveForm>(word);
    return true;
  }
  bool to_degree(Value value) {
    Index& degree = task().to_degree.emplace();
    if (!read_count(value, kMaxDegree, degree)) return false;
    return degree >= 1 || cursor_.fail(ErrorCode::out_of_range, "the degree of a curve is 1 at least");
  }
  bool range(Value value) { return read_pair(value, task().range.emplace()); }
  bool domain(Value value) { return read_pair(value, task().domain.emplace()); }
  bool reversed(Value value) { return read_truth(value, task().reversed); }
  bool closest_to(Value value) {
    Tuples tuples;
    if (!read_tuples(cursor_, value, 0, kMaxCurveWidth, "point", tuples)) return false;
    if (tuples.form == ArrayForm::flat && !tuples.values.empty())
      return cursor_.fail(ErrorCode::wrong_type, "points to come close to must be nested, [[x, y], …]");
    task().closest_to = std::move(tuples.values);
    task().closest_width = tuples.width;
    return true;
  }
  bool flatten(Value value) { return read_real(value, task().flatten.emplace()); }
  bool equal_lengths(Value value) {
    return read_count(value, kMostEqualLengths, task().equal_lengths.emplace());
  }
  bool convergence(Value value) { return read_count(value, kMaxCurveLevel, task().convergence.emplace()); }
  // Members of an answer, which is a valid request.
  bool ignored(Value value) { return cursor_.skip(value, limits_.max_json_depth); }

  template <bool (CurvesReader::*member)(Value)>
  bool of_curve(Value value) {
    return (top_curve_.*member)(value);
  }

 private:
  CurveTask& task() { return out_.task; }

  bool read_real(Value value, double& out) {
    return get_number(value, out) || cursor_.fail_number(value, "a number");
  }
  bool read_truth(Value value, bool& out) {
    return !value.get_bool().get(out) || cursor_.fail_type(value, "true or false");
  }
  bool read_count(Value value, Index most, Index& out) {
    if (!read_whole_number(cursor_, value, out)) return false;
    if (out <= most) return true;
    return cursor_.fail(ErrorCode::out_of_range, "this is " + std::to_string(out) + "; it must be " +
                                                     std::to_string(most) + " at most");
  }
  bool read_pair(Value value, std::array<double, 2>& out) {
    std::vector<double> numbers;
    if (!read_reals(cursor_, value, numbers)) return false;
    if (numbers.size() != 2)
      return cursor_.fail(ErrorCode::wrong_length,
                          "two numbers are needed, the first and the last parameter");
    std::ranges::copy(numbers, out.begin());
    return true;
  }

  // Every member belongs to the tasks that are named here, and to no other.
  bool check_members(const std::bitset<kMembers>& seen) {
    struct Rule {
      std::string_view name;
      std::array<Kind, 2> tasks;
      bool needed;
    };
    static constexpr std::array<Rule, 16> rules = {{
        {"options", {Kind::refine, Kind::refine}, false},
        {"samples", {Kind::evaluate, Kind::evaluate}, true},
        {"derivatives", {Kind::evaluate, Kind::evaluate}, false},
        {"frames", {Kind::evaluate, Kind::evaluate}, false},
        {"insert", {Kind::insert_knot, Kind::insert_knot}, true},
        {"remove", {Kind::remove_knot, Kind::remove_knot}, false},
        {"to", {Kind::convert, Kind::convert}, false},
        {"toDegree", {Kind::convert, Kind::convert}, false},
        {"range", {Kind::convert, Kind::convert}, false},
        {"domain", {Kind::convert, Kind::convert}, false},
        {"reversed", {Kind::convert, Kind::convert}, false},
        {"closestTo", {Kind::measure, Kind::measure}, false},
        {"flatten", {Kind::measure, Kind::measure}, false},
        {"equalLengths", {Kind::measure, Kind::measure}, false},
        {"convergence", {Kind::measure, Kind::measure}, false},
        {"verification", {Kind::refine, Kind::refine}, false},
    }};
    for (const Rule& rule : rules) {
      std::size_t number = 0;
      while (members()[number].name != rule.name) ++number;
      const bool fits = std::ranges::find(rule.tasks, task().kind) != rule.tasks.end();
      if (seen[number] && !fits)
        return cursor_.fail(ErrorCode::unknown_field, "this request takes no " + std::string(rule.name),
                            {std::string(rule.name)});
      if (!seen[number] && fits && rule.needed)
        return cursor_.fail(ErrorCode::missing_field, "this request needs " + std::string(rule.name),
                            {std::string(rule.name)});
    }
    if (!task().tolerance || task().kind == Kind::remove_knot || task().kind == Kind::convert ||
        task().kind == Kind::measure)
      return true;
    return cursor_.fail(ErrorCode::unknown_field, "this request takes no tolerance", {"tolerance"});
  }

  Cursor& cursor_;
  const Limits& limits_;
  CurveRequest& out_;
  CurvesRead top_;
  CurvesReader top_curve_;
};

}  // namespace
}  // namespace json

Result<CurveRequest> decode_curves(std::string_view body, CurveTaskKind kind, const QueryParameters& query,
                                   const Limits& limits) {
  if (body.size() > limits.max_body_bytes)
    return Error{ErrorCode::too_large,
                 std::string("the body has ") + std::to_string(body.size()) + " bytes; " +
                     std::to_string(limits.max_body_bytes) + " are allowed",
                 {},
                 body.size(),
                 limits.max_body_bytes};
  CurveRequest request;
  request.task.kind = kind;
  request.curves.input = Format::json;
  const auto done = json::read_document(body, [&](json::Cursor& cursor, simdjson::ondemand::object object) {
    return json::CurveTaskReader(cursor, limits, request).read(object);
  });
  if (!done) return done.error();
  if (kind != CurveTaskKind::refine && !query.empty())
    return Error{
        ErrorCode::unknown_field, "this request takes no query parameters", {"?" + query[0].first}, 0, 0};
  if (auto set = set_parameters(request.curves.options, query); !set) return set.error();
  if (auto fine = check_options(request.curves.options, limits, query); !fine) return fine.error();
  if (auto fine = prepare(request.curves); !fine) return fine.error();
  return request;
}

}  // namespace subdivd::proto
