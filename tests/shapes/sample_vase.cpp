// The JSON sample.
#include <cmath>
#include <cstdio>
#include <numbers>

#include "tests/shapes/sample.h"

namespace subdivd::shapes {
namespace {

constexpr Index kColumns = 8, kRows = 6;
constexpr double kRadius[kRows] = {0.45, 0.80, 0.95, 0.60, 0.35, 0.55};
constexpr double kHeight[kRows] = {0.00, 0.30, 0.90, 1.50, 1.90, 2.25};

std::string number(double x) {  // three decimals at most
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", x);
  std::string shortest = text;
  while (shortest.back() == '0') shortest.pop_back();
  if (shortest.back() == '.') shortest.pop_back();
  return shortest == "-0" ? "0" : shortest;
}

template <class Item, class Text>
std::string list(const std::vector<Item>& items, std::size_t per_line, Text text) {
  std::string out = "[";
  for (std::size_t k = 0; k < items.size(); ++k) {
    if (k > 0) out += k % per_line == 0 ? ",\n    " : ", ";
    out += text(items[k]);
  }
  return out + "]";
}

}  // namespace

std::string sample_vase_json() {
  std::vector<std::array<double, 3>> points = {{0, 0, 0}};
  std::vector<std::array<double, 2>> st;
  std::vector<std::array<Index, 3>> faces, st_faces;
  const auto point = [](Index r, Index c) { return 1 + r * kColumns + c % kColumns; };
  const auto st_at = [](Index r, Index c) {
    return r * (kColumns + 1) + c;
  };  // not modulo: a seam at column 0
  for (Index r = 0; r < kRows; ++r)
    for (Index c = 0; c <= kColumns; ++c) {
      const double angle = 2 * std::numbers::pi * c / kColumns;
      if (c < kColumns)
        points.push_back({kRadius[r] * std::cos(angle), kHeight[r], -kRadius[r] * std::sin(angle)});
      st.push_back({double(c) / kColumns, 0.1 + 0.9 * r / (kRows - 1)});
    }
  const auto centre = static_cast<Index>(st.size());  // one value for each triangle of the floor
  for (Index c = 0; c < kColumns; ++c) {
    st.push_back({(c + 0.5) / kColumns, 0});
    faces.push_back({0, point(0, c + 1), point(0, c)});
    st_faces.push_back({centre + c, st_at(0, c + 1), st_at(0, c)});
    for (Index r = 0; r + 1 < kRows; ++r) {
      faces.push_back({point(r, c), point(r, c + 1), point(r + 1, c + 1)});
      faces.push_back({point(r, c), point(r + 1, c + 1), point(r + 1, c)});
      st_faces.push_back({st_at(r, c), st_at(r, c + 1), st_at(r + 1, c + 1)});
      st_faces.push_back({st_at(r, c), st_at(r + 1, c + 1), st_at(r + 1, c)});
    }
  }
  std::vector<Index> foot, neck;  // closed: the first point again at the end
  for (Index c = 0; c <= kColumns; ++c) foot.push_back(point(0, c)), neck.push_back(point(kRows - 2, c));

  const auto tuple = [](const auto& values) {
    std::string out;
    for (const auto value : values) {
      out += out.empty() ? "[" : ",";
      out += number(double(value));
    }
    return out + "]";
  };
  const auto plain = [](Index value) { return std::to_string(value); };
  std::vector<Index> creases = foot, st_indices;
  creases.insert(creases.end(), neck.begin(), neck.end());
  for (const auto& face : st_faces) st_indices.insert(st_indices.end(), face.begin(), face.end());
  std::string json = "{\n  \"name\": \"vase\",\n  \"points\": " + list(points, 6, tuple);
  json += ",\n  \"faceVertexIndices\": " + list(faces, 12, tuple);
  json += ",\n  \"creaseIndices\": " + list(creases, 24, plain);
  json += R"(,
  "creaseLengths": [9, 9],
  "creaseSharpnesses": ["infinite", 2.5],
  "primvars": {"st": {"interpolation": "faceVarying", "elementSize": 2,
    "values": )";
  json += list(st, 8, tuple);
  json += ",\n    \"indices\": " + list(st_indices, 24, plain);
  return json + "}},\n  \"options\": {\"level\": 3, \"normals\": true}\n}\n";
}

}  // namespace subdivd::shapes
