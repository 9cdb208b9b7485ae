#pragma once
// The time and memory of one reading or writing.

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "core/base/budget.h"
#include "core/base/pace.h"

namespace subdivd::proto::gltf {

class Held;

// A budget only ever gives: what was taken from it stays taken. So what one step has given up serves the
// next, and the budget is asked only when more is held at one time than ever before.
class Work {
 public:
  explicit Work(const Budget& budget) : pace_(budget), budget_(budget) {}
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;

  const Budget& budget() const { return budget_; }
  // After (or before) `steps` of some 10 ns. Empty: go on. Otherwise the reason to stop.
  std::optional<Error> spend(Count steps) {
    try {
      pace_.spend(steps);
      return std::nullopt;
    } catch (Stopped& stopped) {
      return std::move(stopped.error);
    }
  }
  // Copying and comparing go through memory faster: per byte.
  std::optional<Error> spend_bytes(Count bytes) { return spend(bytes / 32 + 1); }

  // `bytes` that will be allocated and live as long as what is read or written.
  Result<void> keep(Count bytes) {
    live_ += bytes;
    if (live_ <= taken_) return {};
    auto taken = budget_.take_memory(live_ - taken_);
    if (taken) taken_ = live_;
    return taken;
  }
  // `bytes` that live as long as the Held.
  Result<Held> hold(Count bytes);
  // Of what was kept, `bytes` have been freed.
  void drop(Count bytes) { live_ -= std::min(bytes, live_); }

 private:
  Pace pace_;
  const Budget& budget_;
  Count live_ = 0, taken_ = 0;
};

class Held {
 public:
  Held() = default;
  Held(Work& work, Count bytes) : work_(&work), bytes_(bytes) {}
  Held(Held&& other) noexcept : work_(std::exchange(other.work_, nullptr)), bytes_(other.bytes_) {}
  Held& operator=(Held&& other) noexcept {
    std::swap(work_, other.work_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  ~Held() {
    if (work_ != nullptr) work_->drop(bytes_);
  }

 private:
  Work* work_ = nullptr;
  Count bytes_ = 0;
};

inline Result<Held> Work::hold(Count bytes) {
  if (auto kept = keep(bytes); !kept) return std::move(kept).error();
  return Held(*this, bytes);
}

// resize() that can be stopped: the first touch of a new page takes the kernel up to 2 us.
template <class Vector>
Result<void> grow(Vector& values, Count size, Work& work, typename Vector::value_type value = {}) {
  constexpr Count kPiece = Count{1} << 16;
  values.reserve(size);
  while (values.size() < size) {
    values.resize(std::min(size, values.size() + kPiece), value);
    if (auto stop = work.spend_bytes(4 * kPiece * sizeof(value))) return *std::move(stop);
  }
  return {};
}

// Calls use(piece) for one piece after the other, until it or the budget says stop. False: `use` did.
template <class T, class F>
Result<bool> for_pieces(std::span<T> values, Work& work, const F& use) {
  constexpr std::size_t kPiece = 16384;  // elements between two looks at the clock
  for (; !values.empty(); values = values.subspan(std::min(values.size(), kPiece))) {
    const auto piece = values.first(std::min(values.size(), kPiece));
    if (auto stop = work.spend(piece.size() / 4)) return *std::move(stop);
    if (!use(piece)) return false;
  }
  return true;
}

// What the allocator adds to a block in the mean: 8 bytes and a rounding up to 16. See growing_memory.h.
inline constexpr Count kBlockBytes = 16;

}  // namespace subdivd::proto::gltf
