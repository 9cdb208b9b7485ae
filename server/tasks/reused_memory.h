#pragma once
// Memory that one curve after the other takes and gives back. A grant only ever grows; asked for every curve
// anew it would count the same bytes again and again. For one thread, unlike other grants: work on one curve takes its
// memory where it is called.

#include "core/base/budget.h"

namespace subdivd::server::tasks {

class ReusedMemory final : public MemoryGrant {
 public:
  explicit ReusedMemory(const Budget& budget) : outer_(budget), inner_(budget) {
    if (budget.memory != nullptr) inner_.memory = this;
  }

  Count used() const { return used_; }
  // What was taken since there were `used` bytes of it is free again.
  void free_to(Count used) { used_ = used; }
  Result<void> take(Count bytes) override {
    if (used_ + bytes > most_) {
      if (auto taken = outer_.take_memory(used_ + bytes - most_); !taken) return taken;
      most_ = used_ + bytes;
    }
    used_ += bytes;
    return {};
  }
  // The budget for work on one curve. Must not outlive this.
  const Budget& budget() const { return inner_; }

 private:
  const Budget& outer_;
  Budget inner_;
  Count used_ = 0, most_ = 0;
};

}  // namespace subdivd::server::tasks
