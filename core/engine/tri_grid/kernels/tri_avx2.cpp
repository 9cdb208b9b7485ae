#define SUBDIVD_KERNELS avx2
#define SUBDIVD_KERNELS_NAME "avx2"
#include "core/engine/tri_grid/kernels/tri_loops.inc"
