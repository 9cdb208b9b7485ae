// A scheme that lacks any of what is used of schemes is none: everything of Loop's but one thing.
#include "core/schemes/scheme.h"

#include <gtest/gtest.h>

#include <memory>
#include <span>

#include "core/schemes/loop.h"

namespace subdivd {
namespace {

// Whatever a derived type declares takes the place of Loop's.
template <class S>
struct Like : Loop {
  static std::span<const SchemeOption<S>> options() { return {}; }
};

struct Whole : Like<Whole> {};
static_assert(RunsOnGrids<Whole> && RunsOnGrids<Loop>);

template <class S>
constexpr bool kIsNone = !RunsOnGrids<S>;

TEST(RunsOnGrids, asks_for_a_value_with_a_name_and_options) {
  struct Nameless : Like<Nameless> {
    void name() const;
  };
  struct OptionsOfAnother : Loop {};
  struct Unique : Like<Unique> {
    std::unique_ptr<int> table;
  };
  struct NeedsAnArgument : Like<NeedsAnArgument> {
    explicit NeedsAnArgument(int) {}
  };
  EXPECT_TRUE(kIsNone<Nameless>);
  EXPECT_TRUE(kIsNone<OptionsOfAnother>);
  EXPECT_TRUE(kIsNone<Unique>);
  EXPECT_TRUE(kIsNone<NeedsAnArgument>);
}

TEST(RunsOnGrids, asks_for_split_face_sizes_and_regular_valence) {
  struct NoSplit : Like<NoSplit> {
    void split() const;
  };
  struct NoFaceSizes : Like<NoFaceSizes> {
    void face_sizes() const;
  };
  struct NoRegularValence : Like<NoRegularValence> {
    void regular_valence() const;
  };
  EXPECT_TRUE(kIsNone<NoSplit>);
  EXPECT_TRUE(kIsNone<NoFaceSizes>);
  EXPECT_TRUE(kIsNone<NoRegularValence>);
}

TEST(RunsOnGrids, asks_for_masks_of_edges_and_vertices) {
  struct NoEdges : Like<NoEdges> {
    void edge_mask(const EdgeRing&) const;
  };
  struct NoVertices : Like<NoVertices> {
    EdgeMask vertex_mask(const VertexRing&) const;
  };
  EXPECT_TRUE(kIsNone<NoEdges>);
  EXPECT_TRUE(kIsNone<NoVertices>);
}

TEST(RunsOnGrids, asks_for_limit_masks) {
  struct NoSmooth : Like<NoSmooth> {
    void smooth_limit_mask(Index) const;
  };
  struct NoCrease : Like<NoCrease> {
    VertexMask crease_limit_mask(Index) const;
  };
  struct NoDart : Like<NoDart> {
    void dart_limit_mask(Index, const Pace&) const;
  };
  struct DartThatCannotBeStopped : Like<DartThatCannotBeStopped> {
    RingMask dart_limit_mask(Index) const;
  };
  EXPECT_TRUE(kIsNone<NoSmooth>);
  EXPECT_TRUE(kIsNone<NoCrease>);
  EXPECT_TRUE(kIsNone<NoDart>);
  EXPECT_TRUE(kIsNone<DartThatCannotBeStopped>);
}

TEST(RunsOnGrids, asks_for_tangent_masks) {
  struct NoU : Like<NoU> {
    void smooth_tangent_u() const;
  };
  struct NoV : Like<NoV> {
    void smooth_tangent_v() const;
  };
  struct NoDart : Like<NoDart> {
    void dart_tangent_u() const;
  };
  struct NoneAcross : Like<NoneAcross> {
    void crease_tangent_across() const;
  };
  struct NoCorners : Like<NoCorners> {
    void flat_corner_faces() const;
  };
  EXPECT_TRUE(kIsNone<NoU>);
  EXPECT_TRUE(kIsNone<NoV>);
  EXPECT_TRUE(kIsNone<NoDart>);
  EXPECT_TRUE(kIsNone<NoneAcross>);
  EXPECT_TRUE(kIsNone<NoCorners>);
}

// A ring of ten million edges is not left before its mask is done unless the mask polls.
TEST(RunsOnGrids, asks_for_tangent_masks_that_can_be_stopped) {
  struct U : Like<U> {
    RingMask smooth_tangent_u(Index) const;
  };
  struct V : Like<V> {
    RingMask smooth_tangent_v(Index) const;
  };
  struct Dart : Like<Dart> {
    RingMask dart_tangent_u(Index) const;
  };
  struct Across : Like<Across> {
    RingMask crease_tangent_across(Index) const;
  };
  EXPECT_TRUE(kIsNone<U>);
  EXPECT_TRUE(kIsNone<V>);
  EXPECT_TRUE(kIsNone<Dart>);
  EXPECT_TRUE(kIsNone<Across>);
}

TEST(RunsOnGrids, asks_whether_opensubdiv_knows_it) {
  struct Silent : Like<Silent> {
    void beyond_opensubdiv() const;
  };
  EXPECT_TRUE(kIsNone<Silent>);
}

}  // namespace
}  // namespace subdivd
