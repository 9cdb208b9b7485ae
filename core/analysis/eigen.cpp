#include "core/analysis/eigen.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

#include "core/analysis/eigen_values.h"
#include "core/analysis/eigen_vectors.h"
#include "core/analysis/matrix.h"

namespace subdivd {
namespace {

Error not_real(std::complex<double> value) {
  return Error{ErrorCode::unsupported,
               "the matrix has complex eigenvalues, such as " + std::to_string(value.real()) + " + " +
                   std::to_string(std::abs(value.imag())) + " i; only real ones are supported"};
}

Error not_separable(double value) {
  return Error{
      ErrorCode::unsupported,
      "the eigenvalue " + std::to_string(value) +
          " has fewer than half as many eigenvectors as it stands times: Jordan blocks of more than two "
          "rows are not supported"};
}

// Appends the spaces of values[begin, end), which are sorted by their real parts and closer to each other
// than `apart`. A Jordan block of two rows scatters its eigenvalue by the root of the rounding errors, also
// into complex pairs; simple eigenvalues may lie closer to each other than that. So first all of them are
// tried as one, and where that is none they are divided at their widest gaps.
std::optional<Error> append_spaces(const Reduced& m, std::span<const std::complex<double>> values,
                                   double apart, std::vector<EigenSpace>& spaces) {
  const Index count = static_cast<Index>(values.size());
  double mean = 0, imaginary = 0;
  std::complex<double> worst;
  for (const auto& value : values) {
    mean += value.real() / count;
    if (std::abs(value.imag()) > imaginary) worst = value, imaginary = std::abs(value.imag());
  }
  if (imaginary <= apart) {
    Result<std::optional<EigenSpace>> space = space_at(m, mean, count);
    if (!space) return space.error();
    if (*space) return spaces.push_back(std::move(**space)), std::nullopt;
  }
  const double closer = apart / 8;
  if (count == 1 || closer < kEpsilon * m.norm)
    return imaginary > 0 ? not_real(worst * m.scale) : not_separable(mean * m.scale);
  for (std::size_t begin = 0; begin < values.size();) {
    std::size_t end = begin + 1;
    while (end < values.size() && values[end].real() - values[end - 1].real() <= closer) ++end;
    if (auto fault = append_spaces(m, values.subspan(begin, end - begin), closer, spaces)) return fault;
    begin = end;
  }
  return std::nullopt;
}

Result<void> check(std::span<const double> matrix, Index size) {
  if (size == 0) return Error{ErrorCode::out_of_range, "a matrix needs at least one row"};
  if (size > kMaxEigenSize)
    return Error{.code = ErrorCode::too_large,
                 .message = "a matrix of " + std::to_string(size) + " rows is too large; " +
                            std::to_string(kMaxEigenSize) + " are allowed",
                 .predicted = size,
                 .allowed = kMaxEigenSize};
  if (matrix.size() != std::size_t{size} * size)
    return Error{ErrorCode::wrong_length, "a matrix of " + std::to_string(size) +
                                              " rows has as many columns; there are " +
                                              std::to_string(matrix.size()) + " numbers"};
  for (std::size_t k = 0; k < matrix.size(); ++k)
    if (!std::isfinite(matrix[k]))
      return Error{ErrorCode::not_finite, "an entry of the matrix is not a finite number", {k}};
  return {};
}

}  // namespace

Result<EigenSystem> eigen_system(std::span<const double> matrix, Index size, const Budget& budget) {
  if (auto checked = check(matrix, size); !checked) return checked.error();
  double largest = 0;
  for (const double x : matrix) largest = std::max(largest, std::abs(x));
  const double scale = largest == 0 ? 1 : std::exp2(std::floor(std::log2(largest)));
  Matrix balanced{size, Vector(matrix.begin(), matrix.end())};
  for (double& x : balanced.a) x /= scale;
  const Vector diagonal = balance(balanced);
  Matrix h = balanced, q;
  if (auto stop = to_hessenberg(h, q, budget)) return *stop;
  auto values = eigenvalues(h, budget);
  if (!values) return values.error();
  std::sort(values->begin(), values->end(), [](const auto& a, const auto& b) {
    return a.real() != b.real() ? a.real() < b.real() : a.imag() < b.imag();
  });
  const double norm = norm_of(h) == 0 ? 1 : norm_of(h);
  const Reduced reduced{balanced, diagonal, q, h, scale, norm, (64 + size) * kEpsilon * norm, budget};
  EigenSystem system{size, {}};
  // Roots of rounding errors are about 1e-8; what is farther apart than 64 times that is distinct.
  const double apart = 1e-6 * norm;
  for (std::size_t begin = 0; begin < values->size();) {
    std::size_t end = begin + 1;
    while (end < values->size() && (*values)[end].real() - (*values)[end - 1].real() <= apart) ++end;
    const auto group = std::span(*values).subspan(begin, end - begin);
    if (auto fault = append_spaces(reduced, group, apart, system.spaces)) return *fault;
    begin = end;
  }
  for (EigenSpace& space : system.spaces) {
    space.value *= scale;
    if (!std::isfinite(space.value))
      return Error{ErrorCode::out_of_range, "an eigenvalue is too large for a double"};
  }
  std::stable_sort(system.spaces.begin(), system.spaces.end(), [](const EigenSpace& a, const EigenSpace& b) {
    return std::abs(a.value) != std::abs(b.value) ? std::abs(a.value) > std::abs(b.value) : a.value > b.value;
  });
  return system;
}

}  // namespace subdivd
