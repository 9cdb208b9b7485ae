#pragma once
// Control mesh or any topology -> Far::TopologyRefiner. Internal to core/oracle: the one header that includes
// OpenSubdiv.

#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefiner.h>

#include <memory>

#include "core/base/result.h"
#include "core/mesh/control_mesh.h"
#include "core/oracle/far_scheme.h"

namespace subdivd::oracle {

using FarRefiner = std::unique_ptr<OpenSubdiv::Far::TopologyRefiner>;

// Not yet refined. Face-varying channels stand in the order of the face-varying primvars.
Result<FarRefiner> make_refiner(const ControlMesh& mesh, CreaseMethod crease_method, FarScheme scheme);

// Of any topology; unsupported when Far complains.
Result<FarRefiner> create_refiner(const OpenSubdiv::Far::TopologyDescriptor& topology,
                                  OpenSubdiv::Sdc::SchemeType scheme, OpenSubdiv::Sdc::Options rules);

// Far reports through two process-wide callbacks and would print to the standard output without them. Ours
// note that there was something, thread by thread, and drop the text: it is not made for those who read our
// answers. far_has_complained tells whether Far did on this thread since the last call.
bool far_has_complained();

// What a complaint comes to on the wire.
Error far_refusal();

// Index of every face corner's value.
std::vector<int> corner_values(const Primvar& primvar, Count corners);

}  // namespace subdivd::oracle
