#define SUBDIVD_KERNELS baseline
#define SUBDIVD_KERNELS_NAME "baseline"
#include "core/engine/tri_grid/kernels/tri_loops.inc"
