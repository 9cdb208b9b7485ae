#define SUBDIVD_KERNELS baseline
#define SUBDIVD_KERNELS_NAME "baseline"
#include "core/refine/kernels/tri_loops.inc"
