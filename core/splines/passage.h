#pragma once
// From the left to the right through a spline that changes on the way: what has been gone through stands in
// an array that grows, what lies ahead in the source. Changes near the place where it stands cost nothing but
// themselves, however long the curve is.

#include <span>
#include <utility>

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/splines/spline.h"

namespace subdivd {

class Passage {
 public:
  // Makes room for `more` knots. `source` and `pace` must outlive it; on the way it may throw Stopped.
  Passage(const Spline& source, Count more, const Pace& pace) : source_(source), pace_(pace) {
    done_.degree = source.degree;
    done_.width = source.width;
    done_.rational = source.rational;
    done_.periodic = source.periodic;
    done_.knots.reserve(source.knots.size() + more);
    done_.points.reserve(source.points.size() + more * source.width);
  }

  // Everything up to the last knot <= t. A knot brings the point of the same number with it.
  void go_to(double t) {
    while (next_ < source_.knots.size() && source_.knots[next_] <= t) move_on();
  }
  // The knots and points gone through: to be changed as one likes, one more or less of both at a time.
  Spline& done() { return done_; }

  // Of the whole curve as it is now.
  Count knot_count() const { return done_.knots.size() + source_.knots.size() - next_; }
  Count point_count() const { return knot_count() - source_.degree - 1; }
  double knot(Count i) const {
    return i < done_.knots.size() ? done_.knots[i] : source_.knots[next_ + i - done_.knots.size()];
  }
  std::span<const double> point(Count i) const {
    return i < done_.point_count() ? done_.point(i) : source_.point(next_ + i - done_.knots.size());
  }

  Spline finish() {
    while (next_ < source_.knots.size()) move_on();
    return std::move(done_);
  }

 private:
  void move_on() {
    pace_.spend(1 + source_.width);
    done_.knots.push_back(source_.knots[next_]);
    if (next_ < source_.point_count()) {
      const std::span<const double> point = source_.point(next_);
      done_.points.insert(done_.points.end(), point.begin(), point.end());
    }
    ++next_;
  }

  const Spline& source_;
  const Pace& pace_;
  Spline done_;
  Count next_ = 0;  // of the source's knots
};

}  // namespace subdivd
