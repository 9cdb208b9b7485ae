#include "core/curves/curve_step.h"

#include <algorithm>
#include <cstring>

namespace subdivd {
namespace {

constexpr Count kChunkScalars = 384;

// The loop for a scheme, null where there is none, and the parameter that it takes.
template <class Real>
struct Kernel {
  kernels::SplitPoints<Real> split = nullptr;
  double parameter = 0;
};

template <class Real>
Kernel<Real> kernel_of(const UniformBSpline& kind, const kernels::CurveKernels<Real>& all, Index width) {
  if (kind.degree > kernels::kKernelDegree) return {};
  return {all.lane_riesenfeld[kind.degree - 1][width - 1], 0};
}

template <class Real>
Kernel<Real> kernel_of(const FourPoint& kind, const kernels::CurveKernels<Real>& all, Index width) {
  return {all.four_point[width - 1], kind.tension};
}

template <class Real>
Kernel<Real> kernel_of(const CornerCutting& kind, const kernels::CurveKernels<Real>& all, Index width) {
  return {all.corner_cutting[width - 1], kind.ratio};
}

template <class Real>
Kernel<Real> kernel_of(const ControlCurves& rule) {
  if (rule.width > kernels::kKernelWidth) return {};
  return visit_scheme(rule.basis, [&](const auto& kind) {
    return kernel_of<Real>(kind, kernels::curve_kernels<Real>(), rule.width);
  });
}

template <class Real>
void make_children(const ControlCurves& rule, const Real* self, Count scalars, Real* first, Real* second) {
  visit_scheme(rule.basis,
               [&](const auto& kind) { kind.children(rule.width, self, scalars, first, second); });
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
      chunk_(std::max<Count>(1, kChunkScalars / curve.width)),
      first_(chunk_ * curve.width),
      second_(chunk_ * curve.width) {
  const Kernel<Real> kernel = kernel_of<Real>(*curve.rule);
  kernel_ = kernel.split;
  parameter_ = kernel.parameter;
}

template <class Real>
void CurveStep<Real>::split_in_chunks(const Real* self, Count points, Real* to) {
  const Index width = curve_.width;
  while (points > 0) {
    const Count now = std::min(chunk_, points);
    make_children(*curve_.rule, self, now * width, first_.data(), second_.data());
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
    make_children(*curve_.rule, from.at(child >> 1, width), width, first_.data(), second_.data());
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
