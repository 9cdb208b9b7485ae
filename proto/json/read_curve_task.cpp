// The bodies of /v1/curves/*: one curve or surface at the top or several in "curves" and "surfaces", and what
// is asked about them.

#include <algorithm>
#include <array>
#include <string>

#include "proto/curve_task.h"
#include "proto/json/arrays.h"
#include "proto/json/cursor.h"
#include "proto/json/document.h"
#include "proto/json/json.h"
#include "proto/json/read_mesh.h"
#include "proto/json/survey.h"
#include "proto/options.h"
#include "proto/prepare.h"

namespace subdivd::proto {
namespace json {
namespace {

using Kind = CurveTaskKind;

// What is asked beside curves is computed in double, and told in the precision of the answer.
std::span<const std::string_view> options_of(Kind kind) {
  static constexpr std::array<std::string_view, 1> kOfTasks = {"precision"};
  return kind == Kind::refine ? option_names() : std::span<const std::string_view>(kOfTasks);
}

constexpr std::array<std::string_view, 5> kForms = {"nurbs", "bezier", "bspline", "catmullRom", "hermite"};

class CurveTaskReader {
 public:
  CurveTaskReader(Cursor& cursor, const Limits& limits, CurveRequest& out)
      : cursor_(cursor), limits_(limits), out_(out), top_curve_(cursor, top_) {}

  static constexpr std::size_t kOwnMembers = 22;
  static constexpr std::size_t kMembers = kOwnMembers + CurvesReader::kMembers + 9;  // of surfaces alone
  static const std::array<Cursor::Member<CurveTaskReader>, kMembers>& members() {
    using T = CurveTaskReader;
    using C = CurvesReader;
    static constexpr std::array<Cursor::Member<T>, kMembers> table = {{
        {"curves", &T::curves},
        {"surfaces", &T::surfaces},
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
        {"join", &T::join},
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
        {"uVertexCount", &T::of_curve<&C::u_vertex_count>},
        {"vVertexCount", &T::of_curve<&C::v_vertex_count>},
        {"uDegree", &T::of_curve<&C::u_degree>},
        {"vDegree", &T::of_curve<&C::v_degree>},
        {"uWrap", &T::of_curve<&C::u_wrap>},
        {"vWrap", &T::of_curve<&C::v_wrap>},
        {"faceVertexCounts", &T::of_curve<&C::face_vertex_counts>},
        {"faceVertexIndices", &T::of_curve<&C::face_vertex_indices>},
        {"normals", &T::of_curve<&C::normals>},
    }};
    return table;
  }

  bool read() {
    std::bitset<kMembers> seen;
    if (!cursor_.read_members(members(), *this, seen)) return false;
    if ((seen >> kOwnMembers).any()) {
      if (seen[0] || seen[1])
        return cursor_.fail(ErrorCode::duplicate_field,
                            "the body has lists and members of a single curve; give one or the other",
                            {seen[0] ? "curves" : "surfaces"});
      if (!top_curve_.finish()) return false;
      take_top();
    } else if (!seen[0] && !seen[1]) {
      return cursor_.fail(ErrorCode::missing_field, "the body holds no curve; give points, or curves");
    }
    return check_members(seen);
  }

  bool curves() { return read_curve_list(cursor_, out_.curves); }
  bool surfaces() { return read_surface_list(cursor_, out_.curves); }
  bool options() {
    return read_options(cursor_, limits_.max_json_depth, out_.curves.options, options_of(task().kind));
  }

  bool samples() {
    if (!cursor_.open_object("an object with curves and ts, or with surfaces, us and vs")) return false;
    using T = CurveTaskReader;
    static constexpr std::array<Cursor::Member<T>, 5> table = {{{"curves", &T::sample_curves},
                                                                {"ts", &T::sample_ts},
                                                                {"surfaces", &T::sample_surfaces},
                                                                {"us", &T::sample_us},
                                                                {"vs", &T::sample_vs}}};
    std::bitset<5> seen;
    if (!cursor_.read_members(table, *this, seen)) return false;
    const bool of_curves = seen[0] || seen[1];
    if (of_curves && (seen >> 2).any())
      return cursor_.fail(ErrorCode::duplicate_field,
                          "samples have ts on curves, or us and vs on surfaces; ask for one and then for "
                          "the other",
                          {seen[1] ? "ts" : "curves"});
    task().on_surfaces = (seen >> 2).any();
    if (task().on_surfaces) return check_surface_samples(seen[2], seen[3], seen[4]);
    if (!seen[1])
      return cursor_.fail(ErrorCode::missing_field, "samples need parameters: ts, or us and vs", {"ts"});
    return check_count(seen[0], task().sample_curves, "curves", task().sample_ts, "ts");
  }
  bool sample_curves() { return read_indices(cursor_, task().sample_curves); }
  bool sample_ts() { return read_reals(cursor_, task().sample_ts); }
  bool sample_surfaces() { return read_indices(cursor_, task().sample_surfaces); }
  bool sample_us() { return read_reals(cursor_, task().sample_us); }
  bool sample_vs() { return read_reals(cursor_, task().sample_vs); }

  bool derivatives() { return read_count(kMostDerivatives, task().derivatives); }
  bool frames() { return read_truth(task().frames); }
  bool insert() { return read_reals(cursor_, task().insert); }
  bool remove() { return read_reals(cursor_, task().remove.emplace()); }
  bool tolerance() { return read_real(task().tolerance.emplace()); }
  bool to() {
    std::size_t word = 0;
    if (!cursor_.read_word(kForms, word)) return false;
    task().to = static_cast<CurveForm>(word);
    return true;
  }
  bool to_degree() {
    Index& degree = task().to_degree.emplace();
    if (!read_count(kMaxDegree, degree)) return false;
    return degree >= 1 || cursor_.fail(ErrorCode::out_of_range, "the degree of a curve is 1 at least");
  }
  bool range() { return read_pair(task().range.emplace()); }
  bool domain() { return read_pair(task().domain.emplace()); }
  bool reversed() { return read_truth(task().reversed); }
  bool join() { return read_truth(task().join); }
  bool closest_to() {
    Tuples tuples;
    if (!read_tuples(cursor_, 0, kMaxCurveWidth, "point", tuples)) return false;
    if (tuples.form == ArrayForm::flat && !tuples.values.empty())
      return cursor_.fail(ErrorCode::wrong_type, "points to come close to must be nested, [[x, y], …]");
    task().closest_to = std::move(tuples.values);
    task().closest_width = tuples.width;
    return true;
  }
  bool flatten() { return read_real(task().flatten.emplace()); }
  bool equal_lengths() { return read_count(kMostEqualLengths, task().equal_lengths.emplace()); }
  bool convergence() { return read_count(kMaxCurveLevel, task().convergence.emplace()); }
  // Members of an answer, which is a valid request.
  bool ignored() { return cursor_.skip(limits_.max_json_depth); }

  template <bool (CurvesReader::*member)()>
  bool of_curve() {
    return (top_curve_.*member)();
  }

 private:
  CurveTask& task() { return out_.task; }

  bool read_real(double& out) { return cursor_.read_number(out, "a number"); }
  bool read_truth(bool& out) { return cursor_.read_bool(out, "true or false"); }
  bool read_count(Index most, Index& out) {
    if (!read_whole_number(cursor_, out)) return false;
    if (out <= most) return true;
    return cursor_.fail(ErrorCode::out_of_range, "this is " + std::to_string(out) + "; it must be " +
                                                     std::to_string(most) + " at most");
  }
  bool read_pair(std::array<double, 2>& out) {
    std::vector<double> numbers;
    if (!read_reals(cursor_, numbers)) return false;
    if (numbers.size() != 2)
      return cursor_.fail(ErrorCode::wrong_length,
                          "two numbers are needed, the first and the last parameter");
    std::ranges::copy(numbers, out.begin());
    return true;
  }

  void take_top() {
    RefineRequest& request = out_.curves;
    request.single_curve_at_top = !top_.surface;
    request.single_surface_at_top = top_.surface.has_value();
    if (top_.surface) {
      request.surfaces.push_back(*std::move(top_.surface));
      request.surface_forms.push_back(top_.surface_form);
    } else {
      request.curves.push_back(std::move(top_.curves));
      request.curve_forms.push_back(top_.form);
    }
  }

  bool check_surface_samples(bool numbered, bool u, bool v) {
    if (!u || !v)
      return cursor_.fail(ErrorCode::missing_field, "samples on surfaces need us and vs", {u ? "vs" : "us"});
    if (task().sample_us.size() != task().sample_vs.size())
      return cursor_.fail(ErrorCode::wrong_length,
                          "there are " + std::to_string(task().sample_us.size()) + " us and " +
                              std::to_string(task().sample_vs.size()) + " vs; they go together",
                          {"vs"});
    return check_count(numbered, task().sample_surfaces, "surfaces", task().sample_us, "us");
  }
  // Whose parameters they are: numbers that were left out are 0.
  bool check_count(bool given, std::vector<Index>& numbers, const char* of,
                   const std::vector<double>& parameters, const char* name) {
    if (!given) {
      const Count bytes = parameters.size() * sizeof(Index);
      if (auto taken = cursor_.budget().take_memory(bytes); !taken) return cursor_.fail_as(taken.error());
      numbers.assign(parameters.size(), 0);
    }
    if (numbers.size() == parameters.size()) return true;
    return cursor_.fail(ErrorCode::wrong_length,
                        "there are " + std::to_string(numbers.size()) + ' ' + of + " for " +
                            std::to_string(parameters.size()) + ' ' + name + "; every sample has one",
                        {of});
  }

  // Every member belongs to the tasks that are named here, and to no other.
  bool check_members(const std::bitset<kMembers>& seen) {
    struct Rule {
      std::string_view name;
      std::array<Kind, 2> tasks;
      bool needed;
    };
    static constexpr std::array<Rule, 16> rules = {{
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
        {"join", {Kind::convert, Kind::convert}, false},
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

Result<void> read_task(std::string_view body, const Limits& limits, const Budget& budget,
                       CurveRequest& request) {
  request.curves.input = Format::json;
  request.curves.without_meshes = true;
  return read_document(body, budget,
                       [&](Cursor& cursor) { return CurveTaskReader(cursor, limits, request).read(); });
}

}  // namespace

Result<RefineRequest> read_curve(std::string_view body, const Limits& limits, const Budget& budget) {
  CurveRequest request;
  if (auto done = read_task(body, limits, budget, request); !done) return std::move(done).error();
  return std::move(request.curves);
}

}  // namespace json

namespace {

Result<void> check_surfaces(const CurveRequest& request) {
  const CurveTaskKind kind = request.task.kind;
  const RefineRequest& read = request.curves;
  if (request.task.on_surfaces && request.task.derivatives > 2)
    return Error{ErrorCode::out_of_range,
                 "this is " + std::to_string(request.task.derivatives) +
                     "; surfaces have derivatives of order 1 and 2",
                 {"derivatives"}};
  if (read.surfaces.empty() || kind == CurveTaskKind::refine || kind == CurveTaskKind::evaluate) return {};
  return Error{ErrorCode::unsupported,
               "this request takes curves; surfaces are refined and evaluated",
               {read.single_surface_at_top ? "type" : "surfaces"}};
}

}  // namespace

Result<CurveRequest> decode_curves(std::string_view body, CurveTaskKind kind, const QueryParameters& query,
                                   const Limits& limits, const Budget& budget) {
  if (body.size() > limits.max_body_bytes)
    return Error{.code = ErrorCode::too_large,
                 .message = std::string("the body has ") + std::to_string(body.size()) + " bytes; " +
                            std::to_string(limits.max_body_bytes) + " are allowed",
                 .predicted = body.size(),
                 .allowed = limits.max_body_bytes};
  CurveRequest request;
  request.task.kind = kind;
  const auto survey = json::survey(body, budget);
  if (!survey) return survey.error();
  if (auto taken = budget.take_memory(survey->reading_bytes()); !taken) return taken.error();
  if (auto done = json::read_task(body, limits, budget, request); !done) return std::move(done).error();
  if (auto set = set_parameters(request.curves.options, query, json::options_of(kind)); !set)
    return set.error();
  if (auto fine = check_options(request.curves, limits, query, budget); !fine) return fine.error();
  if (auto fine = prepare(request.curves, budget); !fine) return fine.error();
  if (auto fine = check_surfaces(request); !fine) return fine.error();
  return request;
}

}  // namespace subdivd::proto
