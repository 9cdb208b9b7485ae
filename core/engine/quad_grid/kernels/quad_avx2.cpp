#define SUBDIVD_KERNELS avx2
#define SUBDIVD_KERNELS_NAME "avx2"
#include "core/engine/quad_grid/kernels/quad_loops.inc"
