#pragma once
// What was measured, and the one table of what is made of it: rows, their units, the ratios and which way
// round they are.

#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace subdivd::bench {

class Results {
 public:
  // A measurement of `quantity` (a key of the table in results.cpp) on `cell` (a workload, or
  // workload.Llevel). who: "ours", "Far", "CGAL", "OpenMesh", "memset", "memcpy", "base" (what the row's
  // label says), "floor" or "loopback".
  void add(const std::string& cell, const std::string& quantity, const std::string& who, double value);
  std::optional<double> median(const std::string& cell, const std::string& quantity,
                               const std::string& who) const;
  void forget(const std::string& cell);

  // One line per cell and quantity; the ratios stand in the last columns.
  void print(std::ostream& out) const;
  // {"ratios": {"<row>.<cell>": number}}
  void write_json(std::ostream& out) const;

 private:
  using Samples = std::map<std::string, std::vector<double>>;  // by who
  struct Cell {
    std::string name;
    std::map<std::string, Samples> quantities;
  };
  const Cell* find(const std::string& cell) const;

  std::vector<Cell> cells_;  // in the order of their first measurement
};

}  // namespace subdivd::bench
