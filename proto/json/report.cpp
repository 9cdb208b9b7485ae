#include <cmath>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "proto/json/json.h"

namespace subdivd::proto::json {
namespace {

using Json = nlohmann::ordered_json;

std::string dumped(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

// JSON has no infinity and no NaN: null stands for both.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

// null: of something that was asked for nothing could be compared.
Json verdict(oracle::Verdict verdict) {
  if (verdict == oracle::Verdict::nothing_compared) return nullptr;
  return verdict == oracle::Verdict::passed;
}

// `faces`: the face of the input of every face that was compared; empty: the same.
Json worst(const oracle::Deviation& deviation, const std::vector<Index>& faces) {
  Json json;
  if (deviation.worst_vertex == kNoIndex) return nullptr;
  json["vertex"] = deviation.worst_vertex;
  if (deviation.worst_face != kNoIndex) {
    const Index face = deviation.worst_face;
    json["face"] = face < faces.size() ? faces[face] : face;
    if (deviation.worst_corner > 0) json["corner"] = deviation.worst_corner;
    json["u"] = number(deviation.worst_u);
    json["v"] = number(deviation.worst_v);
  }
  return json;
}

Json deviation_json(const oracle::Deviation& deviation, const std::vector<Index>& faces) {
  Json json = {{"quantity", deviation.quantity},
               {"withinTolerance", verdict(deviation.verdict)},
               {"tolerance", number(deviation.tolerance)},
               {"maxRelative", number(deviation.max_relative)},
               {"rmsRelative", number(deviation.rms_relative)},
               {"maxAbsolute", number(deviation.max_absolute)},
               {"rmsAbsolute", number(deviation.rms_absolute)},
               {"compared", deviation.compared}};
  if (Json place = worst(deviation, faces); !place.is_null()) json["worst"] = std::move(place);
  if (deviation.excepted > 0) {
    json["excepted"] = deviation.excepted;
    json["exception"] = deviation.exception;
  }
  return json;
}

// A MeshReport, a CurveReport or a SurfaceReport.
template <class One>
Json one_report(const One& one, const std::vector<Index>& faces) {
  Json json;
  if (!one.name.empty()) json["name"] = one.name;
  json["precision"] = one.precision;
  json["passed"] = verdict(one.verdict);
  json["levels"] = Json::array();
  for (const oracle::LevelReport& level : one.levels) {
    Json deviations = Json::array();
    for (const oracle::Deviation& deviation : level.deviations)
      deviations.push_back(deviation_json(deviation, faces));
    Json& to = json["levels"].emplace_back(Json{{"level", level.level},
                                                {"passed", verdict(level.verdict())},
                                                {"connectivityIdentical", level.connectivity_identical},
                                                {"vertices", level.vertices}});
    if constexpr (!std::is_same_v<One, oracle::CurveReport>) to["faces"] = level.faces;
    to["deviations"] = std::move(deviations);
  }
  if (!one.remarks.empty()) json["remarks"] = one.remarks;
  return json;
}

}  // namespace

// Part by part: as one tree many meshes would take ten times their text.
std::string report(const oracle::Report& report, const RefineRequest* request) {
  Json head = {{"oracle", report.oracle}, {"passed", verdict(report.verdict())}};
  std::string text = dumped(head);
  text.pop_back();
  static const std::vector<Index> kSame;
  const auto add = [&](const char* name, const auto& parts, const auto& faces_of) {
    if (parts.empty()) return;
    text.append(",\"").append(name).append("\":[");
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (i > 0) text += ',';
      text += dumped(one_report(parts[i], faces_of(i)));
    }
    text += ']';
  };
  const auto same = [](std::size_t) -> const std::vector<Index>& { return kSame; };
  add("meshes", report.meshes, [&](std::size_t i) -> const std::vector<Index>& {
    const bool moved = request != nullptr && i < request->face_origins.size();
    return moved ? request->face_origins[i] : kSame;
  });
  add("curves", report.curves, same);
  add("surfaces", report.surfaces, same);
  return text + '}';
}

}  // namespace subdivd::proto::json
