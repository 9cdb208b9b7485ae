#pragma once
// Adds up the deviations of one quantity.

#include <string>

#include "core/oracle/report.h"
#include "core/refine/refined_mesh.h"

namespace subdivd::oracle {

// Where a value stands on our side.
struct Site {
  Index vertex = kNoIndex;
  Provenance place;
};

class DeviationMeter {
 public:
  // `scale`: what relative deviations are measured by; `segments`: of a base edge at this level.
  DeviationMeter(std::string quantity, double scale, double tolerance, double segments);

  // One value's deviation, divided by the scale. Not a number counts as the largest double: what cannot be
  // compared has failed.
  void add(double relative, const Site& site);
  // One value left out for a documented reason.
  void except(const std::string& reason);

  Deviation finish() const;

 private:
  Deviation deviation_;
  double scale_, segments_;
  double sum_of_squares_ = 0;
};

}  // namespace subdivd::oracle
