#include "proto/json/read_primvar.h"

#include "proto/json/arrays.h"
#include "proto/json/words.h"

namespace subdivd::proto::json {
namespace {

class PrimvarReader {
 public:
  PrimvarReader(Cursor& cursor, Primvar& out) : cursor_(cursor), out_(out) {}

  static constexpr std::size_t kMembers = 4;
  static constexpr std::array<Cursor::Member<PrimvarReader>, kMembers> members() {
    return {{{"interpolation", &PrimvarReader::interpolation},
             {"elementSize", &PrimvarReader::element_size},
             {"values", &PrimvarReader::values},
             {"indices", &PrimvarReader::indices}}};
  }

  bool interpolation() {
    std::size_t word = 0;
    if (!cursor_.read_word(interpolation_words(), word)) return false;
    out_.interpolation = static_cast<Interpolation>(word);
    return true;
  }

  bool element_size() {
    if (!read_whole_number(cursor_, size_)) return false;
    if (size_ >= 1 && size_ <= kMaxElementSize) return true;
    return cursor_.fail(ErrorCode::out_of_range, std::string("this is ") + std::to_string(size_) +
                                                     "; it must be from 1 to " +
                                                     std::to_string(kMaxElementSize));
  }

  bool values() {
    has_values_ = true;
    return read_tuples(cursor_, 0, kMaxElementSize, "value", tuples_);
  }

  bool indices() { return read_indices(cursor_, out_.indices); }

  bool finish(ArrayForm& form) {
    if (!has_values_) return cursor_.fail(ErrorCode::missing_field, "a primvar needs values", {"values"});
    const bool nested = tuples_.width > 0;
    if (nested && size_ > 0 && size_ != tuples_.width)
      return cursor_.fail(ErrorCode::wrong_length,
                          std::string("elementSize is ") + std::to_string(size_) + ", but this value has " +
                              std::to_string(tuples_.width) + " numbers",
                          {"values", std::uint64_t{0}});
    out_.element_size = nested ? tuples_.width : size_ > 0 ? size_ : 1;
    if (tuples_.values.size() % out_.element_size != 0)
      return cursor_.fail(ErrorCode::wrong_length,
                          std::string("values holds ") + std::to_string(tuples_.values.size()) +
                              " numbers; it must hold a multiple of the elementSize " +
                              std::to_string(out_.element_size),
                          {"values"});
    out_.values = std::move(tuples_.values);
    form = tuples_.form;
    return true;
  }

 private:
  Cursor& cursor_;
  Primvar& out_;
  Tuples tuples_;
  Index size_ = 0;  // 0: not given
  bool has_values_ = false;
};

}  // namespace

bool read_primvar(Cursor& cursor, Primvar& out, ArrayForm& form) {
  if (!cursor.open_object("a primvar, an object")) return false;
  PrimvarReader reader(cursor, out);
  std::bitset<PrimvarReader::kMembers> seen;
  return cursor.read_members(PrimvarReader::members(), reader, seen) && reader.finish(form);
}

}  // namespace subdivd::proto::json
