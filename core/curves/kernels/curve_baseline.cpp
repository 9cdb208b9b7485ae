#define SUBDIVD_KERNELS curves_baseline
#include "core/curves/kernels/curve_loops.inc"
