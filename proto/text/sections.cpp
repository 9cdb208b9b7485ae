#include "proto/text/sections.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "core/base/all_finite.h"
#include "core/base/byte_maker.h"
#include "core/base/pace.h"
#include "proto/json/number_text.h"
#include "proto/text/text_cursor.h"

namespace subdivd::proto::text {
namespace {

constexpr Count kPiece = Count{160} << 10;  // what the processor's cache holds, and what is sent at once
constexpr Count kKept = Count{1} << 20;     // a text of no more is kept rather than made twice
// What is written without a look at the room that is left: a corner and what ends its line; a row of 16 numbers, or
// the names of a face and its first corner, for what begins a line is not written twice.
constexpr std::ptrdiff_t kCornerRoom = 512, kRoom = 2 * (kMaxWordBytes + 16) + 2 * kCornerRoom;

char* put(char* at, std::string_view text) { return std::copy(text.begin(), text.end(), at); }

// "a/b/c", "a//c", "a/b" or "a".
struct CornerForm {
  bool texcoords = false, normals = false;
};

// Where a text has arrived: the section, what of it comes next, and which names hold.
template <class Real>
class Walk {
 public:
  explicit Walk(const Document<Real>& document) : document_(document) {}

  // Writes what follows into [at, end), kRoom at least; returns its end: `at` itself when that was all.
  char* write(char* at, char* const end) {
    for (; section_ < document_.sections.size(); ++section_, row_ = corner_ = place_ = 0) {
      const bool done = std::visit([&](const auto& section) { return write(section, at, end); },
                                   document_.sections[section_]);
      if (!done) break;
    }
    return at;
  }

 private:
  static bool has_room(const char* at, const char* end) { return end - at >= kRoom; }

  bool write(const std::string& text, char*& at, char* end) {
    const Count size = std::min<Count>(text.size() - place_, static_cast<Count>(end - at));
    at = put(at, std::string_view(text).substr(place_, size));
    place_ += size;
    return place_ == text.size();
  }

  // Every number, with a blank behind it.
  static char* put_numbers(char* at, const Column<Real>& column, Count row) {
    const Real* const values = column.values + row * column.stride;
    for (Index k = 0; k < column.count; ++k) {
      char* const begin = at;
      at = json::print_number(at, values[k]);
      if (column.decimal && std::none_of(begin, at, [](char c) { return c == '.' || c == 'e'; }))
        at = put(at, ".0");
      *at++ = ' ';
    }
    for (Index k = 0; k < column.zeros; ++k) at = put(at, "0 ");
    return at;
  }

  bool write(const Rows<Real>& rows, char*& at, char* end) {
    for (; row_ < rows.count; ++row_) {
      if (!has_room(at, end)) return false;
      at = put(at, rows.word);
      for (const Column<Real>& column : rows.columns)
        if (column.values != nullptr) at = put_numbers(at, column, row_);
      at[-1] = '\n';
    }
    return true;
  }

  bool write(const Faces<Real>& faces, char*& at, char* end) {
    const bool obj = document_.format == Format::obj;
    for (; row_ < faces.count; ++row_) {
      const Index size = faces.face_size != 0 ? faces.face_size : faces.counts[row_];
      if (corner_ == 0) {
        if (!has_room(at, end)) return false;
        if (obj) at = put_labels(at, faces);
        at = obj ? put(at, "f") : json::print_number(at, size);
      }
      for (; corner_ < size; ++corner_, ++place_) {
        if (end - at < kCornerRoom) return false;
        at = obj ? put_corner(at, faces) : put_number(at, ' ', faces.first_point + faces.points[place_]);
      }
      *at++ = faces.color.values != nullptr ? ' ' : '\n';
      if (faces.color.values != nullptr) {
        at = put_numbers(at, faces.color, row_);
        at[-1] = '\n';
      }
      corner_ = 0;
    }
    return true;
  }

  static char* put_number(char* at, char before, Count number) {
    *at++ = before;
    return json::print_number(at, number);
  }

  char* put_corner(char* at, const Faces<Real>& faces) const {
    const Index point = faces.points[place_];
    at = put_number(at, ' ', faces.first_point + point);
    if (faces.texcoords != nullptr)
      at = put_number(at, '/', faces.first_texcoord + faces.texcoords[place_]);
    else if (faces.has_normals)
      *at++ = '/';
    if (faces.has_normals) at = put_number(at, '/', faces.first_normal + point);
    return at;
  }

  // The names of this face where they are not those of the last one.
  char* put_labels(char* at, const Faces<Real>& faces) {
    static constexpr std::array<std::string_view, kLabelKinds> kWords = {"g", "usemtl"};
    for (std::size_t kind = 0; kind < kLabelKinds; ++kind) {
      const Labels<Real>& labels = faces.labels[kind];
      if (labels.numbers == nullptr && row_ > 0) continue;
      const auto number = labels.numbers != nullptr ? static_cast<Count>(labels.numbers[row_]) : 0;
      const bool named = labels.numbers != nullptr && number < labels.names->size();
      const std::string_view name = named ? (*labels.names)[number] : std::string_view();
      if (name == current_[kind]) continue;
      current_[kind] = name;
      at = put(at, kWords[kind]);
      if (!name.empty()) *at++ = ' ';
      at = put(at, name);
      *at++ = '\n';
    }
    return at;
  }

  bool write(const Lines& lines, char*& at, char* end) {
    for (; row_ < lines.counts->size(); ++row_) {
      const Index size = (*lines.counts)[row_];
      if (corner_ == 0) {
        if (!has_room(at, end)) return false;
        *at++ = 'l';
      }
      for (; corner_ < size; ++corner_) {
        if (end - at < kCornerRoom) return false;
        at = put_number(at, ' ', lines.first_point + place_ + corner_);
      }
      if (lines.closed) at = put_number(at, ' ', lines.first_point + place_);
      *at++ = '\n';
      place_ += size;
      corner_ = 0;
    }
    return true;
  }

  const Document<Real>& document_;
  std::size_t section_ = 0;
  Count row_ = 0, corner_ = 0, place_ = 0;  // in the section; place_: among corners, points or bytes
  std::array<std::string_view, kLabelKinds> current_ = {};
};

template <class Real>
class TextMaker final : public ByteMaker {
 public:
  TextMaker(std::unique_ptr<const Document<Real>> document, Count size)
      : document_(std::move(document)), walk_(*document_), size_(size), piece_(kPiece) {}

  Count size() const override { return size_; }
  Count held_bytes() const override { return document_->held_bytes + piece_.size(); }
  std::span<const std::byte> next() noexcept override {
    char* const end = walk_.write(piece_.data(), piece_.data() + piece_.size());
    return std::as_bytes(std::span(piece_.data(), end));
  }

 private:
  std::unique_ptr<const Document<Real>> document_;
  Walk<Real> walk_;
  Count size_;
  Buffer<char> piece_;
};

template <class Real>
Result<void> check_column(const Column<Real>& column, Count rows, const Budget& budget) {
  return stoppable(budget, [&](const Pace& pace) -> Result<void> {
    const std::span<const Real> values(column.values, rows * column.stride);
    const bool finite = pace.all_blocks(values.size(), [&](Count begin, Count end) {
      return all_finite(values.subspan(begin, end - begin));
    });
    if (finite) return {};
    return Error{ErrorCode::not_finite,
                 "a refined number is too large for the precision of the answer; scale the input down or "
                 "take precision double"};
  });
}

template <class Real>
Result<void> check_numbers(const Document<Real>& document, const Budget& budget) {
  for (const auto& section : document.sections) {
    Result<void> fine;
    if (const auto* rows = std::get_if<Rows<Real>>(&section)) {
      for (const Column<Real>& column : rows->columns)
        if (fine && column.values != nullptr) fine = check_column(column, rows->count, budget);
    } else if (const auto* faces = std::get_if<Faces<Real>>(&section); faces != nullptr) {
      if (faces->color.values != nullptr) fine = check_column(faces->color, faces->count, budget);
    }
    if (!fine) return fine;
  }
  return {};
}

}  // namespace

template <class Real>
Result<Chunk> make_chunk(std::unique_ptr<const Document<Real>> document, const Budget& budget) {
  if (auto fine = check_numbers(*document, budget); !fine) return fine.error();
  Walk<Real> walk(*document);
  Buffer<char> piece(kPiece);
  std::string kept;
  Count size = 0;
  for (;;) {
    if (auto stop = budget.poll()) return *std::move(stop);
    char* const end = walk.write(piece.data(), piece.data() + piece.size());
    if (end == piece.data()) break;
    size += static_cast<Count>(end - piece.data());
    if (size <= kKept)
      kept.append(piece.data(), end);
    else
      kept = {};
  }
  if (size <= kKept) return Chunk::own(std::move(kept));
  return Chunk{nullptr, {}, std::make_shared<TextMaker<Real>>(std::move(document), size)};
}

Count chunk_bytes(Count text_bytes) { return 2 * kPiece + 2 * std::min(text_bytes, kKept); }

template Result<Chunk> make_chunk(std::unique_ptr<const Document<float>>, const Budget&);
template Result<Chunk> make_chunk(std::unique_ptr<const Document<double>>, const Budget&);

}  // namespace subdivd::proto::text
