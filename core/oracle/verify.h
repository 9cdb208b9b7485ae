#pragma once
// Verifies our refinement of a control mesh or curve against OpenSubdiv's Far (uniform refinement, primvar
// interpolation, face-varying interpolation, Limit), level by level, in the same precision. Includes no
// OpenSubdiv.

#include "core/base/budget.h"
#include "core/base/result.h"
#include "core/curves/cubic.h"
#include "core/mesh/control_mesh.h"
#include "core/oracle/report.h"
#include "core/refine/refine.h"

namespace subdivd::oracle {

// Tolerances of max_relative: 1e-12 (double), 2e-6 (float) for points, primvars and limits; normals 0.01
// degrees (double), 0.5 degrees (float). `mesh` must have passed check(): Far itself checks nothing.
// Levels 1..options.level are compared; limits and normals only where no semi-sharpness is left (Far treats
// what is left as infinite). options.loop_weights must be `loop` (Far knows no other): `unsupported`
// otherwise.
template <class Real>
Result<MeshReport> verify(const ControlMesh& mesh, const RefineOptions& options, const Budget& budget);

// A pinned or periodic cubic curve is the border of a strip (ring) of triangles in Far, any width;
// a nonperiodic one is the inner part of such a border.
template <class Real>
Result<CurveReport> verify(const ControlCurves& curves, const CurveOptions& options, const Budget& budget);

}  // namespace subdivd::oracle
