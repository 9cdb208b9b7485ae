#pragma once
// What came back, counted; and what must not have come back, kept for the report.

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "tests/soak/connection.h"

namespace subdivd::soak {

class Tally {
 public:
  // An answer that had to have one of these statuses.
  void answered(const std::string& kind, const Answer& answer, const std::vector<int>& statuses);
  // Equal requests have equal answers: `request` tells requests apart.
  void compare(const std::string& kind, std::uint64_t request, const Answer& answer);
  void small_took(const std::string& kind, double took);  // milliseconds
  // Something that is counted and expects no answer.
  void did(const std::string& kind);
  void fault(const std::string& text);

  std::size_t total() const;
  std::size_t fault_count() const;
  void print() const;

 private:
  void keep(const std::string& text);

  mutable std::mutex mutex_;
  std::map<std::string, std::map<int, std::size_t>> counts_;  // by kind and status; -1: no answer was wanted
  std::map<std::pair<std::uint64_t, int>, std::uint64_t> bodies_;  // by request and status: the digest
  std::map<std::string, std::vector<float>> latencies_;
  std::size_t total_ = 0, faults_ = 0;
  std::map<std::string, std::size_t> texts_;  // of faults, and how often
};

}  // namespace subdivd::soak
