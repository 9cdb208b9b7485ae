#pragma once
// Pieces that a search keeps by number. What is sorted and compared meanwhile are a few numbers for each of
// them: the pieces of a long curve itself, which are most of them, are made when their turn comes.

#include <utility>
#include <vector>

#include "core/base/index.h"
#include "core/base/pace.h"
#include "core/splines/bezier.h"

namespace subdivd {

class PieceStore {
 public:
  // Bytes of one in vectors; its points are elsewhere.
  static constexpr Count kBytes = sizeof(BezierPiece) + sizeof(Count);

  Count keep(BezierPiece piece, const Pace& pace) {
    if (!free_.empty()) {
      const Count number = free_.back();
      free_.pop_back();
      pieces_[number] = std::move(piece);
      return number;
    }
    pace.make_room(pieces_, 1);
    pieces_.push_back(std::move(piece));
    return pieces_.size() - 1;
  }
  BezierPiece take(Count number) {
    free_.push_back(number);
    return std::exchange(pieces_[number], {});
  }

 private:
  std::vector<BezierPiece> pieces_;
  std::vector<Count> free_;  // numbers of those that are gone
};

}  // namespace subdivd
