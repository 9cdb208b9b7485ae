#include "server/tasks/phases.h"

#include <array>
#include <cstdio>

namespace subdivd::server::tasks {

void Phases::end(std::string_view name) {
  const Clock::time_point now = Clock::now();
  std::array<char, 32> duration{};
  std::snprintf(duration.data(), duration.size(), ";dur=%.3f",
                std::chrono::duration<double, std::milli>(now - began_).count());
  if (!header_.empty()) header_ += ", ";
  header_ += name;
  header_ += duration.data();
  began_ = now;
}

}  // namespace subdivd::server::tasks
