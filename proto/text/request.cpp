#include "proto/text/request.h"

#include <utility>

namespace subdivd::proto::text {

std::optional<Error> take(const Budget& budget, Count bytes) {
  constexpr Count kSomething = Count{1} << 16;
  if (auto taken = budget.take_memory(kSomething + bytes); !taken) return std::move(taken).error();
  return std::nullopt;
}

void add_primvar(ControlMesh& mesh, const char* name, Interpolation interpolation, Index element_size,
                 std::vector<double> values, std::vector<Index> indices) {
  mesh.primvars.push_back({name, interpolation, element_size, std::move(values), std::move(indices)});
}

RefineRequest make_request(std::vector<ControlMesh> meshes, std::vector<ControlCurves> curves,
                           std::vector<std::string> warnings) {
  RefineRequest request;
  request.input = Format::json;
  request.from_text = true;
  request.single_mesh_at_top = meshes.size() == 1 && curves.empty();
  request.single_curve_at_top = curves.size() == 1 && meshes.empty();
  request.mesh_forms.resize(meshes.size());
  for (std::size_t i = 0; i < meshes.size(); ++i)
    request.mesh_forms[i].primvars.resize(meshes[i].primvars.size());
  request.curve_forms.resize(curves.size());
  request.meshes = std::move(meshes);
  request.curves = std::move(curves);
  request.warnings = std::move(warnings);
  return request;
}

}  // namespace subdivd::proto::text
