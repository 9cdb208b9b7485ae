#pragma once
// Bodies that are small for what they once cost: each makes one part of reading or writing walk over
// something long again and again. `size` says how often, and how long; a body is linear in it.

#include <cstddef>
#include <string>
#include <vector>

#include "proto/wire.h"

namespace subdivd::test {

struct Attack {
  const char* name;  // what is multiplied with what
  proto::Format format;
  std::string (*body)(std::size_t size);
  std::size_t usual;  // a size at which the product is seconds of work
};

const std::vector<Attack>& attacks();

}  // namespace subdivd::test
