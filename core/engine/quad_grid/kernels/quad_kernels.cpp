#include "core/engine/grid/kernels/tables.h"
#include "core/engine/quad_grid/kernels/quad_step.h"

namespace subdivd::kernels {

SUBDIVD_DECLARE_TABLES(QuadKernels<float>, kQuadFloat)
SUBDIVD_DECLARE_TABLES(QuadKernels<double>, kQuadDouble)

template <>
const QuadKernels<float>& quad_kernels() {
  return *SUBDIVD_TABLES(kQuadFloat)[instruction_set()];
}
template <>
const QuadKernels<double>& quad_kernels() {
  return *SUBDIVD_TABLES(kQuadDouble)[instruction_set()];
}

}  // namespace subdivd::kernels
