#define SUBDIVD_KERNELS curves_avx2
#include "core/curves/kernels/curve_loops.inc"
