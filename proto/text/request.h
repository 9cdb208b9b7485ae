#pragma once
// What readers of text make requests of.

#include <optional>
#include <string>
#include <vector>

#include "core/base/budget.h"
#include "core/mesh/control_mesh.h"
#include "proto/wire.h"

namespace subdivd::proto::text {

// The error where the budget has no `bytes`, and some for what is small, any more.
std::optional<Error> take(const Budget& budget, Count bytes);

void add_primvar(ControlMesh& mesh, const char* name, Interpolation interpolation, Index element_size,
                 std::vector<double> values, std::vector<Index> indices = {});

// A request whose answer, where it is JSON, has nested points and flat faces; alone, the mesh stands at
// the top.
RefineRequest make_request(std::vector<ControlMesh> meshes, std::vector<ControlCurves> curves,
                           std::vector<std::string> warnings);

}  // namespace subdivd::proto::text
