#include "server/transport/descriptors.h"

#include <sys/resource.h>

#include <algorithm>

namespace subdivd::server {
namespace {

constexpr std::size_t kDefaultConnections = 10'000;
constexpr std::size_t kReserve = 64;

}  // namespace

std::size_t allow_connections(std::size_t wanted) {
  if (wanted == 0) wanted = kDefaultConnections;
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return wanted;
  const rlim_t needed = std::min<rlim_t>(limit.rlim_max, wanted + kReserve);
  if (limit.rlim_cur < needed) {
    rlimit raised = limit;
    raised.rlim_cur = needed;
    if (::setrlimit(RLIMIT_NOFILE, &raised) == 0) limit = raised;
  }
  const std::size_t descriptors = limit.rlim_cur;
  // With very few descriptors half of them are the reserve.
  return std::min(wanted, std::max(descriptors / 2, descriptors - std::min(descriptors, kReserve)));
}

}  // namespace subdivd::server
