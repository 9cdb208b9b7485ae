#define SUBDIVD_KERNELS avx512
#define SUBDIVD_KERNELS_NAME "avx512"
#include "core/engine/quad_grid/kernels/quad_loops.inc"
