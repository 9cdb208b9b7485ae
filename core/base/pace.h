#pragma once
// How work that is deep inside a formula, or long, learns that it is to stop: it says what it spends, and is
// thrown out. A ring of ten million edges has no place between its loops where a result could be handed up.

#include <algorithm>
#include <cassert>
#include <iterator>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/budget.h"
#include "core/base/index.h"
#include "core/base/parallel.h"
#include "core/base/result.h"

namespace subdivd {

// One for each thread. What it throws never leaves the core: stoppable() and Team catch it.
class Pace {
 public:
  static constexpr Count kBlock = Count{1} << 14;  // elementary steps (some 10 ns each) between two polls

  Pace() = default;  // never stops
  explicit Pace(const Budget& budget) : budget_(&budget) {}
  explicit Pace(Worker& worker) : worker_(&worker) {}

  // For parts of the work that take a budget; where they are stopped, their error is to be thrown as Stopped.
  const Budget& budget() const {
    static const Budget unlimited;
    assert(worker_ == nullptr);
    return budget_ != nullptr ? *budget_ : unlimited;
  }

  // Threads that this work may be shared out to: one for who is one of several already.
  Index threads() const { return worker_ == nullptr && budget_ != nullptr ? budget_->threads() : 1; }

  // Call before `steps` more steps. Throws Stopped when there is no more to spend.
  void spend(Count steps) const {
    if (worker_ != nullptr) {
      if (!worker_->go_on(steps)) throw Stopped{};
      return;
    }
    spent_ += steps;
    if (spent_ < kBlock) return;
    spent_ = 0;
    if (budget_ == nullptr) return;
    if (auto stop = budget_->poll()) throw Stopped{std::move(*stop)};
  }

  // Calls f(begin, end) for blocks of 0..total-1, of `steps` steps for each of them.
  template <class F>
  void in_blocks(Count total, F&& f, Count steps = 1) const {
    const Count block = std::max<Count>(1, kBlock / steps);
    for (Count begin = 0; begin < total; begin += block) {
      const Count end = std::min(begin + block, total);
      spend((end - begin) * steps);
      f(begin, end);
    }
  }
  // Whether f(begin, end) is true for all such blocks; stops at the first for which it is not.
  template <class F>
  bool all_blocks(Count total, F&& f) const {
    for (Count begin = 0; begin < total; begin += kBlock) {
      const Count end = std::min(begin + kBlock, total);
      spend(end - begin);
      if (!f(begin, end)) return false;
    }
    return true;
  }
  // Calls f(k) for k = 0..total-1.
  template <class I, class F>
  void for_each(I total, F&& f) const {
    in_blocks(total, [&](Count begin, Count end) {
      for (Count k = begin; k < end; ++k) f(static_cast<I>(k));
    });
  }

  // Whole arrays: a gigabyte that is only filled or copied takes most of a second, too.
  template <class Array>
  void fill(Array& array, Count size, typename Array::value_type value) const {
    array.clear();
    array.reserve(size);
    in_blocks(size, [&](Count begin, Count end) { array.insert(array.end(), end - begin, value); });
  }
  template <class From, class Array>
  void copy(const From& from, Array& to) const {
    to.clear();
    to.reserve(from.size());
    in_blocks(from.size(), [&](Count begin, Count end) {
      to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(begin),
                from.begin() + static_cast<std::ptrdiff_t>(end));
    });
  }
  // Whether two arrays hold the same.
  template <class A, class B>
  bool equal(const A& a, const B& b) const {
    return a.size() == b.size() && all_blocks(a.size(), [&](Count begin, Count end) {
             return std::equal(a.begin() + static_cast<std::ptrdiff_t>(begin),
                               a.begin() + static_cast<std::ptrdiff_t>(end),
                               b.begin() + static_cast<std::ptrdiff_t>(begin));
           });
  }
  // As to.insert(to.end(), ...), and as from.push_back() many times: an array that grows is moved as a whole.
  template <class From, class Array>
  void append(const From& from, Array& to) const {
    make_room(to, from.size());
    in_blocks(from.size(), [&](Count begin, Count end) {
      to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(begin),
                from.begin() + static_cast<std::ptrdiff_t>(end));
    });
  }
  // Room for `more` elements behind those that there are, as the array itself would make it.
  template <class Array>
  void make_room(Array& array, Count more) const {
    if (more <= array.capacity() - array.size()) return;
    Array larger;
    larger.reserve(std::max<Count>(2 * array.capacity(), array.size() + more));
    in_blocks(array.size(), [&](Count begin, Count end) {
      larger.insert(larger.end(), std::make_move_iterator(array.begin() + static_cast<std::ptrdiff_t>(begin)),
                    std::make_move_iterator(array.begin() + static_cast<std::ptrdiff_t>(end)));
    });
    array.swap(larger);
  }
  // As std::sort; `less` must be cheap. Stopped, the elements are in no order, and some may be lost.
  template <class Iterator, class Less>
  void sort(Iterator first, Iterator last, Less&& less) const {
    std::sort(first, last, [&](const auto& a, const auto& b) {
      spend(1);
      return less(a, b);
    });
  }

 private:
  const Budget* budget_ = nullptr;
  Worker* worker_ = nullptr;
  mutable Count spent_ = kBlock;  // the first call polls: a dead caller costs nothing
};

// Whether an error is no fault of the input, and has no place in it: the work could not go on.
inline bool is_stop(const Error& error) {
  return error.code == ErrorCode::cancelled || error.code == ErrorCode::deadline_exceeded ||
         error.code == ErrorCode::overloaded;
}

// f(pace), which returns a value or nothing; the error when it was stopped.
template <class F>
auto stoppable(const Budget& budget, F&& f) {
  using Value = std::invoke_result_t<F, const Pace&>;
  const Pace pace(budget);
  if constexpr (std::is_void_v<Value>) {
    try {
      f(pace);
      return Result<void>();
    } catch (Stopped& stopped) {
      return Result<void>(std::move(stopped.error));
    }
  } else if constexpr (requires(Value value) { value.error(); }) {  // a Result already
    try {
      return f(pace);
    } catch (Stopped& stopped) {
      return Value(std::move(stopped.error));
    }
  } else {
    try {
      return Result<Value>(f(pace));
    } catch (Stopped& stopped) {
      return Result<Value>(std::move(stopped.error));
    }
  }
}

}  // namespace subdivd
