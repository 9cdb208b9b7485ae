#include "proto/gltf/weld.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>

#include "core/base/buffer.h"
#include "proto/gltf/polled_sort.h"
#include "proto/gltf/row_hash.h"

namespace subdivd::proto::gltf {
namespace {

std::uint64_t bits_of(double value) { return std::bit_cast<std::uint64_t>(value + 0.0); }  // -0 + 0 is +0
std::uint64_t bits_of(Index value) { return value; }

// The tuples as rows of words. kWidth 0: known at run time only.
template <class Number, Count kWidth>
class Rows {
 public:
  Rows(std::span<const Number> values, Count width, std::span<const Index> groups)
      : values_(values.data()), groups_(groups.empty() ? nullptr : groups.data()), run_time_width_(width) {}

  Count width() const { return kWidth != 0 ? kWidth : run_time_width_; }
  std::uint64_t word(Count row, Count k) const { return bits_of(values_[row * width() + k]); }
  Index group(Count row) const { return groups_ == nullptr ? 0 : groups_[row]; }

  bool equal(Count a, Count b) const {
    std::uint64_t difference = group(a) ^ group(b);
    for (Count k = 0; k < width(); ++k) difference |= word(a, k) ^ word(b, k);
    return difference == 0;
  }

  std::uint64_t hash(Count row) const {
    return hash_of_row(group(row), width(), [&](Count k) { return word(row, k); });
  }

 private:
  const Number* values_;
  const Index* groups_;
  Count run_time_width_;
};

Result<Welded> room_for(Count count, Work& work) {
  auto held = work.hold(2 * (count * sizeof(Index) + kBlockBytes));
  if (!held) return held.error();
  Welded weld;
  weld.memory = *std::move(held);
  if (auto grown = grow(weld.id, count, work); !grown) return grown.error();
  return weld;
}

// Open addressing; a slot holds id + 1 and, in the bits that ids leave, as many of the hash. Gives up (false)
// when rows collide more than chance lets them: the mixing is no secret, so an attacker can make all of them.
template <class R>
Result<bool> weld_by_hashing(const R& rows, Count count, Welded& weld, Work& work) {
  constexpr Count kBlock = 32;  // rows whose slots are fetched ahead
  if (count >= Count{1} << 31) return false;
  const int slot_bits = std::max(static_cast<int>(std::bit_width(count)) + 1, 4);
  const int shift = 64 - slot_bits;
  const Count mask = (Count{1} << slot_bits) - 1;
  const Index tag_mask = ~((Index{1} << std::bit_width(count)) - 1);
  const Count bytes = (mask + 1) * sizeof(Index);
  const auto held =
      work.hold(bytes + (bytes >= large_blocks::kHugePage ? large_blocks::kHugePage : kBlockBytes));
  if (!held) return held.error();
  // Looked into everywhere at once: small pages would cost a walk for each look.
  Buffer<Index> slots;
  if (auto grown = grow(slots, mask + 1, work); !grown) return grown.error();
  if (auto grown = grow(weld.first, count, work); !grown) return grown.error();
  Index ids = 0;
  Count steps_left = 8 * count + 1024;
  std::array<std::uint64_t, kBlock> hashes;
  for (Count begin = 0; begin < count; begin += kBlock) {
    const Count size = std::min(kBlock, count - begin), before = steps_left;
    for (Count k = 0; k < size; ++k) {
      hashes[k] = rows.hash(begin + k);
      __builtin_prefetch(&slots[hashes[k] >> shift]);
    }
    for (Count k = 0; k < size; ++k) {
      const Index tag = static_cast<Index>(hashes[k]) & tag_mask;
      Count slot = hashes[k] >> shift;
      for (;; slot = (slot + 1) & mask) {
        const Index found = slots[slot];
        if (found == 0) {
          weld.first[ids] = static_cast<Index>(begin + k);
          weld.id[begin + k] = ids;
          slots[slot] = ++ids | tag;
          break;
        }
        if (((found ^ tag) & tag_mask) == 0) {
          const Index id = (found & ~tag_mask) - 1;
          if (rows.equal(weld.first[id], begin + k)) {
            weld.id[begin + k] = id;
            break;
          }
        }
        if (--steps_left == 0) return false;
      }
    }
    if (auto stop = work.spend((size + before - steps_left) * (rows.width() + 4) / 2))
      return *std::move(stop);
  }
  weld.first.resize(ids);
  return true;
}

template <class R>
Result<void> sort_rows(const R& rows, Count count, Welded& weld, Work& work) {
  // The first word rides along: most comparisons never touch the values.
  struct Entry {
    std::uint64_t word;
    Index row;
  };
  const auto held = work.hold(count * (sizeof(Entry) + sizeof(Index)) + 2 * kBlockBytes);
  if (!held) return held.error();
  std::vector<Entry> order(count);
  for (Count i = 0; i < count; ++i) {
    if (auto stop = work.spend(1)) return *std::move(stop);
    order[i] = {rows.width() == 0 ? 0 : rows.word(i, 0), static_cast<Index>(i)};
  }
  const auto compare_rest = [&](Index a, Index b) {
    if (rows.group(a) != rows.group(b)) return rows.group(a) < rows.group(b) ? -1 : 1;
    for (Count k = 1; k < rows.width(); ++k)
      if (const std::uint64_t x = rows.word(a, k), y = rows.word(b, k); x != y) return x < y ? -1 : 1;
    return 0;
  };
  const auto less = [&](const Entry& a, const Entry& b) {
    if (a.word != b.word) return a.word < b.word;
    const int rest = compare_rest(a.row, b.row);
    return rest != 0 ? rest < 0 : a.row < b.row;
  };
  const Count cost = 2 + rows.width() / 2;
  if (auto sorted = polled_sort(order, less, work, cost); !sorted) return sorted;

  std::vector<Index> representative(count);
  for (Count i = 0; i < count; ++i) {
    if (auto stop = work.spend(cost)) return *std::move(stop);
    const bool same =
        i > 0 && order[i].word == order[i - 1].word && compare_rest(order[i].row, order[i - 1].row) == 0;
    representative[order[i].row] = same ? representative[order[i - 1].row] : order[i].row;
  }
  weld.first.clear();
  weld.first.reserve(count);
  for (Index i = 0; i < count; ++i) {
    if (auto stop = work.spend(1)) return *std::move(stop);
    if (representative[i] == i) {
      weld.id[i] = static_cast<Index>(weld.first.size());
      weld.first.push_back(i);
    } else {
      weld.id[i] = weld.id[representative[i]];
    }
  }
  return {};
}

template <Count kWidth, class Number>
Result<Welded> weld_rows(std::span<const Number> values, Count width, std::span<const Index> groups,
                         Work& work) {
  const Rows<Number, kWidth> rows(values, width, groups);
  const Count count = width == 0 ? groups.size() : values.size() / width;
  auto weld = room_for(count, work);
  if (!weld) return weld;
  const auto done = weld_by_hashing(rows, count, *weld, work);
  if (!done) return done.error();
  if (!*done)
    if (auto sorted = sort_rows(rows, count, *weld, work); !sorted) return sorted.error();
  return weld;
}

}  // namespace

Result<Welded> weld_tuples(std::span<const double> values, Count width, std::span<const Index> groups,
                           Work& work) {
  switch (width) {
    case 2:
      return weld_rows<2>(values, width, groups, work);
    case 3:
      return weld_rows<3>(values, width, groups, work);
    default:
      return weld_rows<0>(values, width, groups, work);
  }
}

Result<Welded> weld_tuples(std::span<const Index> values, Count width, Work& work) {
  return weld_rows<0>(values, width, std::span<const Index>(), work);
}

Result<Welded> weld_by_sorting(std::span<const double> values, Count width, std::span<const Index> groups,
                               Work& work) {
  const Rows<double, 0> rows(values, width, groups);
  const Count count = width == 0 ? groups.size() : values.size() / width;
  auto weld = room_for(count, work);
  if (!weld) return weld;
  if (auto sorted = sort_rows(rows, count, *weld, work); !sorted) return sorted.error();
  return weld;
}

}  // namespace subdivd::proto::gltf
