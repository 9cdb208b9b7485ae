#include "core/oracle/far_quirks.h"

namespace subdivd::oracle {
namespace {

namespace Far = OpenSubdiv::Far;

// The values of the faces around a vertex, in Far's order.
std::vector<Far::Index> values_around(const Far::TopologyLevel& base, int vertex, int channel) {
  const Far::ConstIndexArray faces = base.GetVertexFaces(vertex);
  const Far::ConstLocalIndexArray corners = base.GetVertexFaceLocalIndices(vertex);
  std::vector<Far::Index> values;
  for (int k = 0; k < faces.size(); ++k)
    values.push_back(base.GetFaceFVarValues(faces[k], channel)[corners[k]]);
  return values;
}

// Far's own search, as it stands: with two values known, every value but the first is taken for new. With
// three known it looks at all of them.
bool takes_a_known_value_for_new(const std::vector<Far::Index>& values) {
  std::size_t known = 1;
  Far::Index second = 0;
  for (std::size_t k = 1; k < values.size(); ++k) {
    if (values[k] == values[k - 1] || values[k] == values[0]) continue;
    if (known == 2) return values[k] == second;
    second = values[k];
    ++known;
  }
  return false;
}

}  // namespace

std::vector<unsigned char> faces_at_torn_values(const Far::TopologyRefiner& refiner, int channel,
                                                const Pace& pace) {
  const Far::TopologyLevel& base = refiner.GetLevel(0);
  std::vector<unsigned char> flags;
  for (int vertex = 0; vertex < base.GetNumVertices(); ++vertex) {
    pace.spend(4 + static_cast<Count>(base.GetVertexFaces(vertex).size()));
    if (!takes_a_known_value_for_new(values_around(base, vertex, channel))) continue;
    flags.resize(static_cast<std::size_t>(base.GetNumFaces()), 0);
    const Far::ConstIndexArray faces = base.GetVertexFaces(vertex);
    for (int k = 0; k < faces.size(); ++k) flags[static_cast<std::size_t>(faces[k])] = 1;
  }
  return flags;
}

}  // namespace subdivd::oracle
