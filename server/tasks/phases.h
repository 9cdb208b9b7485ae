#pragma once
// How long the phases of a request took, for the Server-Timing header: bodies hold no times, so that equal requests
// have equal answers.

#include <chrono>
#include <string>
#include <string_view>

namespace subdivd::server::tasks {

class Phases {
 public:
  // What has passed since the last phase ended (or since construction) was the phase `name`.
  void end(std::string_view name);
  // "read;dur=0.063, refine;dur=0.049", in milliseconds, as https://www.w3.org/TR/server-timing has it.
  const std::string& header() const { return header_; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point began_ = Clock::now();
  std::string header_;
};

}  // namespace subdivd::server::tasks
