#include "tests/soak/tally.h"

#include <algorithm>
#include <cstdio>
#include <set>
#include <utility>

namespace subdivd::soak {
namespace {

constexpr std::size_t kMostTexts = 40;

// Texts of a terminal: what a broken answer holds may be anything.
std::string printable(std::string text) {
  for (char& c : text)
    if (c < ' ' || c > '~') c = '.';
  return text;
}

double percentile(const std::vector<float>& sorted, double share) {
  const auto at = static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1));
  return static_cast<double>(sorted[at]);
}

std::string column_name(int status) {
  if (status < 0) return "sent";
  return status == 0 ? "none" : std::to_string(status);
}

}  // namespace

void Tally::keep(const std::string& text) {
  ++faults_;
  std::string shown = printable(text);
  if (texts_.contains(shown) || texts_.size() < kMostTexts) ++texts_[std::move(shown)];
}

void Tally::answered(const std::string& kind, const Answer& answer, const std::vector<int>& statuses) {
  const std::lock_guard lock(mutex_);
  ++total_;
  ++counts_[kind][answer.status];
  if (std::find(statuses.begin(), statuses.end(), answer.status) != statuses.end()) return;
  std::string wanted;
  for (const int status : statuses) wanted += (wanted.empty() ? "" : " or ") + std::to_string(status);
  keep(kind + ": status " + std::to_string(answer.status) + " instead of " + wanted + ": " +
       answer.beginning);
}

void Tally::compare(const std::string& kind, std::uint64_t request, const Answer& answer) {
  const std::lock_guard lock(mutex_);
  const auto [first, is_new] = bodies_.try_emplace({request, answer.status}, answer.digest);
  if (!is_new && first->second != answer.digest)
    keep(kind + ": the same request with another body, status " + std::to_string(answer.status));
}

void Tally::small_took(const std::string& kind, double took) {
  const std::lock_guard lock(mutex_);
  latencies_[kind].push_back(static_cast<float>(took));
}

void Tally::did(const std::string& kind) {
  const std::lock_guard lock(mutex_);
  ++total_;
  ++counts_[kind][-1];
}

void Tally::fault(const std::string& text) {
  const std::lock_guard lock(mutex_);
  keep(text);
}

std::size_t Tally::total() const {
  const std::lock_guard lock(mutex_);
  return total_;
}

std::size_t Tally::fault_count() const {
  const std::lock_guard lock(mutex_);
  return faults_;
}

void Tally::print() const {
  const std::lock_guard lock(mutex_);
  std::set<int> statuses;
  for (const auto& [kind, by_status] : counts_)
    for (const auto& [status, count] : by_status) statuses.insert(status);
  std::printf("%-36s", "requests");
  for (const int status : statuses) std::printf("%9s", column_name(status).c_str());
  std::printf("\n");
  for (const auto& [kind, by_status] : counts_) {
    std::printf("%-36s", kind.c_str());
    for (const int status : statuses) {
      const auto found = by_status.find(status);
      std::printf("%9s", found == by_status.end() ? "" : std::to_string(found->second).c_str());
    }
    std::printf("\n");
  }
  std::printf("\n%-36s%9s%9s%9s%9s%9s\n", "milliseconds", "50 %", "90 %", "99 %", "99.9 %", "most");
  for (const auto& [kind, unsorted] : latencies_) {
    std::vector<float> sorted = unsorted;
    std::sort(sorted.begin(), sorted.end());
    std::printf("%-36s", kind.c_str());
    for (const double share : {0.5, 0.9, 0.99, 0.999, 1.0}) std::printf("%9.1f", percentile(sorted, share));
    std::printf("\n");
  }
  if (faults_ == 0) return;
  std::printf("\n%zu faults, among them:\n", faults_);
  for (const auto& [text, count] : texts_) std::printf("%9zu  %s\n", count, text.c_str());
}

}  // namespace subdivd::soak
