#include "core/engine/grid/kernels/tables.h"
#include "core/engine/tri_grid/kernels/tri_step.h"

namespace subdivd::kernels {

SUBDIVD_DECLARE_TABLES(TriKernels<float>, kTriFloat)
SUBDIVD_DECLARE_TABLES(TriKernels<double>, kTriDouble)

template <>
const TriKernels<float>& tri_kernels() {
  return *SUBDIVD_TABLES(kTriFloat)[instruction_set()];
}
template <>
const TriKernels<double>& tri_kernels() {
  return *SUBDIVD_TABLES(kTriDouble)[instruction_set()];
}

}  // namespace subdivd::kernels
