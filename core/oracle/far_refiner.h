#pragma once
// Control mesh or any topology -> Far::TopologyRefiner. Internal to core/oracle: the one header that includes
// OpenSubdiv.

#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefiner.h>

#include <memory>
#include <string>

#include "core/base/result.h"
#include "core/mesh/control_mesh.h"

namespace subdivd::oracle {

using FarRefiner = std::unique_ptr<OpenSubdiv::Far::TopologyRefiner>;

// Not yet refined. Face-varying channels stand in the order of the face-varying primvars.
Result<FarRefiner> make_refiner(const ControlMesh& mesh, CreaseMethod crease_method);

// Of any topology; unsupported, in Far's own words, when Far complains.
Result<FarRefiner> create_refiner(const OpenSubdiv::Far::TopologyDescriptor& topology,
                                  OpenSubdiv::Sdc::SchemeType scheme, OpenSubdiv::Sdc::Options rules);

// Far reports through two process-wide callbacks. Ours keep the last message per thread, and print nothing.
// take_far_error returns what Far said on this thread since the last call; empty when nothing.
std::string take_far_error();

// Index of every face corner's value.
std::vector<int> corner_values(const Primvar& primvar, Count corners);

}  // namespace subdivd::oracle
