#include "core/curves/curve_step.h"

#include <algorithm>
#include <cstring>

#include "core/curves/corner_cutting.h"
#include "core/curves/four_point.h"
#include "core/curves/lane_riesenfeld.h"

namespace subdivd {
namespace {

constexpr Count kChunkScalars = 384;

template <class Real>
kernels::SplitPoints<Real> kernel_of(const ControlCurves& rule) {
  if (rule.width > kernels::kKernelWidth) return nullptr;
  const kernels::CurveKernels<Real>& all = kernels::curve_kernels<Real>();
  switch (rule.basis) {
    case CurveBasis::four_point:
      return all.four_point[rule.width - 1];
    case CurveBasis::corner_cutting:
      return all.corner_cutting[rule.width - 1];
    default:
      break;
  }
  if (rule.degree > kernels::kKernelDegree) return nullptr;
  return all.lane_riesenfeld[rule.degree - 1][rule.width - 1];
}

template <class Real>
void children(const ControlCurves& rule, const Real* self, Count scalars, Real* first, Real* second) {
  switch (rule.basis) {
    case CurveBasis::four_point:
      return four_point_children(rule.tension, rule.width, self, scalars, first, second);
    case CurveBasis::corner_cutting:
      return corner_cutting_children(rule.ratio, rule.width, self, scalars, first, second);
    default:
      break;
  }
  lane_riesenfeld_children(rule.degree, rule.width, self, scalars, first, second);
}

// first and second child in turn, of `points` points. The width as a constant makes the copies plain moves.
template <Index kWidth, class Real>
void interleave(Index width, Count points, const Real* __restrict first, const Real* __restrict second,
                Real* __restrict to) {
  const Count w = kWidth == 0 ? width : kWidth;
  for (Count i = 0; i < points; ++i, first += w, second += w, to += 2 * w) {
    std::memcpy(to, first, w * sizeof(Real));
    std::memcpy(to + w, second, w * sizeof(Real));
  }
}

template <class Real>
void interleave(Index width, Count points, const Real* first, const Real* second, Real* to) {
  switch (width) {
    case 1:
      return interleave<1>(width, points, first, second, to);
    case 2:
      return interleave<2>(width, points, first, second, to);
    case 3:
      return interleave<3>(width, points, first, second, to);
    case 4:
      return interleave<4>(width, points, first, second, to);
    default:
      return interleave<0>(width, points, first, second, to);
  }
}

}  // namespace

template <class Real>
CurveStep<Real>::CurveStep(const Curve<Real>& curve)
    : curve_(curve),
      kernel_(kernel_of<Real>(*curve.rule)),
      parameter_(curve.rule->basis == CurveBasis::four_point ? curve.rule->tension : curve.rule->ratio),
      chunk_(std::max<Count>(1, kChunkScalars / curve.width)),
      first_(chunk_ * curve.width),
      second_(chunk_ * curve.width) {}

template <class Real>
void CurveStep<Real>::split_in_chunks(const Real* self, Count points, Real* to) {
  const Index width = curve_.width;
  while (points > 0) {
    const Count now = std::min(chunk_, points);
    children(*curve_.rule, self, now * width, first_.data(), second_.data());
    interleave(width, now, first_.data(), second_.data(), to);
    points -= now, self += now * width, to += 2 * now * width;
  }
}

template <class Real>
void CurveStep<Real>::split_all(const Real* self, Count points, Real* to) {
  if (kernel_ != nullptr)
    kernel_(parameter_, self, points, to);
  else
    split_in_chunks(self, points, to);
}

template <class Real>
void CurveStep<Real>::split(const Window<Real>& from, Place children_there, Places wanted, Real* to) {
  const Index width = curve_.width;
  // Child c has the place c - missing; parents are c >> 1, of which the outer ones may give one child only.
  const Place begin = wanted.begin + curve_.missing(), end = wanted.end + curve_.missing();
  const Place first_whole = (begin + 1) >> 1, last_whole = end >> 1;
  const auto only_child = [&](Place child) {
    children(*curve_.rule, from.at(child >> 1, width), width, first_.data(), second_.data());
    const std::vector<Real>& made = child % 2 == 0 ? first_ : second_;
    std::copy_n(made.data(), width, to + static_cast<Count>(child - begin) * width);
  };
  if (begin % 2 != 0) only_child(begin);
  if (first_whole < last_whole)
    split_all(from.at(first_whole, width), static_cast<Count>(last_whole - first_whole),
              to + static_cast<Count>(2 * first_whole - begin) * width);
  if (end % 2 != 0) only_child(end - 1);
  if (!curve_.pinned() || curve_.split.dual) return;
  if (wanted.begin == 0) std::copy_n(curve_.ends.data(), width, to);
  if (wanted.end == children_there)
    std::copy_n(curve_.ends.data() + width, width,
                to + static_cast<Count>(wanted.end - wanted.begin - 1) * width);
}

template class CurveStep<float>;
template class CurveStep<double>;

}  // namespace subdivd
