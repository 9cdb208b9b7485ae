#pragma once
#include "proto/gltf/work.h"

namespace subdivd::test {

// Work that may take as long and as much as it likes.
struct Unlimited {
  Budget budget;
  proto::gltf::Work work{budget};
};

}  // namespace subdivd::test
