// What every scheme of the list must obey, mask by mask. A scheme joins by being in the list.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>
#include <vector>

#include "core/mesh/sharpness.h"
#include "core/schemes/all.h"

namespace subdivd {
namespace {

const std::vector<Index> kValences{2, 3, 4, 5, 6, 7, 8, 12, 100, 1000};

template <class Tuple>
struct AsTypes;
template <class... S>
struct AsTypes<std::tuple<S...>> {
  using type = ::testing::Types<S...>;
};

template <class S>
class MaskProperties : public ::testing::Test {
 protected:
  // The scheme with each word of each of its options.
  std::vector<S> variants() const {
    std::vector<S> all = {S{}};
    for (const SchemeOption<S>& option : S::options())
      for (std::size_t word = 1; word < option.words.size(); ++word) option.set(all.emplace_back(), word);
    return all;
  }
};
TYPED_TEST_SUITE(MaskProperties, AsTypes<AllGridSchemes>::type);

// Room for the rounding of a sum of n weights.
double rounding(Index n) { return 4e-15 + 2e-16 * n; }

template <class S>
constexpr bool kHasFaces = S::split == Split::quads;
// Sharpness plays no part.
template <class S>
constexpr bool kIsLinear = std::is_same_v<S, Bilinear>;

double sum_of(const VertexMask& mask, Index n) {
  return mask.self + n * mask.each + 2 * mask.crease + n * mask.face;
}

// The subdivision matrix of a ring: row 0 the vertex, row 1 + k ring edge k, and where faces are quads row 1 + edges + k
// the vertex opposite in face k, between the edges k and k + 1; from the scheme's own masks.
// `sharp`: which edges are infinitely sharp; open rings end with a border at both ends.
using Matrix = std::vector<std::vector<double>>;
template <class S>
Matrix ring_matrix(const S& scheme, Index edges, const std::vector<Index>& sharp, bool open) {
  std::vector<float> sharpness(edges, 0.0f);
  for (Index k : sharp) sharpness[k] = kInfiniteSharpness;
  const Index faces = open ? edges - 1 : edges, size = 1 + edges + (kHasFaces<S> ? faces : 0);
  Matrix m(size, std::vector<double>(size, 0.0));
  const auto add_face_point = [&](std::vector<double>& row, Index face, double weight) {
    for (const Index at : {Index{0}, 1 + face, 1 + (face + 1) % edges, 1 + edges + face})
      row[at] += weight / 4;
  };
  const VertexMask v = scheme.vertex_mask({faces, CreaseMethod::uniform, 0, 0, sharpness, sharpness});
  m[0][0] = v.self;
  for (Index k = 0; k < edges; ++k) m[0][1 + k] = v.each;
  if (v.crease != 0)
    for (Index end : v.crease_ends) m[0][1 + end] += v.crease;
  if constexpr (kHasFaces<S>)
    for (Index f = 0; f < faces; ++f) {
      add_face_point(m[0], f, v.face);
      add_face_point(m[1 + edges + f], f, 1);
    }
  for (Index k = 0; k < edges; ++k) {
    std::vector<Index> beside;  // faces
    if (!open || k + 1 < edges) beside.push_back(k);
    if (!open || k > 0) beside.push_back((k + edges - 1) % edges);
    const float s = sharpness[k];
    const EdgeMask e = scheme.edge_mask({static_cast<Index>(beside.size()), s, {s, s}});
    m[1 + k][0] += e.end;
    m[1 + k][1 + k] += e.end;
    for (Index f : beside) {
      if constexpr (kHasFaces<S>)
        add_face_point(m[1 + k], f, e.face);
      else
        m[1 + k][1 + (f == k ? (k + 1) % edges : f)] += e.opposite;
    }
  }
  return m;
}

std::vector<double> row_times(const std::vector<double>& row, const Matrix& m) {
  std::vector<double> out(row.size(), 0.0);
  for (std::size_t i = 0; i < row.size(); ++i)
    for (std::size_t j = 0; j < row.size(); ++j) out[j] += row[i] * m[i][j];
  return out;
}

std::vector<double> as_row(const RingMask& mask) {
  std::vector<double> row{mask.self};
  row.insert(row.end(), mask.edges.begin(), mask.edges.end());
  row.insert(row.end(), mask.faces.begin(), mask.faces.end());
  return row;
}

// `faces`: those of the ring, where the scheme makes quads.
std::vector<double> as_row(const VertexMask& mask, Index edges, Index faces) {
  std::vector<double> row(edges + 1, mask.each);
  row[0] = mask.self;
  for (Index end : mask.crease_ends) row[1 + end] += mask.crease;
  row.insert(row.end(), faces, mask.face);
  return row;
}

// row * m == lambda * row, to `tolerance` of the largest weight.
void expect_left_eigenvector(const std::vector<double>& row, const Matrix& m, double lambda,
                             double tolerance) {
  const std::vector<double> out = row_times(row, m);
  double largest = 0;
  for (double x : row) largest = std::max(largest, std::abs(x));
  for (std::size_t k = 0; k < row.size(); ++k)
    ASSERT_NEAR(out[k], lambda * row[k], tolerance * largest) << "weight " << k << " of " << row.size();
}

// The eigenvalue that a left eigenvector claims, from its largest weight.
double eigenvalue_of(const std::vector<double>& row, const Matrix& m) {
  const auto at =
      std::max_element(row.begin(), row.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  return row_times(row, m)[static_cast<std::size_t>(at - row.begin())] / *at;
}

TYPED_TEST(MaskProperties, position_weights_sum_to_one) {
  for (const TypeParam& scheme : this->variants())
    for (Index n : kValences) {
      for (float s : {0.0f, 0.3f, 1.0f, 2.5f, 10.0f})
        for (Index sharp_edges : {0, 1, 2}) {
          std::vector<float> edges(n, 0.0f), child(n);
          for (Index k = 0; k < sharp_edges; ++k) edges[k] = 0.6f + static_cast<float>(k);
          decay_around_vertex(CreaseMethod::chaikin, edges, child);
          const VertexMask mask = scheme.vertex_mask({n, CreaseMethod::chaikin, s, decay(s), edges, child});
          EXPECT_NEAR(sum_of(mask, n), 1, rounding(n));
          const EdgeMask edge = scheme.edge_mask({n, s, {decay(s), decay(s)}});
          EXPECT_NEAR(2 * edge.end + n * (edge.opposite + edge.face), 1, rounding(n));
        }
      EXPECT_NEAR(sum_of(scheme.smooth_limit_mask(n), n), 1, rounding(n));
      EXPECT_NEAR(sum_of(scheme.crease_limit_mask(0, 1), n), 1, rounding(n));
      EXPECT_NEAR(sum_of(scheme.dart_limit_mask(n)), 1, rounding(n));
    }
}

// Of the weights as they add up.
double rounding(const RingMask& mask) {
  double sum = std::abs(mask.self);
  for (const auto& weights : {mask.edges, mask.faces})
    for (const double weight : weights) sum += std::abs(weight);
  return 1e-12 + 1e-15 * sum;
}

TYPED_TEST(MaskProperties, tangent_weights_sum_to_zero) {
  for (const TypeParam& scheme : this->variants())
    for (Index n : kValences) {
      for (const RingMask& mask : {scheme.smooth_tangent_u(n), scheme.smooth_tangent_v(n),
                                   scheme.dart_tangent_u(n), scheme.crease_tangent_across(n)})
        EXPECT_NEAR(sum_of(mask), 0, rounding(mask)) << n;
    }
}

TYPED_TEST(MaskProperties, limit_masks_reproduce_themselves_under_refinement) {
  for (const TypeParam& scheme : this->variants())
    for (Index n : kValences) {
      SCOPED_TRACE(n);
      const Index faces = kHasFaces<TypeParam> ? n : 0;
      expect_left_eigenvector(as_row(scheme.smooth_limit_mask(n), n, faces),
                              ring_matrix(scheme, n, {}, false), 1, rounding(n));
      expect_left_eigenvector(as_row(scheme.crease_limit_mask(0, n / 2), n, faces),
                              ring_matrix(scheme, n, {0, n / 2}, false), 1, rounding(n));
      expect_left_eigenvector(as_row(scheme.crease_limit_mask(0, n), n + 1, faces),
                              ring_matrix(scheme, n + 1, {0, n}, true), 1, rounding(n));
      expect_left_eigenvector(as_row(scheme.dart_limit_mask(n)), ring_matrix(scheme, n, {0}, false), 1,
                              rounding(n));
    }
}

// The check can fail: the smooth limit mask at a dart, as printed and as used elsewhere, is no fixed point, unless
// sharpness plays no part at all.
TYPED_TEST(MaskProperties, the_smooth_limit_mask_holds_at_a_dart_of_linear_schemes_alone) {
  const Index n = TypeParam::regular_valence;
  for (const TypeParam& scheme : this->variants()) {
    const std::vector<double> row = as_row(scheme.smooth_limit_mask(n), n, kHasFaces<TypeParam> ? n : 0);
    const std::vector<double> out = row_times(row, ring_matrix(scheme, n, {0}, false));
    if (kIsLinear<TypeParam>)
      EXPECT_EQ(out, row);
    else
      EXPECT_GT(std::abs(out[1] - row[1]), 1e-3);
  }
}

// Whose eigenvalue each is depends on the scheme: see its own tests.
TYPED_TEST(MaskProperties, tangents_are_left_eigenvectors) {
  for (const TypeParam& scheme : this->variants())
    for (Index n : kValences) {
      SCOPED_TRACE(n);
      const Matrix smooth = ring_matrix(scheme, n, {}, false), dart = ring_matrix(scheme, n, {0}, false);
      const double lambda = eigenvalue_of(as_row(scheme.smooth_tangent_u(n)), smooth);
      EXPECT_GT(lambda, 0);
      EXPECT_LT(lambda, 1);
      expect_left_eigenvector(as_row(scheme.smooth_tangent_u(n)), smooth, lambda, rounding(n));
      if (n > 2) expect_left_eigenvector(as_row(scheme.smooth_tangent_v(n)), smooth, lambda, rounding(n));
      if (n > 2) expect_left_eigenvector(as_row(scheme.smooth_tangent_v(n)), dart, lambda, rounding(n));
      const Matrix border = ring_matrix(scheme, n + 1, {0, n}, true);
      const std::vector<double> across = as_row(scheme.crease_tangent_across(n));
      expect_left_eigenvector(across, border, eigenvalue_of(across, border), rounding(n));
      std::vector<double> along(border.size(), 0.0);
      along[1] = 1;
      along[n + 1] = -1;
      expect_left_eigenvector(along, border, 0.5, 1e-15);
    }
}

// The gap to the next eigenvalue shrinks with the valence, and with it what the iteration reaches.
TYPED_TEST(MaskProperties, the_dart_tangent_is_a_left_eigenvector_that_dominates) {
  for (const TypeParam& scheme : this->variants())
    for (Index n : {3, 4, 5, 6, 7, 8, 12}) {
      SCOPED_TRACE(n);
      const Matrix dart = ring_matrix(scheme, n, {0}, false);
      const std::vector<double> row = as_row(scheme.dart_tangent_u(n));
      const double lambda = eigenvalue_of(row, dart);
      EXPECT_GT(lambda, 0.3);
      EXPECT_LT(lambda, 1.0);
      expect_left_eigenvector(row, dart, lambda, 1e-9);
    }
}

TYPED_TEST(MaskProperties, the_tangent_across_one_face_is_that_of_its_plane) {
  const RingMask mask = this->variants()[0].crease_tangent_across(1);
  EXPECT_EQ(mask.self, -2);
  EXPECT_EQ(mask.edges, (std::vector<double>{1, 1}));
}

TYPED_TEST(MaskProperties, the_crease_rule_depends_on_the_crease_alone) {
  for (const TypeParam& scheme : this->variants()) {
    const std::vector<float> border(2, kInfiniteSharpness);  // of one face
    const VertexMask least = scheme.vertex_mask({1, CreaseMethod::uniform, 0, 0, border, border});
    for (Index n : kValences) {
      std::vector<float> edges(n + 1, 0.0f);
      edges[0] = edges[n] = kInfiniteSharpness;
      const VertexMask mask = scheme.vertex_mask({n, CreaseMethod::uniform, 0, 0, edges, edges});
      EXPECT_EQ(mask.self, least.self);
      EXPECT_EQ(mask.each, 0);
      EXPECT_EQ(mask.crease, least.crease);
      EXPECT_EQ(mask.crease_ends[0], 0u);
      EXPECT_EQ(mask.crease_ends[1], kIsLinear<TypeParam> ? 0u : n);
    }
  }
}

TYPED_TEST(MaskProperties, masks_do_not_change_when_the_ring_is_turned_or_mirrored) {
  for (const TypeParam& scheme : this->variants()) {
    const std::vector<float> edges{0, 1.5f, 0, 0, 0.4f, 10, 0};
    auto mask_of = [&](std::vector<float> ring) {
      std::vector<float> child(ring.size());
      decay_around_vertex(CreaseMethod::chaikin, ring, child);
      return scheme.vertex_mask({7, CreaseMethod::chaikin, 0.2f, 0, ring, child});
    };
    const VertexMask reference = mask_of(edges);
    for (std::size_t turn = 0; turn < edges.size(); ++turn)
      for (bool mirrored : {false, true}) {
        std::vector<float> ring = edges;
        std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(turn), ring.end());
        if (mirrored) std::reverse(ring.begin(), ring.end());
        const VertexMask mask = mask_of(ring);
        EXPECT_NEAR(mask.self, reference.self, 1e-7);  // float sharpness is summed in another order
        EXPECT_NEAR(mask.each, reference.each, 1e-7);
        EXPECT_NEAR(mask.crease, reference.crease, 1e-7);
      }
  }
}

}  // namespace
}  // namespace subdivd
