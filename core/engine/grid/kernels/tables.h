#pragma once
// The tables of loops that stand once for every instruction set, each in a namespace of its own. For the file that
// chooses between them, which is compiled with SUBDIVD_NEWER_KERNELS where there are more than the baseline's.

#include <array>

#include "core/engine/grid/kernels/instruction_sets.h"

#ifdef SUBDIVD_NEWER_KERNELS
#define SUBDIVD_DECLARE_TABLES(Table, name) \
  namespace baseline {                      \
  extern const Table name;                  \
  }                                         \
  namespace avx2 {                          \
  extern const Table name;                  \
  }                                         \
  namespace avx512 {                        \
  extern const Table name;                  \
  }
// By the number of the set.
#define SUBDIVD_TABLES(name) \
  std::array { &baseline::name, &avx2::name, &avx512::name }
#else
#define SUBDIVD_DECLARE_TABLES(Table, name) \
  namespace baseline {                      \
  extern const Table name;                  \
  }
#define SUBDIVD_TABLES(name) \
  std::array { &baseline::name }
#endif
