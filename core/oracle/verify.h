#pragma once
// Verifies our refinement of a control mesh, curve or surface against OpenSubdiv's Far (uniform refinement,
// primvar interpolation, face-varying interpolation, Limit), level by level, in the same precision. Includes
// no OpenSubdiv.

#include <string>

#include "core/base/budget.h"
#include "core/base/result.h"
#include "core/curves/subdivision.h"
#include "core/mesh/control_mesh.h"
#include "core/oracle/report.h"
#include "core/refine/refine.h"
#include "core/surfaces/patch.h"

namespace subdivd::oracle {

// "OpenSubdiv 3.5.0 Far": whom the report quotes.
std::string oracle_name();

// `plan`: of the mesh, for options.level at least. Compares levels 1..options.level (level 0 when that is
// asked for), at most kMaxFarLevel. `mesh` must have passed check(): Far itself checks nothing. Limits and
// normals are compared when options ask for them, and left out, counted and named where Far is no witness:
// where semi-sharpness is left (Far takes it for infinite), at darts (its masks do not know the crease), and
// for normals where the surface has several sides or Far's tangent is not the surface's: see compare.cpp.
// Tolerances of max_relative: 1e-12 (double), 2e-6 (float); normals 0.01 degrees (double), 0.5 (float);
// limits of face-varying primvars 1e-7 (Far's masks for them are single precision). `unsupported`: Far
// does not know the mesh's scheme, or not with its options.
template <class Real>
Result<MeshReport> verify(const ControlMesh& mesh, const Plan& plan, const RefineOptions& options,
                          const Budget& budget);
// With a plan of its own.
template <class Real>
Result<MeshReport> verify(const ControlMesh& mesh, const RefineOptions& options, const Budget& budget);

// Bytes of the report, of the tree that proto makes of it, and of its text together; on the safe side.
// Beside far_mesh_bytes (far.h).
Count report_bytes(const ControlMesh& mesh, Index level);

// A pinned or periodic cubic curve is the border of a strip (ring) of triangles in Far, any width; a
// nonperiodic one is the inner part of such a border. Far refines its own points level by level, one level at
// a time. In deviations worst_vertex is the refined point, worst_face the curve, worst_u its parameter t.
template <class Real>
Result<CurveReport> verify(const ControlCurves& curves, const CurveOptions& options, const Budget& budget);

// A bicubic surface on a grid of points is Catmull-Clark on the grid's quads: periodic directions close the
// grid, pinned ones end at its border (whose points follow the cubic curve's rules, and whose corners stay),
// nonperiodic ones are the inner part of pinned ones. Far refines its own points, one level at a time.
// Compares levels 1..options.level (level 0 when that is asked for): the quads, points, and with
// options.limit and options.normals limits and normals (points of width 3 only), tolerances as above. `patch`
// must have passed check(). Left out, counted and named: limits and normals at the ends of nonperiodic
// directions, which the surface does not reach; normals where Far's tangents have no cross product that
// rounding could not have made. options.tangents and options.faces play no part. In deviations worst_vertex
// is the refined point, worst_u and worst_v its parameters as patch_parameter gives them, worst_face the quad
// of the control grid. Fails with unsupported for other degrees than 3 at {"uDegree"} or {"vDegree"}, as
// predict_bytes, and with too_large for what Far cannot number or for working memory over budget.max_bytes.
template <class Real>
Result<SurfaceReport> verify(const ControlPatch& patch, const PatchOptions& options, const Budget& budget);

}  // namespace subdivd::oracle
