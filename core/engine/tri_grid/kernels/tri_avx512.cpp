#define SUBDIVD_KERNELS avx512
#define SUBDIVD_KERNELS_NAME "avx512"
#include "core/engine/tri_grid/kernels/tri_loops.inc"
