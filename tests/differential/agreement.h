#pragma once
// Runs the oracle over one mesh and says in words what disagrees.

#include <string>

#include "core/oracle/verify.h"

namespace subdivd::differential {

// The sanitizers slow both sides down tenfold and look for other faults: fewer levels and meshes do.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

// How much was compared and how much was left out.
struct Coverage {
  Count compared = 0, excepted = 0;
};

struct Agreement {
  std::string disagreements;  // one line each; empty: none
  Coverage limits, normals, values;
};

// Levels 1..level with limits and normals; level 0 when that is asked for.
template <class Real>
Agreement agreement(const ControlMesh& mesh, CreaseMethod method, Index level);

// Whether uniform and Chaikin creases could differ: some crease is semi-sharp.
bool has_semi_sharp_creases(const ControlMesh& mesh);

}  // namespace subdivd::differential
