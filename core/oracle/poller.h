#pragma once
// Leaving loops when the budget says so, Far's own among them. Internal to core/oracle.

#include <type_traits>
#include <utility>

#include "core/base/budget.h"
#include "core/base/result.h"

namespace subdivd::oracle {

// Far's loops over values run in its templates, which call us back for every value (far_rows.h): nothing but
// an exception leaves them. It never crosses the interface of this folder: stoppable() makes an error of it.
struct Stopped {
  Error why;
};

class Poller {
 public:
  explicit Poller(const Budget& budget) : poller_(budget) {}

  // To be called for every elementary step, or for some together. Throws Stopped.
  void spend(Count steps) {
    if (auto stop = poller_.spend(steps)) throw Stopped{*std::move(stop)};
  }

 private:
  BudgetPoller poller_;
};

// What `work`, which returns a Result, comes to; the budget's reason if it is stopped.
template <class Work>
std::invoke_result_t<Work> stoppable(Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (Stopped& stopped) {
    return std::move(stopped.why);
  }
}

}  // namespace subdivd::oracle
