#pragma once
#include "core/base/budget.h"

namespace subdivd::test {

// Grants so much and no more.
class Purse final : public MemoryGrant {
 public:
  explicit Purse(Count bytes) : left_(bytes) {}
  Result<void> take(Count bytes) override {
    if (bytes > left_) return Error{ErrorCode::overloaded, "others take the memory"};
    left_ -= bytes;
    return {};
  }

 private:
  Count left_;
};

}  // namespace subdivd::test
