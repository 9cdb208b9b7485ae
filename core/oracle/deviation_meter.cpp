#include "core/oracle/deviation_meter.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace subdivd::oracle {
namespace {

constexpr double kLargest = std::numeric_limits<double>::max();

double capped(double value) { return value < kLargest ? value : kLargest; }  // NaN and infinity, too

}  // namespace

DeviationMeter::DeviationMeter(std::string quantity, double scale, double tolerance, double segments)
    : scale_(scale), segments_(segments) {
  deviation_.quantity = std::move(quantity);
  deviation_.tolerance = tolerance;
}

void DeviationMeter::add(double relative, const Site& site) {
  const double value = capped(relative);
  const bool first = deviation_.compared == 0;
  ++deviation_.compared;
  sum_of_squares_ += value * value;
  if (!first && value <= deviation_.max_relative) return;
  deviation_.max_relative = value;
  deviation_.worst_vertex = site.vertex;
  deviation_.worst_face = site.place.face;
  deviation_.worst_corner = site.place.corner;
  deviation_.worst_u = site.place.face == kNoIndex ? 0 : site.place.i / segments_;
  deviation_.worst_v = site.place.face == kNoIndex ? 0 : site.place.j / segments_;
}

void DeviationMeter::except(const std::string& reason) {
  ++deviation_.excepted;
  if (deviation_.exception.find(reason) != std::string::npos) return;
  if (!deviation_.exception.empty()) deviation_.exception += "; ";
  deviation_.exception += reason;
}

Deviation DeviationMeter::finish() const {
  Deviation result = deviation_;
  if (result.compared > 0)
    result.rms_relative = capped(std::sqrt(sum_of_squares_ / static_cast<double>(result.compared)));
  result.max_absolute = capped(result.max_relative * scale_);
  result.rms_absolute = capped(result.rms_relative * scale_);
  if (result.compared > 0)
    result.verdict = result.max_relative <= result.tolerance ? Verdict::passed : Verdict::failed;
  return result;
}

}  // namespace subdivd::oracle
