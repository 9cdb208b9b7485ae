#pragma once
// Exact numbers for small cases: a numerator and a denominator of 128 bits, always reduced. Overflow is not
// looked for; keep the cases small.

#include <numeric>

namespace subdivd {

class Fraction {
 public:
  __extension__ using Whole = __int128;
  Fraction(long long whole = 0) : top_(whole) {}  // NOLINT: implicit by design
  Fraction(Whole top, Whole bottom) : top_(top), bottom_(bottom) { reduce(); }

  explicit operator double() const {
    return static_cast<double>(static_cast<long double>(top_) / static_cast<long double>(bottom_));
  }

  friend Fraction operator+(const Fraction& a, const Fraction& b) {
    return {a.top_ * b.bottom_ + b.top_ * a.bottom_, a.bottom_ * b.bottom_};
  }
  friend Fraction operator-(const Fraction& a, const Fraction& b) {
    return {a.top_ * b.bottom_ - b.top_ * a.bottom_, a.bottom_ * b.bottom_};
  }
  friend Fraction operator*(const Fraction& a, const Fraction& b) {
    return {a.top_ * b.top_, a.bottom_ * b.bottom_};
  }
  friend Fraction operator/(const Fraction& a, const Fraction& b) {
    return {a.top_ * b.bottom_, a.bottom_ * b.top_};
  }
  friend bool operator==(const Fraction& a, const Fraction& b) {
    return a.top_ == b.top_ && a.bottom_ == b.bottom_;
  }
  friend bool operator<(const Fraction& a, const Fraction& b) {
    return a.top_ * b.bottom_ < b.top_ * a.bottom_;
  }

 private:
  void reduce() {
    Whole a = top_ < 0 ? -top_ : top_, b = bottom_ < 0 ? -bottom_ : bottom_;
    while (b != 0) {
      const Whole rest = a % b;
      a = b;
      b = rest;
    }
    if (bottom_ < 0) a = -a;
    top_ /= a;
    bottom_ /= a;
  }
  Whole top_ = 0, bottom_ = 1;
};

}  // namespace subdivd
