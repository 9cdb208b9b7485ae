#pragma once
// Our refined levels against the same levels by Far. All throw Stopped.

#include "core/base/pace.h"
#include "core/curves/subdivision.h"
#include "core/mesh/control_mesh.h"
#include "core/oracle/far.h"
#include "core/oracle/far_curves.h"
#include "core/oracle/far_surfaces.h"
#include "core/oracle/report.h"
#include "core/oracle/scale.h"
#include "core/refine/refined_mesh.h"
#include "core/surfaces/patch.h"

namespace subdivd::oracle {

// `ours` and `far` are both of `mesh`, in the same level. Compares what both hold: points and primvars, and
// limits and normals if present. Points and limit points deviate by a distance, primvars by the largest
// difference of a component. Arrays of the wrong length fail as a whole (compared = 0, tolerance missed).
template <class Real>
LevelReport compare(const ControlMesh& mesh, const RefinedMesh<Real>& ours, const FarLevel<Real>& far,
                    const Pace& pace);

// One refined level of curves (deviations: verify.h says how the worst point is named).
// connectivity_identical: the same number of points, curve by curve.
template <class Real>
LevelReport compare(const RefinedCurves<Real>& ours, const FarCurves& far, const PointScale& scale,
                    const Pace& pace);

// One refined level of a bicubic surface, with its quads, and the same level by Far (deviations: verify.h
// says how the worst point is named). connectivity_identical: a grid of the same size, of the same quads
// whatever their order; otherwise nothing else is compared.
template <class Real>
LevelReport compare(const ControlPatch& patch, const RefinedPatch<Real>& ours, const FarSurface& far,
                    const Pace& pace);

}  // namespace subdivd::oracle
