#include "tests/soak/verdict.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>

#include "tests/soak/connection.h"

namespace subdivd::soak {
namespace {

constexpr std::uint64_t kMiB = 1 << 20;
constexpr std::size_t kRows = 20;  // of the printed course

// Resident memory under load swings by the few large requests that happen to run at once, or have just ended:
// medians of two thirds of a minute were 86 and 116 MiB. What is lost is never given back and lifts the ebbs,
// too, so those are compared. A leak of 100 bytes a request is 50 MB in half an hour.
constexpr std::ptrdiff_t kFewestSamples = 10;  // of a third; in less time nothing has become warm
constexpr double kSwing = 0.10;
constexpr std::uint64_t kSwingBytes = 16 * kMiB;
// What an allocator keeps of many threads' pieces once they are all free and the daemon, which first keeps more
// for the next request, has given it back: some seconds later.
constexpr std::uint64_t kKeptBytes = 32 * kMiB;
// The limit is on what is predicted and taken; threads' stacks, sockets' copies and the allocator's rounding
// are beside it.
constexpr double kOverLimit = 1.15;

std::string mib(std::uint64_t bytes) { return std::to_string(bytes / kMiB) + " MiB"; }

std::uint64_t value(const Counters& counters, const std::string& name) {
  const auto found = counters.find(name);
  return found == counters.end() ? 0 : found->second;
}

// Names whose value at rest must be what it was at the start: `*_free`, and what counts things under way.
bool is_given_back(const std::string& name) {
  return name.ends_with("_free") || name == "waiting" || name == "connections" || name == "busy";
}

bool at_rest(const Counters& counters) {
  for (const auto& [name, number] : counters) {
    if (!is_given_back(name)) continue;
    const bool free = name.ends_with("_free");
    if (number != (free ? value(counters, name.substr(0, name.size() - 4) + "total") : 0)) return false;
  }
  return true;
}

// A quarter of the samples are below.
std::uint64_t resident_at_ebb(std::vector<Sample>::const_iterator begin,
                              std::vector<Sample>::const_iterator end) {
  std::vector<std::uint64_t> values;
  for (; begin != end; ++begin) values.push_back(begin->footprint.resident);
  const auto quarter = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 4);
  std::nth_element(values.begin(), quarter, values.end());
  return *quarter;
}

}  // namespace

void Verdict::check(const std::string& what, bool holds, const std::string& detail) {
  lines_.push_back({what, detail, holds});
  good_ = good_ && holds;
}

void Verdict::print() const {
  for (const Line& line : lines_)
    std::printf("%-6s %-44s %s\n", line.holds ? "ok" : "FAILED", line.what.c_str(), line.detail.c_str());
}

Rest settle(Daemon& daemon, const Rest* start) {
  const Clock::time_point deadline = Clock::now() + std::chrono::seconds(start == nullptr ? 5 : 30);
  Rest now;
  do {
    std::this_thread::sleep_for(milliseconds(500));
    now = {daemon.footprint(), daemon.counters()};
    const bool kernel = start == nullptr || (now.footprint.descriptors <= start->footprint.descriptors &&
                                             now.footprint.threads <= start->footprint.threads);
    const bool memory = start == nullptr || now.footprint.resident <= start->footprint.resident + kKeptBytes;
    if (kernel && memory && now.counters && at_rest(*now.counters)) break;
  } while (Clock::now() < deadline && daemon.alive());
  return now;
}

void judge_counters(Verdict& verdict, const Rest& start, const Rest& end) {
  if (!start.counters || !end.counters) {
    verdict.check("the daemon tells its counters on SIGUSR1", false, "no line `state memory_total=…`");
    return;
  }
  for (const auto& [name, before] : *start.counters) {
    if (!is_given_back(name)) continue;
    const std::uint64_t after = value(*end.counters, name);
    verdict.check(name + " is back to its start", before == after,
                  std::to_string(before) + ", then " + std::to_string(after));
  }
  verdict.check("everything is free at rest", at_rest(*end.counters), "");
}

void judge_kernel(Verdict& verdict, const Rest& start, const Rest& end) {
  const Footprint &before = start.footprint, &after = end.footprint;
  verdict.check("descriptors are back to their start", after.descriptors <= before.descriptors,
                std::to_string(before.descriptors) + ", then " + std::to_string(after.descriptors));
  verdict.check("threads are back to their start", after.threads <= before.threads,
                std::to_string(before.threads) + ", then " + std::to_string(after.threads));
}

void judge_memory(Verdict& verdict, const std::vector<Sample>& samples, const Rest& start, const Rest& end) {
  const auto warm = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 6);
  const std::ptrdiff_t third = (samples.end() - warm) / 3;
  if (third >= kFewestSamples) {
    const std::uint64_t first = resident_at_ebb(warm, warm + third);
    const std::uint64_t last = resident_at_ebb(samples.end() - third, samples.end());
    const auto allowed = static_cast<std::uint64_t>(static_cast<double>(first) * (1 + kSwing)) + kSwingBytes;
    verdict.check("resident memory is flat under load", last <= allowed,
                  "first third " + mib(first) + ", last third " + mib(last) + ", allowed " + mib(allowed));
  }
  const std::uint64_t before = start.footprint.resident, after = end.footprint.resident;
  verdict.check("resident memory comes back at rest", after <= before + kKeptBytes,
                mib(before) + ", then " + mib(after) + ", allowed " + mib(before + kKeptBytes));
}

void judge_peak(Verdict& verdict, std::uint64_t limit, const Rest& start, const Rest& end) {
  const std::uint64_t allowed =
      start.footprint.resident + static_cast<std::uint64_t>(static_cast<double>(limit) * kOverLimit);
  verdict.check("the peak stays within the limit + 15 %", end.footprint.peak_resident <= allowed,
                mib(end.footprint.peak_resident) + ", allowed " + mib(allowed) + " (" +
                    mib(start.footprint.resident) + " of them at the start)");
}

void print_samples(const std::vector<Sample>& samples) {
  std::printf("%9s%12s%9s%13s%14s%12s%9s%13s%9s\n", "second", "resident", "threads", "descriptors",
              "memory free", "places free", "waiting", "connections", "busy");
  const std::size_t step = std::max<std::size_t>(1, (samples.size() + kRows - 1) / kRows);
  for (std::size_t i = 0; i < samples.size(); i += step) {
    const Sample& sample = samples[i];
    std::printf("%9.0f%12s%9zu%13zu", sample.seconds, mib(sample.footprint.resident).c_str(),
                sample.footprint.threads, sample.footprint.descriptors);
    if (sample.counters) {
      const Counters& counters = *sample.counters;
      std::printf("%14s", mib(value(counters, "memory_free")).c_str());
      for (const auto& [name, width] :
           {std::pair{"places_free", 12}, {"waiting", 9}, {"connections", 13}, {"busy", 9}})
        std::printf("%*llu", width, static_cast<unsigned long long>(value(counters, name)));
    }
    std::printf("\n");
  }
}

}  // namespace subdivd::soak
