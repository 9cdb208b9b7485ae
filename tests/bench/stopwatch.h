#pragma once

#include <chrono>

namespace subdivd::bench {

class Stopwatch {
 public:
  // Milliseconds since the last call, or since the stopwatch was made.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double elapsed = std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
    return elapsed;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace subdivd::bench
