#include "tests/bench/results.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>

namespace subdivd::bench {
namespace {

// A line of the table.
struct Quantity {
  std::string_view key, label, unit;
};

constexpr std::array kQuantities = {
    Quantity{"plan", "plan / create / mesh", "ms"},
    Quantity{"refine", "refine, connectivity", "ms"},
    Quantity{"evaluate", "evaluate / interpolate", "ms"},
    Quantity{"indices", "indices / extract", "ms"},
    Quantity{"total", "total", "ms"},
    Quantity{"limits", "limits and frame, added", "ms"},
    Quantity{"normals", "normals of the tangents", "ms"},
    Quantity{"total_limits", "total with limits", "ms"},
    Quantity{"again", "again (base: CpuEvaluator)", "ns/vertex"},
    Quantity{"threads", "2 threads, plan kept", "ms"},
    Quantity{"total_threads", "2 threads, total", "ms"},
    Quantity{"memory", "memory beyond the output", "% of it"},
    Quantity{"plan_alone", "plan / create", "ms"},
    Quantity{"http", "GLB over HTTP (base: core)", "ms"},
    Quantity{"request", "request, 1 thread (base: warm)", "ms"},
    Quantity{"request_threads", "request, all threads (warm)", "ms"},
    Quantity{"request_read", "request, 1 thread, read (warm)", "ms"},
    Quantity{"in_process", "request without HTTP (warm)", "ms"},
};

// A ratio: rival's figure over ours ("x", bigger is better) or ours over the rival's ("/", smaller is
// better).
struct Ratio {
  std::string_view row, quantity, rival;
  bool ours_first;
};

constexpr std::array kRatios = {
    Ratio{"total_vs_far", "total", "Far", false},
    Ratio{"total_vs_memset", "total", "memset", true},
    Ratio{"total_vs_half_edges", "total", "half-edges", false},
    Ratio{"reevaluate_vs_stencils", "again", "Far", false},
    Ratio{"reevaluate_vs_floor", "again", "floor", true},
    Ratio{"plan_vs_far_create", "plan_alone", "Far", false},
    Ratio{"limit_vs_far", "limits", "Far", false},
    Ratio{"limit_vs_floor", "limits", "floor", true},
    Ratio{"threads2_vs_1", "threads", "base", false},
    Ratio{"http_vs_core", "http", "base", true},
    Ratio{"request_vs_warm", "request", "base", true},
    Ratio{"request_threads_vs_warm", "request_threads", "base", true},
    Ratio{"request_read_vs_warm", "request_read", "base", true},
    Ratio{"in_process_vs_warm", "in_process", "base", true},
};

constexpr std::array<std::string_view, 10> kContestants = {
    "ours", "Far", "CGAL", "OpenMesh", "half-edges", "memset", "memcpy", "base", "floor", "loopback"};
constexpr std::array<std::string_view, 7> kRivals = {"Far",    "CGAL", "OpenMesh", "half-edges",
                                                     "memset", "base", "floor"};

// Phases are cut differently in every library: only what all of them do as a whole is compared.
bool is_compared(std::string_view quantity) {
  return quantity != "plan" && quantity != "evaluate" && quantity != "indices";
}

bool is_ours_first(std::string_view quantity, std::string_view rival) {
  return rival == "memset" || rival == "floor" || quantity == "http" || quantity == "memory" ||
         quantity.starts_with("request") || quantity == "in_process";
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

std::string three_digits(double value) {
  std::array<char, 32> text{};
  const int decimals = value < 10 ? 3 : value < 100 ? 2 : value < 1000 ? 1 : 0;
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

std::string padded(std::string_view text, std::size_t width, bool right) {
  std::string out(text);
  if (out.size() < width) out.insert(right ? 0 : out.size(), width - out.size(), ' ');
  return out;
}

void print_heading(std::ostream& out) {
  out << "\nMedians, one thread unless a line says otherwise. Ratios: xN = the other takes N times as long "
         "as we do\n"
         "(bigger is better); /N = we take N times as long as the other (smaller is better). base: see the "
         "line's name.\n"
         "In JSON: *_vs_far, *_vs_stencils, *_vs_far_create, threads2_vs_1 are xN; total_vs_memset, "
         "*_vs_floor, http_vs_core are /N;\n"
         "memory_vs_output is a share (0.15 = 15 %).\n\n";
  out << padded("workload", 17, false) << padded("quantity", 32, false) << padded("unit", 10, false);
  for (const std::string_view who : kContestants) out << padded(who, 11, true);
  out << "  ";
  for (const std::string_view rival : kRivals)
    out << padded(std::string("vs ") + std::string(rival), 12, true);
  out << '\n';
}

}  // namespace

void Results::add(const std::string& cell, const std::string& quantity, const std::string& who,
                  double value) {
  auto found = std::ranges::find(cells_, cell, &Cell::name);
  if (found == cells_.end()) found = cells_.insert(found, Cell{cell, {}});
  found->quantities[quantity][who].push_back(value);
}

void Results::forget(const std::string& cell) {
  std::erase_if(cells_, [&](const Cell& other) { return other.name == cell; });
}

const Results::Cell* Results::find(const std::string& cell) const {
  const auto found = std::ranges::find(cells_, cell, &Cell::name);
  return found == cells_.end() ? nullptr : &*found;
}

std::optional<double> Results::median(const std::string& cell, const std::string& quantity,
                                      const std::string& who) const {
  const Cell* found = find(cell);
  if (found == nullptr) return std::nullopt;
  const auto samples = found->quantities.find(quantity);
  if (samples == found->quantities.end()) return std::nullopt;
  const auto values = samples->second.find(who);
  if (values == samples->second.end()) return std::nullopt;
  return median_of(values->second);
}

void Results::print(std::ostream& out) const {
  print_heading(out);
  for (const Cell& cell : cells_)
    for (const Quantity& quantity : kQuantities) {
      const std::string key(quantity.key);
      if (!cell.quantities.contains(key)) continue;
      const auto ours = median(cell.name, key, "ours");
      out << padded(cell.name, 17, false) << padded(quantity.label, 32, false)
          << padded(quantity.unit, 10, false);
      for (const std::string_view who : kContestants) {
        const auto value = median(cell.name, key, std::string(who));
        out << padded(value ? three_digits(*value) : "", 10, true);
      }
      out << "  ";
      for (const std::string_view rival : kRivals) {
        const auto theirs = median(cell.name, key, std::string(rival));
        std::string text;
        if (ours && theirs && is_compared(key))
          text = is_ours_first(key, rival) ? "/" + three_digits(*ours / *theirs)
                                           : "x" + three_digits(*theirs / *ours);
        out << padded(text, 12, true);
      }
      out << '\n';
    }
}

void Results::write_json(std::ostream& out) const {
  std::vector<std::pair<std::string, double>> ratios;
  for (const Cell& cell : cells_) {
    for (const Ratio& ratio : kRatios) {
      const auto ours = median(cell.name, std::string(ratio.quantity), "ours");
      const auto theirs = median(cell.name, std::string(ratio.quantity), std::string(ratio.rival));
      if (ours && theirs && *ours > 0 && *theirs > 0)
        ratios.emplace_back(std::string(ratio.row) + "." + cell.name,
                            ratio.ours_first ? *ours / *theirs : *theirs / *ours);
    }
    if (const auto share = median(cell.name, "memory", "ours"))
      ratios.emplace_back("memory_vs_output." + cell.name, *share / 100);
  }
  out << "{\"ratios\": {";
  for (std::size_t k = 0; k < ratios.size(); ++k)
    out << (k == 0 ? "\n  \"" : ",\n  \"") << ratios[k].first << "\": " << ratios[k].second;
  out << "\n}}\n";
}

}  // namespace subdivd::bench
