#pragma once
// A control mesh made ready for refinement: everything about it that does not depend on values or level.

#include <vector>

#include "core/mesh/channel.h"
#include "core/mesh/control_mesh.h"
#include "core/mesh/sharpness.h"
#include "core/mesh/topology.h"
#include "core/refine/refine.h"

namespace subdivd {

struct Control {
  Topology topology;
  Sharpness sharpness;
  std::vector<unsigned char> holes;  // 1 for faces that are not output
  std::vector<Channel> channels;     // of the face-varying primvars, in their order
};

Control make_control(const ControlMesh& mesh, CreaseMethod method);

// See predict_size.
template <class Real>
Result<RefinedSize> size_of(const ControlMesh& mesh, const RefineOptions& options, const Control& control);

}  // namespace subdivd
