#pragma once
// Where Far 3.5.0's answer is its own affair, so that a difference says nothing about us. Each was found by a
// deviation and is kept honest by a test (tests/core/oracle/far_quirks_test.cpp).

#include <vector>

#include "core/base/pace.h"
#include "core/mesh/control_mesh.h"
#include "core/oracle/far_refiner.h"

namespace subdivd::oracle {

// Around a point with two values in the pattern A … B … A … B … Far takes the second run of B for a third
// value (its search for known values looks at the first one only, FVarLevel::completeTopologyFromFaceValues),
// and so treats B and B' as smooth borders where both values should be corners. Returns one flag per base
// face: set for the faces around such a point, all that its values reach. Empty when there is none.
// Throws Stopped.
std::vector<unsigned char> faces_at_torn_values(const OpenSubdiv::Far::TopologyRefiner& refiner, int channel,
                                                const Pace& pace);

}  // namespace subdivd::oracle
