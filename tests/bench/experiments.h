#pragma once
// What is timed against what. Each adds its figures to the results and returns our median.

#include "tests/bench/case.h"
#include "tests/bench/contest.h"
#include "tests/bench/requests.h"

namespace subdivd::bench {

// Arrays to arrays: our plan, evaluation and indices; Far's create, refine, interpolate and extract; CGAL;
// OpenMesh; memset and memcpy of exactly the output. False when Far's answer is not ours.
bool same_answer(const Case& cell);
double time_total(const Case& cell, const Pace& pace, Results& results);
// Limit positions and unit normals beside the positions, against Far's limit positions and two tangents.
double time_limits(const Case& cell, const Pace& pace, Results& results);
// New positions on a plan that is there, against Far's stencils and Osd's evaluator on stencils that are
// there.
double time_again(const Case& cell, const Pace& pace, Results& results);
double time_threads(const Case& cell, const Pace& pace, Results& results);
// Our plan for all levels of the workload against Far's adjacency.
double time_plan(const Case& cell, const Pace& pace, Results& results);
// Peak beyond the output, in percent of it.
double count_memory(const Case& cell, Results& results);
// GLB in, GLB out, through the daemon; against the core's total for the same mesh and all bytes at 1 GB/s.
double time_http(const Case& cell, const Pace& pace, Results& results);

// Whole requests to a warm daemon, on one thread and on as many as it takes, and the same without HTTP;
// against our warm engine on the same mesh plus a copy of every byte of body and answer.
double time_request(const Asset& asset, Index level, const Pace& pace, Results& results);

}  // namespace subdivd::bench
