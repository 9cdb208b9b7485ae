// What the routes under /v1/curves compute, without a socket.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "core/curves/piecewise.h"
#include "core/splines/edit.h"
#include "core/splines/spline.h"
#include "server/tasks/compute_curves.h"
#include "tests/support/payload_text.h"
#include "tests/support/purse.h"

namespace subdivd::server::tasks {
namespace {

using nlohmann::json;
using Kind = proto::CurveTaskKind;

json circle() {
  const double s = std::sqrt(0.5);
  return {{"type", "nurbs"},
          {"order", 3},
          {"knots", {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}},
          {"points", {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}}},
          {"pointWeights", {1, s, 1, s, 1, s, 1, s, 1}}};
}
json cubic() { return {{"points", {{0, 0}, {1, 1}, {2, 0}, {3, 1}, {4, 0}}}}; }

json with(json curve, const json& members) {
  curve.update(members);
  return curve;
}
json four_point() { return with(cubic(), {{"basis", "fourPoint"}, {"wrap", "periodic"}}); }

// The answer's JSON, or the code and the first place of the refusal.
json ask(Kind kind, const json& body, const Budget& budget = {}) {
  const auto refusal = [](const Error& error) {
    json place = json::array();
    for (const PathStep& step : error.where)
      std::visit([&](const auto& value) { place.push_back(value); }, step);
    return json{{"code", name_of(error.code)}, {"where", place}};
  };
  auto request = proto::decode_curves(body.dump(), kind, {}, {});
  if (!request) return refusal(request.error());
  if (auto bytes = predict_curve_task(*request, Count{1} << 30); !bytes) return refusal(bytes.error());
  if (kind == Kind::evaluate && request->task.on_surfaces) {
    auto samples = compute_surface_samples(*request, budget);
    return samples ? json::parse(test::text_of(*encode_samples(*request, *samples)))
                   : refusal(samples.error());
  }
  if (kind == Kind::evaluate) {
    auto samples = compute_samples(*request, budget);
    return samples ? json::parse(test::text_of(*encode_samples(*request, *samples)))
                   : refusal(samples.error());
  }
  if (kind == Kind::measure) {
    auto measures = compute_measures(*request, budget);
    return measures ? json::parse(test::text_of(*encode_measures(*request, *measures)))
                    : refusal(measures.error());
  }
  auto edited = compute_edited(*request, budget);
  if (!edited) return refusal(edited.error());
  return json::parse(test::text_of(*encode_edited(*request, *std::move(edited))));
}

TEST(CurveTasks, evaluate_points_derivatives_and_frames) {
  const json answer =
      ask(Kind::evaluate,
          with(circle(),
               {{"samples", {{"curves", {0, 0}}, {"ts", {0.5, 4}}}}, {"derivatives", 1}, {"frames", true}}));
  const json& samples = answer["samples"];
  const double s = std::sqrt(0.5);
  EXPECT_NEAR(samples["points"][0][0], s, 1e-15);
  EXPECT_NEAR(samples["points"][1][0], 1, 1e-15);
  EXPECT_EQ(samples["derivatives"].size(), 1u);
  EXPECT_NEAR(samples["tangents"][0][0], -s, 1e-15);
  EXPECT_NEAR(samples["normals"][0][0], -s, 1e-15);
  EXPECT_NEAR(samples["curvatures"][1], 1, 1e-14);
  EXPECT_TRUE(samples["torsions"][0].is_null());
  EXPECT_TRUE(samples["binormals"][0].is_null());
}

TEST(CurveTasks, evaluate_counts_curves_over_the_whole_body) {
  json two = cubic();
  two["curveVertexCounts"] = {2, 3};
  const json answer = ask(
      Kind::evaluate, {{"curves", {two, circle()}}, {"samples", {{"curves", {0, 1, 2}}, {"ts", {1, 0, 1}}}}});
  EXPECT_EQ(answer["samples"]["points"], json({{1.0, 1.0}, {2.0, 0.0}, {0.0, 1.0}}));
  EXPECT_EQ(ask(Kind::evaluate, {{"curves", {two}}, {"samples", {{"curves", {2}}, {"ts", {0}}}}})["where"],
            json({"samples", "curves", 0}));
  EXPECT_EQ(
      ask(Kind::evaluate, {{"curves", {two}}, {"samples", {{"curves", {0, 1}}, {"ts", {0, 2.5}}}}})["where"],
      json({"samples", "ts", 1}));
}

TEST(CurveTasks, insertion_and_removal_take_each_other_back) {
  const json more = ask(Kind::insert_knot, with(circle(), {{"insert", {2.5, 0.5, 0.5}}}));
  EXPECT_EQ(more["knots"], json({0, 0, 0, 0.5, 0.5, 1, 1, 2, 2, 2.5, 3, 3, 4, 4, 4}));
  EXPECT_EQ(more["order"], json({3}));
  json again = more;
  again["remove"] = {0.5, 2.5, 0.5};
  again["tolerance"] = 1e-12;
  const json less = ask(Kind::remove_knot, again);
  EXPECT_EQ(less["removed"], json({3})) << less;
  EXPECT_EQ(less["knots"], circle()["knots"]);
  for (std::size_t i = 0; i < 9; ++i)
    EXPECT_NEAR(less["points"][i][0].get<double>(), circle()["points"][i][0].get<double>(), 1e-14);
  EXPECT_LT(less["errorBounds"][0], 1e-13);
  again.erase("remove");
  EXPECT_GE(ask(Kind::remove_knot, again)["removed"][0], 3);
}

TEST(CurveTasks, refusals_point_at_the_knot) {
  EXPECT_EQ(ask(Kind::insert_knot, with(circle(), {{"insert", {0.5, 9}}}))["where"], json({"insert", 1}));
  EXPECT_EQ(ask(Kind::insert_knot, with(circle(), {{"insert", {0.5, 0.25, 1}}}))["where"],
            json({"insert", 2}));
  EXPECT_EQ(ask(Kind::remove_knot, with(circle(), {{"remove", {1, 0.5}}, {"tolerance", 1}}))["where"],
            json({"remove", 1}));
  EXPECT_EQ(ask(Kind::remove_knot, with(circle(), {{"tolerance", -1}}))["where"], json({"tolerance"}));
}

TEST(CurveTasks, convert_between_bases_and_back) {
  const json bezier = ask(Kind::convert, with(cubic(), {{"to", "bezier"}}));
  EXPECT_EQ(bezier["basis"], "bezier");
  json again = bezier;
  again.erase("errorBounds");
  again["to"] = "bspline";
  const json bspline = ask(Kind::convert, again);
  ASSERT_EQ(bspline["points"].size(), 7u) << bspline;  // the phantom points at both ends with it
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(bspline["points"][i + 1][0].get<double>(), cubic()["points"][i][0].get<double>(), 1e-13);
  EXPECT_EQ(ask(Kind::convert, with(cubic(), {{"to", "catmullRom"}}))["where"], json({"to"}));
  EXPECT_EQ(ask(Kind::convert, with(circle(), {{"to", "bezier"}}))["code"], "unsupported");
}

TEST(CurveTasks, convert_cuts_turns_and_moves) {
  const json answer =
      ask(Kind::convert, with(circle(), {{"range", {0, 1}}, {"reversed", true}, {"domain", {10, 20}}}));
  EXPECT_EQ(answer["knots"], json({10, 10, 10, 20, 20, 20}));
  EXPECT_EQ(answer["points"][0], json({0, 1}));
  EXPECT_EQ(answer["points"][2], json({1, 0}));
  EXPECT_EQ(ask(Kind::convert, with(circle(), {{"range", {3, 5}}}))["where"], json({"range"}));
  EXPECT_EQ(ask(Kind::convert, with(circle(), {{"domain", {3, 3}}}))["where"], json({"domain"}));
}

TEST(CurveTasks, convert_changes_the_degree) {
  const json up = ask(Kind::convert, with(circle(), {{"toDegree", 5}}));
  EXPECT_EQ(up["order"], json({6}));
  json again = up;
  again.erase("errorBounds");
  again["toDegree"] = 2;
  const json down = ask(Kind::convert, again);
  EXPECT_EQ(down["knots"], circle()["knots"]) << down;
  EXPECT_LT(down["errorBounds"][0], 1e-12);
  EXPECT_EQ(ask(Kind::convert, with(circle(), {{"toDegree", 1}}))["where"], json({"toDegree"}));
  EXPECT_TRUE(ask(Kind::convert, with(circle(), {{"toDegree", 1}, {"tolerance", 1}})).contains("points"));
}

TEST(CurveTasks, measure_a_circle) {
  const json answer =
      ask(Kind::measure,
          with(circle(), {{"closestTo", {{3, 0}, {0, 2}}}, {"equalLengths", 5}, {"flatten", 0.01}}));
  const json& one = answer["measures"][0];
  const double error = std::abs(one["length"]["value"].get<double>() - 2 * std::numbers::pi);
  EXPECT_LE(error, one["length"]["errorBound"]);
  EXPECT_NEAR(one["bounds"]["low"][1], -1, 1e-14);
  EXPECT_NEAR(one["closest"][0]["distance"], 2, 1e-14);
  EXPECT_NEAR(one["closest"][1]["t"], 1, 1e-7);
  EXPECT_NEAR(one["equalLengths"]["ts"][3], 3, 1e-9);
  EXPECT_EQ(one["polyline"]["ts"].size(), one["polyline"]["points"].size());
  EXPECT_EQ(ask(Kind::measure, with(circle(), {{"closestTo", {{1, 2, 3}}}}))["where"], json({"closestTo"}));
  EXPECT_EQ(ask(Kind::measure, with(circle(), {{"flatten", 0}}))["where"], json({"flatten"}));
}

TEST(CurveTasks, measure_blames_weights_too_far_apart_on_their_place_in_the_body) {
  const json lines{{"type", "nurbs"},
                   {"order", 2},
                   {"curveVertexCounts", {2, 3}},
                   {"knots", {0, 0, 1, 1, 0, 0, 1, 2, 2}},
                   {"points", {{0, 0}, {1, 0}, {0, 0}, {1, 1}, {2, 0}}},
                   {"pointWeights", {1, 1, 1, 1e-200, 1}}};
  const json answer = ask(Kind::measure, lines);
  EXPECT_EQ(answer["code"], "out_of_range") << answer;
  EXPECT_EQ(answer["where"], (json{"pointWeights", 3})) << answer;
}

TEST(CurveTasks, measure_how_fast_the_polygon_comes) {
  const json answer = ask(Kind::measure, with(cubic(), {{"convergence", 5}}));
  const json& convergence = answer["measures"][0]["convergence"];
  EXPECT_EQ(convergence["distances"].size(), 6u);
  EXPECT_NEAR(convergence["ratios"][4], 0.25, 0.01);
  EXPECT_EQ(ask(Kind::measure, with(circle(), {{"convergence", 5}}))["where"], json({"convergence"}));
}

// Phantom points beyond the ends, weights times points: what outgrows a double is refused, not written.
TEST(CurveTasks, numbers_that_outgrow_a_double_are_refused) {
  json huge = with(cubic(), {{"basis", "catmullRom"}});
  double side = 1.7e308;
  for (json& point : huge["points"]) point = {side = -side, side};
  json heavy = circle();
  for (json& weight : heavy["pointWeights"]) weight = weight.get<double>() * 1e308;
  for (json& point : heavy["points"])
    for (json& x : point) x = x.get<double>() * 1e3;
  for (const json& curve : {huge, heavy})
    for (const auto& [kind, members] : {std::pair{Kind::convert, json::object()},
                                        {Kind::insert_knot, json{{"insert", {1.5}}}},
                                        {Kind::remove_knot, json{{"tolerance", 1}}},
                                        {Kind::evaluate, json{{"samples", {{"ts", {1}}}}, {"frames", true}}},
                                        {Kind::measure, json::object()}}) {
      const json answer = ask(kind, with(curve, members));
      EXPECT_TRUE(answer["code"] == "out_of_range" || answer["code"] == "not_finite") << answer;
    }
}

TEST(CurveTasks, join_makes_one_curve_of_all) {
  const json first = cubic();
  json second = {
      {"type", "nurbs"}, {"order", 3}, {"knots", {0, 0, 0, 2, 2, 2}}, {"points", {{4, 0}, {5, 3}, {6, 0}}}};
  const json body = {{"curves", {first, second}}, {"join", true}};
  const json joined = ask(Kind::convert, body);
  ASSERT_TRUE(joined.contains("curves")) << joined;
  ASSERT_EQ(joined["curves"].size(), 1u);
  EXPECT_EQ(joined["errorBounds"].size(), 1u);
  EXPECT_EQ(joined["curves"][0]["order"], json({4}));
  const auto at = [](const json& curves, const json& numbers, const json& ts) {
    return ask(Kind::evaluate,
               {{"curves", curves}, {"samples", {{"curves", numbers}, {"ts", ts}}}})["samples"]["points"];
  };
  const json whole = at(joined["curves"], {0, 0, 0, 0}, {0, 2.5, 5, 6});
  const json parts = at({first, second}, {0, 0, 1, 1}, {0, 2.5, 1, 2});
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_NEAR(whole[i][k].get<double>(), parts[i][k].get<double>(), 1e-14);
  // Parameters of the whole.
  const json moved = ask(Kind::convert, with(body, {{"domain", {0, 1}}}));
  EXPECT_EQ(moved["curves"][0]["knots"].back(), 1);
  EXPECT_EQ(moved["curves"][0]["knots"].front(), 0);
  // Ends apart, or of another width.
  second["points"][0] = {4, 0.5};
  const json apart = {{"curves", {first, second}}, {"join", true}};
  EXPECT_EQ(ask(Kind::convert, apart)["where"], json({"curves", 1}));
  const json near = ask(Kind::convert, with(apart, {{"tolerance", 0.5}}));
  EXPECT_GE(near["errorBounds"][0], 0.25);
  EXPECT_LE(near["errorBounds"][0], 0.26);
  second["points"] = {{4, 0, 0}, {5, 3, 0}, {6, 0, 0}};
  EXPECT_EQ(ask(Kind::convert, {{"curves", {first, second}}, {"join", true}})["where"], json({"curves", 1}));
  // The lower degree is lifted, and what comes is not more than was predicted.
  json high = {{"type", "nurbs"}, {"order", 41}, {"points", json::array()}, {"knots", json::array()}};
  for (int i = 0; i < 41; ++i) high["points"].push_back({4 + i, 0});
  for (int i = 0; i < 82; ++i) high["knots"].push_back(i / 41);
  const json lifted = {{"curves", {first, high}}, {"join", true}};
  const auto request = proto::decode_curves(lifted.dump(), Kind::convert, {}, {});
  ASSERT_TRUE(request);
  const json answer = ask(Kind::convert, lifted);
  EXPECT_EQ(answer["curves"][0]["order"], json({41}));
  EXPECT_GE(*predict_curve_task(*request, Count{1} << 30), answer.dump().size());
  EXPECT_TRUE(ask(Kind::convert, with(first, {{"join", true}})).contains("points"));
  EXPECT_EQ(ask(Kind::measure, with(first, {{"join", true}}))["where"], json({"join"}));
}

TEST(CurveTasks, points_too_large_to_evaluate_are_blamed_and_not_the_parameter) {
  const json huge = {{"basis", "fourPoint"},
                     {"points", {{1.7e308}, {-1.7e308}, {1.7e308}, {-1.7e308}}},
                     {"samples", {{"ts", {0.5}}}}};
  EXPECT_EQ(ask(Kind::evaluate, huge)["where"], json({"points"}));
}

TEST(CurveTasks, no_curves_are_an_empty_list_of_curves) {
  const json answer = ask(Kind::convert, {{"curves", json::array()}, {"join", true}});
  EXPECT_EQ(answer["curves"], json::array());
  EXPECT_FALSE(answer.contains("meshes"));
}

TEST(CurveTasks, large_coordinates_are_no_trouble) {
  json large = cubic();
  for (json& point : large["points"])
    for (json& x : point) x = x.get<double>() * 1e200;
  EXPECT_TRUE(ask(Kind::measure, with(large, {{"flatten", 1e195}})).contains("measures"));
  // The tolerance goes by the extent, which must not overflow: a bent curve is no line.
  EXPECT_EQ(ask(Kind::convert, with(large, {{"toDegree", 1}}))["where"], json({"toDegree"}));
}

TEST(CurveTasks, answers_are_requests) {
  for (const Kind kind : {Kind::insert_knot, Kind::remove_knot, Kind::convert}) {
    json answer = ask(kind, kind == Kind::insert_knot ? with(circle(), {{"insert", {0.5}}}) : circle());
    answer.erase("removed");
    answer.erase("errorBounds");
    EXPECT_TRUE(ask(Kind::measure, answer).contains("measures")) << answer;
  }
}

TEST(CurveTasks, stop_when_nobody_waits_and_refuse_what_is_too_large) {
  const std::atomic<bool> gone = true;
  Budget budget;
  budget.cancelled = &gone;
  EXPECT_EQ(ask(Kind::measure, circle(), budget)["code"], "cancelled");
  EXPECT_EQ(ask(Kind::convert, circle(), budget)["code"], "cancelled");
  EXPECT_EQ(ask(Kind::evaluate, with(circle(), {{"samples", {{"ts", {0}}}}}), budget)["code"], "cancelled");
  const auto request = proto::decode_curves(circle().dump(), Kind::convert, {}, {});
  EXPECT_EQ(predict_curve_task(*request, 100).error().code, ErrorCode::too_large);
  // What is predicted is not less than what comes, whatever becomes of the curve.
  for (const json& members : {json{{"to", "nurbs"}}, json{{"to", "bezier"}}, json{{"toDegree", 20}}})
    for (json curve : {cubic(), with(cubic(), {{"basis", "catmullRom"}, {"wrap", "periodic"}})}) {
      if (members.contains("toDegree") && curve.contains("basis")) continue;
      const json body = with(std::move(curve), members);
      const auto decoded = proto::decode_curves(body.dump(), Kind::convert, {}, {});
      ASSERT_TRUE(decoded);
      EXPECT_GE(*predict_curve_task(*decoded, Count{1} << 30), ask(Kind::convert, body).dump().size());
    }
}

json cut() { return with(cubic(), {{"basis", "cornerCutting"}, {"ratio", 0.3}, {"wrap", "periodic"}}); }

// Curves without a formula: what exists is answered, the rest refused by name.
TEST(CurveTasks, subdivided_curves_have_a_point_and_a_tangent) {
  const json samples = {{"samples", {{"ts", {0, 2, 0.3}}}}};
  const json plain = ask(Kind::evaluate, with(with(four_point(), samples), {{"derivatives", 1}}))["samples"];
  EXPECT_EQ(plain["points"][1], json({2.0, 0.0}));
  EXPECT_NEAR(plain["derivatives"][0][1][1].get<double>(), 0, 1e-15);  // symmetric there
  const json framed = ask(Kind::evaluate, with(with(four_point(), samples), {{"frames", true}}))["samples"];
  EXPECT_EQ(framed["tangents"][1][0], 1.0);
  for (const char* none : {"normals", "curvatures", "torsions"})
    EXPECT_EQ(framed[none], json({nullptr, nullptr, nullptr})) << none;
  const json twice = ask(Kind::evaluate, with(with(four_point(), samples), {{"derivatives", 2}}));
  EXPECT_EQ(twice["code"], "unsupported");
  EXPECT_EQ(twice["where"], json({"derivatives"}));
  // Half a unit before a point is the middle of the edge, which every cut keeps.
  const json middle = ask(Kind::evaluate, with(cut(), {{"samples", {{"ts", {0.5, 1.5}}}}}))["samples"];
  EXPECT_EQ(middle["points"], json({{0.5, 0.5}, {1.5, 0.5}}));
  EXPECT_EQ(ask(Kind::evaluate, with(with(cut(), samples), {{"frames", true}}))["where"], json({"frames"}));
  EXPECT_EQ(ask(Kind::evaluate, with(cubic(), {{"basis", "fourPoint"}, {"samples", {{"ts", {5}}}}}))["where"],
            json({"samples", "ts", 0}));
}

TEST(CurveTasks, subdivided_curves_have_a_polyline_but_no_length) {
  for (const json& curve : {four_point(), cut()}) {
    const json answer = ask(Kind::measure, with(curve, {{"flatten", 1e-3}}));
    EXPECT_GT(answer["measures"][0]["polyline"]["points"].size(), 20u);
    EXPECT_FALSE(answer["measures"][0].contains("length"));
    for (const json& members : {json::object(), json{{"flatten", 0.1}, {"equalLengths", 3}},
                                json{{"flatten", 0.1}, {"closestTo", {{0, 0}}}}}) {
      const json refused = ask(Kind::measure, with(curve, members));
      EXPECT_EQ(refused["code"], "unsupported");
      EXPECT_EQ(refused["where"], json({"basis"}));
    }
    const json both = {{"curves", {cubic(), curve}}};
    EXPECT_EQ(ask(Kind::measure, both)["where"], json({"curves", 1, "basis"}));
    EXPECT_EQ(ask(Kind::convert, curve)["code"], "unsupported");
  }
}

// The biquadratic patch of the nine points (i, j, i^2 + j^2).
json bowl() {
  json points = json::array();
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) points.push_back({i, j, i * i + j * j});
  return {{"type", "bsplineSurface"},
          {"uVertexCount", 3},
          {"degree", 2},
          {"wrap", "nonperiodic"},
          {"points", points}};
}

// The quadratic B-spline of i^2 at the middle of its span is 1 + 1/4; of i it is the parameter.
TEST(CurveTasks, surfaces_are_evaluated) {
  const json samples = with(bowl(), {{"samples", {{"us", {1, 0.5}}, {"vs", {1, 1.5}}}}});
  const json answer = ask(Kind::evaluate, with(samples, {{"derivatives", 2}, {"frames", true}}))["samples"];
  EXPECT_EQ(answer["surfaces"], json({0, 0}));
  EXPECT_EQ(answer["points"][0], json({1.0, 1.0, 2.5}));
  EXPECT_EQ(answer["points"][1], json({0.5, 1.5, 3.0}));
  EXPECT_EQ(answer["derivatives"][0][0], json({{1.0, 0.0, 2.0}, {0.0, 1.0, 2.0}}));
  EXPECT_EQ(answer["derivatives"][1][0], json({{0.0, 0.0, 2.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 2.0}}));
  const auto normal = answer["normals"][0].get<std::vector<double>>();
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(normal[static_cast<std::size_t>(k)], k < 2 ? -2.0 / 3 : 1.0 / 3, 1e-15);
  EXPECT_FALSE(ask(Kind::evaluate, samples)["samples"].contains("normals"));
}

TEST(CurveTasks, samples_outside_a_surface_are_pointed_at) {
  const auto where = [](const json& body, const json& samples) {
    return ask(Kind::evaluate, with(body, {{"samples", samples}}))["where"];
  };
  EXPECT_EQ(where(bowl(), {{"us", {1, 3}}, {"vs", {1, 1}}}), json({"samples", "us", 1}));
  EXPECT_EQ(where(bowl(), {{"us", {1, 1}}, {"vs", {1, 0.4}}}), json({"samples", "vs", 1}));
  EXPECT_EQ(where(bowl(), {{"us", {1}}, {"vs", {1}}, {"surfaces", {1}}}), json({"samples", "surfaces", 0}));
  EXPECT_EQ(where(cubic(), {{"us", {1}}, {"vs", {1}}}), json({"samples", "surfaces", 0}));
  EXPECT_EQ(where(bowl(), {{"ts", {1}}}), json({"samples", "curves", 0}));
  json huge = bowl();
  for (json& point : huge["points"]) point[2] = point[2] == 2 ? 1.7e308 : -1.7e308;
  EXPECT_EQ(ask(Kind::evaluate, with(huge, {{"samples", {{"us", {1}}, {"vs", {1}}}}}))["where"],
            json({"points"}));
  // Flat nowhere: a pillow's seam has no normal, which is no number.
  json flat = bowl();
  for (json& point : flat["points"]) point = {point[0], point[0], point[0]};
  const json answer =
      ask(Kind::evaluate, with(flat, {{"samples", {{"us", {1}}, {"vs", {1}}}}, {"frames", true}}))["samples"];
  EXPECT_EQ(answer["normals"][0], nullptr);
}

TEST(CurveTasks, samples_of_surfaces_are_predicted_and_stopped) {
  const json many =
      with(bowl(), {{"samples", {{"us", std::vector<double>(5000, 1)}, {"vs", std::vector<double>(5000, 1)}}},
                    {"derivatives", 2},
                    {"frames", true}});
  const auto request = proto::decode_curves(many.dump(), Kind::evaluate, {}, {});
  ASSERT_TRUE(request);
  EXPECT_GE(*predict_curve_task(*request, Count{1} << 30), ask(Kind::evaluate, many).dump().size());
  EXPECT_EQ(predict_curve_task(*request, 10000).error().code, ErrorCode::too_large);
  const std::atomic<bool> gone = true;
  Budget budget;
  budget.cancelled = &gone;
  EXPECT_EQ(ask(Kind::evaluate, many, budget)["code"], "cancelled");
}

TEST(CurveTasks, round_their_results_to_the_precision_that_is_asked_for) {
  const json single = {{"options", {{"precision", "single"}}}};
  const json evaluate = with(circle(), {{"samples", {{"ts", {0.3}}}}, {"derivatives", 1}, {"frames", true}});
  const auto rounded = [](const json& one, const json& other) {
    return one.get<float>() == other.get<float>() && json(one.get<float>()).dump().size() > 0 &&
           one.dump().size() <= 13;
  };
  const json in_double = ask(Kind::evaluate, evaluate)["samples"];
  const json in_single = ask(Kind::evaluate, with(evaluate, single))["samples"];
  EXPECT_EQ(in_single["ts"], in_double["ts"]);  // a parameter, not a result
  for (const char* name : {"points", "tangents", "normals"})
    for (int k = 0; k < 2; ++k) {
      EXPECT_PRED2(rounded, in_single[name][0][k], in_double[name][0][k]) << name;
      EXPECT_GT(in_double[name][0][k].dump().size(), 13u) << name;
    }
  const json length = ask(Kind::measure, circle())["measures"][0]["length"]["value"];
  EXPECT_PRED2(rounded, ask(Kind::measure, with(circle(), single))["measures"][0]["length"]["value"], length);
  const json convert = with(circle(), {{"range", {0.3, 2}}});
  EXPECT_PRED2(rounded, ask(Kind::convert, with(convert, single))["points"][0][0],
               ask(Kind::convert, convert)["points"][0][0]);
}

TEST(CurveTasks, measure_a_million_curves_in_linear_time_or_stop) {
  // Every curve once looked for its points from the first on.
  std::string points = "[0]", counts = "2";
  for (int i = 1; i < 200000; ++i) points += ",[" + std::to_string(i % 7) + "]";
  for (int i = 1; i < 100000; ++i) counts += ",2";
  const std::string text =
      "{\"points\":[" + points + "],\"curveVertexCounts\":[" + counts + "],\"degree\":1,\"convergence\":1}";
  const auto request = proto::decode_curves(text, Kind::measure, {}, {});
  ASSERT_TRUE(request.ok()) << request.error().message;
  Budget budget;
  budget.deadline = Budget::Clock::now() + std::chrono::seconds(20);
  EXPECT_TRUE(compute_measures(*request, budget).ok());
}

// What making a curve takes for a moment once was counted for every curve anew: 3,000 of them took 64 MiB.
TEST(CurveTasks, evaluate_many_curves_in_little_memory) {
  constexpr std::size_t kCurves = 3000;
  json body = {{"degree", 1}};
  for (std::size_t i = 0; i < kCurves; ++i) {
    body["points"].push_back({i, 0});
    body["points"].push_back({i, 1});
    body["curveVertexCounts"].push_back(2);
    body["samples"]["curves"].push_back(i);
    body["samples"]["ts"].push_back(1);
  }
  subdivd::test::Purse purse(Count{4} << 20);
  Budget budget;
  budget.memory = &purse;
  const json answer = ask(Kind::evaluate, body, budget);
  ASSERT_TRUE(answer.contains("samples")) << answer;
  EXPECT_EQ(answer["samples"]["points"].size(), kCurves);
  // What is kept of every curve counts.
  subdivd::test::Purse small(Count{100} << 10);
  budget.memory = &small;
  EXPECT_EQ(ask(Kind::evaluate, body, budget)["code"], "overloaded");
}

// Joined to all before it, every curve once was a copy of these.
TEST(CurveTasks, join_many_curves_in_linear_time_or_stop) {
  constexpr std::size_t kCurves = 40000;
  std::string points, counts = "2";
  for (std::size_t i = 0; i < kCurves; ++i)
    points += (i > 0 ? ",[" : "[") + std::to_string(i) + "],[" + std::to_string(i + 1) + "]";
  for (std::size_t i = 1; i < kCurves; ++i) counts += ",2";
  const auto request = proto::decode_curves(
      "{\"points\":[" + points + "],\"curveVertexCounts\":[" + counts + "],\"degree\":1,\"join\":true}",
      Kind::convert, {}, {});
  ASSERT_TRUE(request.ok()) << request.error().message;
  Budget budget;
  budget.deadline = Budget::Clock::now() + std::chrono::seconds(10);
  const auto joined = compute_edited(*request, budget);
  ASSERT_TRUE(joined.ok()) << joined.error().message;
  EXPECT_EQ(joined->answer.curves[0].points.size(), kCurves + 1);
}

// Whatever is joined to what: as if each were joined to a copy of all before it.
TEST(CurveTasks, join_one_after_the_other_is_the_same_to_the_bit) {
  const std::vector<json> curves = {
      {{"points", {{0, 0}, {1, 0.3}, {2, 0.1}}}, {"degree", 2}},
      {{"points", {{2, 0.1}, {3, 0.7}, {3.3, 0.1}}}, {"degree", 2}},
      cubic(),
      {{"type", "nurbs"},
       {"order", 3},
       {"knots", {-1, 0, 0.1, 2, 2.3, 3}},
       {"points", {{4, 0}, {5, 3}, {6, 0}}},
       {"pointWeights", {0.3, 1, 0.7}}},
      cubic(),
      {{"points", {{0, 0}, {1, 0.3}}}, {"degree", 1}},
  };
  const auto request = proto::decode_curves(
      json{{"curves", curves}, {"join", true}, {"tolerance", 100}}.dump(), Kind::convert, {}, {});
  ASSERT_TRUE(request.ok()) << request.error().message;
  const auto all = compute_edited(*request, {});
  ASSERT_TRUE(all.ok()) << all.error().message;
  auto expected = spline_of(request->curves.curves[0], 0, {});
  for (std::size_t i = 1; i < curves.size(); ++i)
    expected = join(*expected, *spline_of(request->curves.curves[i], 0, {}), 100, {});
  ASSERT_TRUE(expected.ok()) << expected.error().message;
  EXPECT_TRUE(std::ranges::equal(std::get<Nurbs>(all->answer.curves[0].basis).knots, expected->knots));
  EXPECT_TRUE(std::ranges::equal(all->answer.curves[0].points, control_points_of(*expected)));
  EXPECT_TRUE(std::ranges::equal(std::get<Nurbs>(all->answer.curves[0].basis).weights, weights(*expected)));
}

TEST(CurveTasks, refuse_a_convergence_of_more_points_than_anyone_waits_for) {
  EXPECT_EQ(ask(Kind::measure, with(cubic(), {{"convergence", 24}}))["code"], "too_large");
}

}  // namespace
}  // namespace subdivd::server::tasks
