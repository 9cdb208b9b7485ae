#pragma once
// Bicubic B-spline surfaces in Far: Catmull-Clark on a grid of quads, which away from extraordinary vertices
// is the bicubic B-spline [CatmullClark78]. Includes no OpenSubdiv.

#include "core/base/budget.h"
#include "core/base/buffer.h"
#include "core/base/result.h"
#include "core/surfaces/patch.h"

namespace subdivd::oracle {

// One of the two directions of a grid.
struct FarDirection {
  Count points = 0;
  bool closed = false;  // else it begins and ends at a border

  Count segments() const { return closed ? points : points - 1; }
  Count refined_points() const { return closed ? 2 * points : 2 * points - 1; }
};

// A grid of points by Far, and what has been asked for of them. Point (i, j) is the (j u.points + i)-th.
struct FarSurface {
  FarDirection u, v;
  Index width = 3;
  Buffer<double> points;  // every float is a double: nothing is lost on the way into the next level
  Buffer<double> limits;  // width per point
  // 3 per point. They span the tangent plane, turned as du and dv are, and have the length of derivatives by
  // parameters that count this level's points.
  Buffer<double> u_tangents, v_tangents;
  // Far's own faces as points of the grid, 4 per quad, in Far's order; of the level that Far has refined.
  Buffer<Index> quads;
};

struct FarSurfaceOptions {
  Index level = 1;       // 0 or 1
  bool limit = false;    // fill limits
  bool normals = false;  // fill limits and tangents; points of width 3 only
};

// Corners of all faces that Far holds on the last step to `level`, and the bytes of that step and of
// comparing it, roughly: measured, on the safe side. `patch` and `level` must have passed predict_bytes.
Count far_surface_corners(const ControlPatch& patch, Index level);
Count far_surface_bytes(const ControlPatch& patch, Index level);

// Nonperiodic directions become pinned ones: they are the inner part of those.
FarSurface far_control(const ControlPatch& patch);

// One level more (or, with level 0, the same points and their limits), computed in Real. Refining Far's
// answer again is what Far does itself: the finer grid has the same border and the same four corners. Fails
// with out_of_range for a number that Real cannot hold, with unsupported for what Far refuses, or when the
// budget says stop.
template <class Real>
Result<FarSurface> far_refine_surface(const FarSurface& from, const FarSurfaceOptions& options,
                                      const Budget& budget);

}  // namespace subdivd::oracle
