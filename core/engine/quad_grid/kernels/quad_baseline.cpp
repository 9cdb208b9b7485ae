#define SUBDIVD_KERNELS baseline
#define SUBDIVD_KERNELS_NAME "baseline"
#include "core/engine/quad_grid/kernels/quad_loops.inc"
