#pragma once
// Refines a control mesh: the door of the engine. What a request asks of a mesh is one plan, sizes predicted
// from it, and values refined by it.

#include <vector>

#include "core/base/budget.h"
#include "core/base/result.h"
#include "core/lattice/split.h"
#include "core/mesh/control_mesh.h"
#include "core/mesh/repair.h"
#include "core/refine/plan.h"
#include "core/refine/refined_mesh.h"
#include "core/schemes/all.h"

namespace subdivd {

struct RefineOptions {
  Index level = 2;          // 0..kMaxLevel
  AllSchemes schemes = {};  // the options of the one that the mesh names
  CreaseMethod crease_method = CreaseMethod::uniform;
  bool limit = false;        // fill limit_points and limit_values: where refining for ever would lead
  bool tangents = false;     // fill tangents_u, tangents_v
  bool normals = false;      // fill normals: unit normals of the limit surface
  bool connectivity = true;  // fill faces and the primvars' indices; render meshes have their own
  bool provenance = true;    // fill provenance and base_faces
  Index threads = 1;         // how many work on it; the answer is the same for any number
};

PlanOptions plan_options(const RefineOptions& options);

// What refine() would return, known beforehand.
struct RefinedSize {
  Count corners = 0;                   // of all output faces
  LevelCounts counts;                  // of the connectivity of positions; faces: holes left out
  std::vector<Count> channel_values;   // per face-varying primvar, in order of ControlMesh::primvars
  std::vector<Count> render_vertices;  // per RenderMesh
  std::vector<Count> render_triangles;
  Count bytes = 0;          // of all arrays of RefinedMesh<Real> together
  Count working_bytes = 0;  // what refine() needs beside them, at most; the plan among it
};

// `plan`: of that mesh, for options.level at least. Refuses (out_of_range, too_large) levels over kMaxLevel
// and results that 32-bit indices cannot number. Linear in the number of faces and primvars.
template <class Real>
Result<RefinedSize> predict_size(const ControlMesh& mesh, const Plan& plan, const RefineOptions& options,
                                 const Budget& budget = {});

// Refines the values of a mesh by its plan: of `mesh`, which must have passed check(), only the values are
// read, and where they belong. Fails for values too large for Real (check_magnitudes), for sizes (too_large,
// against budget.max_bytes as predicted) and when the budget says to stop: some milliseconds after it does.
// The answer depends on the mesh and the options alone, to the bit.
template <class Real>
Result<RefinedMesh<Real>> refine(const ControlMesh& mesh, const Plan& plan, const RefineOptions& options,
                                 const Budget& budget);

// The same for whoever asks once: with a plan of their own. All are instantiated for float and double.
template <class Real>
Result<RefinedSize> predict_size(const ControlMesh& mesh, const RefineOptions& options,
                                 const Budget& budget = {});
template <class Real>
Result<RefinedMesh<Real>> refine(const ControlMesh& mesh, const RefineOptions& options, const Budget& budget);

}  // namespace subdivd
