#define SUBDIVD_KERNELS avx2
#define SUBDIVD_KERNELS_NAME "avx2"
#include "core/refine/kernels/tri_loops.inc"
