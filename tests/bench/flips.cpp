#include "tests/bench/flips.h"

#include <algorithm>
#include <utility>

namespace subdivd::bench {
namespace {

constexpr Index kLeastValence = 4, kMostValence = 9;

// Half-edge h runs from corner h to the next corner of face h / 3.
Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }

class Flipper {
 public:
  Flipper(std::vector<Index>& corners, Index point_count)
      : corners_(corners), twin_(corners.size()), valence_(point_count) {
    struct Keyed {
      Index low, high, half_edge;
      auto operator<=>(const Keyed&) const = default;
    };
    std::vector<Keyed> sides;
    for (Index h = 0; h < corners.size(); ++h) {
      const auto [low, high] = std::minmax(corners[h], corners[next(h)]);
      sides.push_back({low, high, h});
      ++valence_[corners[h]];
    }
    std::ranges::sort(sides);
    for (std::size_t k = 0; k + 1 < sides.size(); k += 2) {  // closed: always two of a kind
      twin_[sides[k].half_edge] = sides[k + 1].half_edge;
      twin_[sides[k + 1].half_edge] = sides[k].half_edge;
    }
    irregular_ = static_cast<Count>(std::ranges::count_if(valence_, [](Index v) { return v != 6; }));
  }

  Count irregular() const { return irregular_; }

  // a b c + b a d  ->  a d c + d b c, if allowed; h is a -> b.
  void flip(Index h) {
    const Index t = twin_[h];
    const Index a = corners_[h], b = corners_[t], c = corners_[previous(h)], d = corners_[previous(t)];
    if (valence_[a] <= kLeastValence || valence_[b] <= kLeastValence || valence_[c] >= kMostValence ||
        valence_[d] >= kMostValence || joined(previous(h), d))
      return;
    const Index ad = twin_[next(t)], db = twin_[previous(t)], bc = twin_[next(h)], ca = twin_[previous(h)];
    const Index f = h / 3 * 3, g = t / 3 * 3;
    set(f, {a, d, c});
    set(g, {d, b, c});
    join(f, ad), join(f + 1, g + 2), join(f + 2, ca), join(g, db), join(g + 1, bc);
    change(a, -1), change(b, -1), change(c, 1), change(d, 1);
  }

 private:
  // Whether an edge runs from the start of half-edge `out` to `other`.
  bool joined(Index out, Index other) const {
    for (Index h = out;;) {
      if (corners_[next(h)] == other) return true;
      h = twin_[previous(h)];
      if (h == out) return false;
    }
  }
  void set(Index face, std::initializer_list<Index> corners) {
    std::ranges::copy(corners, corners_.begin() + face);
  }
  void join(Index h, Index t) { twin_[h] = t, twin_[t] = h; }
  void change(Index point, int by) {
    irregular_ -= valence_[point] != 6;
    valence_[point] += static_cast<Index>(by);
    irregular_ += valence_[point] != 6;
  }

  std::vector<Index>& corners_;
  std::vector<Index> twin_, valence_;
  Count irregular_ = 0;
};

}  // namespace

void flip_edges(std::vector<Index>& triangles, Index point_count, double share, shapes::Random& random) {
  Flipper flipper(triangles, point_count);
  while (static_cast<double>(flipper.irregular()) < share * point_count)
    flipper.flip(random.below(triangles.size()));
}

}  // namespace subdivd::bench
