#include "proto/json/read_primvar.h"

#include <cmath>
#include <string>
#include <utility>

#include "core/base/pace.h"
#include "proto/json/arrays.h"
#include "proto/json/words.h"

namespace subdivd::proto::json {
namespace {

class PrimvarReader {
 public:
  PrimvarReader(Cursor& cursor, Primvar& out, NameList& names) : cursor_(cursor), out_(out), names_(names) {}

  static constexpr std::size_t kMembers = 5;
  static constexpr std::array<Cursor::Member<PrimvarReader>, kMembers> members() {
    return {{{"interpolation", &PrimvarReader::interpolation},
             {"elementSize", &PrimvarReader::element_size},
             {"values", &PrimvarReader::values},
             {"indices", &PrimvarReader::indices},
             {"names", &PrimvarReader::names}}};
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

  // Kept in one text, that grows: four bytes for each of theirs were set aside.
  bool names() {
    has_names_ = true;
    if (!cursor_.open_array("an array of names")) return false;
    names_.reserve(cursor_.look_ahead().values, 0);
    std::string_view name;
    for (Cursor::Elements elements(cursor_); elements.next();) {
      if (cursor_.type() != Type::string) return cursor_.fail_type("a name", {elements.index()});
      if (!cursor_.read_string(name)) return false;
      names_.add(name);
    }
    return !cursor_.failed();
  }

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
    return !has_names_ || check_names();
  }

 private:
  bool check_names() {
    if (out_.interpolation != Interpolation::uniform || out_.element_size != 1)
      return cursor_.fail(
          ErrorCode::unsupported,
          "names are for primvars of interpolation uniform and elementSize 1: what lies between two "
          "numbers has no name",
          {"names"});
    if (names_.empty() || names_.size() >= kMostNames)
      return cursor_.fail(ErrorCode::wrong_length,
                          "names holds " + std::to_string(names_.size()) + " names; it must hold 1 to " +
                              std::to_string(kMostNames - 1),
                          {"names"});
    const auto checked = stoppable(cursor_.budget(), [&](const Pace& pace) -> Result<void> {
      Count place = 0;
      const bool fine = pace.all_blocks(out_.values.size(), [&](Count begin, Count end) {
        for (place = begin; place < end; ++place)
          if (!is_number_of_name(out_.values[place])) return false;
        return true;
      });
      if (fine) return {};
      Path where = cursor_.path();
      where.insert(where.end(), {std::string("values"), std::uint64_t{place}});
      if (tuples_.form == ArrayForm::nested) where.emplace_back(std::uint64_t{0});
      return Error{ErrorCode::out_of_range,
                   "where there are names a value must be a whole number from 0 to " +
                       std::to_string(names_.size() - 1),
                   std::move(where)};
    });
    return checked || cursor_.fail_as(checked.error());
  }
  bool is_number_of_name(double value) const {
    return value >= 0 && value < static_cast<double>(names_.size()) && value == std::floor(value);
  }

  Cursor& cursor_;
  Primvar& out_;
  NameList& names_;
  Tuples tuples_;
  Index size_ = 0;  // 0: not given
  bool has_values_ = false, has_names_ = false;
};

}  // namespace

bool read_primvar(Cursor& cursor, Primvar& out, ArrayForm& form, NameList& names) {
  if (!cursor.open_object("a primvar, an object")) return false;
  PrimvarReader reader(cursor, out, names);
  std::bitset<PrimvarReader::kMembers> seen;
  return cursor.read_members(PrimvarReader::members(), reader, seen) && reader.finish(form);
}

}  // namespace subdivd::proto::json
