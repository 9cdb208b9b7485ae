#include "proto/json/arrays.h"

#include <algorithm>
#include <cmath>

#include "core/base/buffer.h"

namespace subdivd::proto::json {
namespace {

constexpr std::string_view kWholeNumber = "a whole number from 0 to 4294967294";

// What is wrong with a number that is no index. `below` leads to it.
bool fail_index(Cursor& cursor, Path below) {
  double number = 0;
  if (!cursor.read_number(number, kWholeNumber, below)) return false;
  const bool whole = number == std::floor(number);
  return cursor.fail(whole ? ErrorCode::out_of_range : ErrorCode::wrong_type,
                     std::string("this is ") +
                         std::string(whole ? (number < 0 ? "negative" : "too large") : "not whole") +
                         "; it must be " + std::string(kWholeNumber),
                     std::move(below));
}

std::string of_form(std::string_view noun, bool nested) {
  return nested ? std::string("an array, as the ") + std::string(noun) + "s before it are"
                : "a number, as what stands before it";
}

bool read_tuple(Cursor& cursor, std::uint64_t i, std::string_view noun, Tuples& out) {
  if (cursor.type() != Type::array) return cursor.fail_type(of_form(noun, true), {i});
  const std::size_t begin = out.values.size();
  {
    const Cursor::Step step(cursor, i);
    if (!cursor.open_array("")) return false;
    for (Cursor::Elements scalars(cursor); scalars.next();) {
      double number = 0;
      if (!cursor.try_number(number)) return cursor.read_number(number, "a number", {scalars.index()});
      out.values.push_back(number);
      // A first tuple without end would make every further one an error, after all the memory is used.
      if (out.values.size() - begin > kMaxCurveWidth)
        return cursor.fail(ErrorCode::wrong_length, std::string("this ") + std::string(noun) +
                                                        " has more than " + std::to_string(kMaxCurveWidth) +
                                                        " numbers");
    }
    if (cursor.failed()) return false;
  }
  const std::size_t length = out.values.size() - begin;
  if (out.width == 0 && length > 0) out.width = static_cast<Index>(length);
  if (length == out.width && length > 0) return true;
  return cursor.fail(ErrorCode::wrong_length,
                     std::string("this ") + std::string(noun) + " has " + std::to_string(length) +
                         " numbers; it must have " +
                         (out.width == 0 ? "at least 1" : std::to_string(out.width)),
                     {i});
}

// Takes all the room at once: growing would copy what is there, in one go that nothing stops.
template <class Scalar>
void reserve(std::vector<Scalar>& out, std::size_t count) {
  out.reserve(count);
  large_blocks::prefer_huge_pages(out.data(), out.capacity() * sizeof(Scalar));
}

// Enters the array and makes room for as many scalars as there can be in it.
template <class Scalar>
bool open_scalars(Cursor& cursor, std::string_view right, std::vector<Scalar>& out) {
  if (!cursor.open_array(right)) return false;
  reserve(out, cursor.look_ahead().values);
  return !cursor.failed();
}

}  // namespace

bool read_tuples(Cursor& cursor, Index width, Index widest, std::string_view noun, Tuples& out) {
  const std::string right =
      std::string("an array of ") + std::string(noun) + "s, nested [[…], …] or flat [x, y, …]";
  if (!open_scalars(cursor, right, out.values)) return false;
  out.width = width;
  for (Cursor::Elements elements(cursor); elements.next();) {
    const std::uint64_t i = elements.index();
    if (i == 0) {
      const Type type = cursor.type();
      if (type != Type::array && type != Type::number)
        return cursor.fail_type("a number or an array of numbers", {i});
      out.form = type == Type::array ? ArrayForm::nested : ArrayForm::flat;
    }
    if (out.form == ArrayForm::nested) {
      if (!read_tuple(cursor, i, noun, out)) return false;
    } else {
      double number = 0;
      if (!cursor.try_number(number)) return cursor.read_number(number, of_form(noun, false), {i});
      out.values.push_back(number);
    }
  }
  if (cursor.failed()) return false;
  if (out.form == ArrayForm::flat) {
    out.width = 0;
    if (width > 0 && out.values.size() % width != 0)
      return cursor.fail(ErrorCode::wrong_length,
                         std::string("the array holds ") + std::to_string(out.values.size()) +
                             " numbers; it must hold a multiple of " + std::to_string(width));
  }
  if (out.width > widest)
    return cursor.fail(ErrorCode::out_of_range,
                       std::string("a ") + std::string(noun) + " has " + std::to_string(out.width) +
                           " numbers; it may have at most " + std::to_string(widest));
  return true;
}

bool read_indices(Cursor& cursor, std::vector<Index>& out) {
  if (!open_scalars(cursor, "an array of whole numbers", out)) return false;
  for (Cursor::Elements elements(cursor); elements.next();) {
    Index index = 0;
    if (!cursor.try_index(index)) return fail_index(cursor, {elements.index()});
    out.push_back(index);
  }
  return !cursor.failed();
}

bool read_reals(Cursor& cursor, std::vector<double>& out) {
  if (!open_scalars(cursor, "an array of numbers", out)) return false;
  for (Cursor::Elements elements(cursor); elements.next();) {
    double number = 0;
    if (!cursor.try_number(number)) return cursor.read_number(number, "a number", {elements.index()});
    out.push_back(number);
  }
  return !cursor.failed();
}

bool read_lists(Cursor& cursor, std::string_view noun, Lists& out) {
  if (!cursor.open_array("an array of whole numbers, or of arrays of them")) return false;
  const Cursor::Ahead ahead = cursor.look_ahead();
  reserve(out.indices, ahead.values);
  for (Cursor::Elements elements(cursor); elements.next();) {
    const std::uint64_t i = elements.index();
    if (i == 0) {
      out.form = cursor.type() == Type::array ? ArrayForm::nested : ArrayForm::flat;
      if (out.form == ArrayForm::nested) reserve(out.counts, ahead.brackets);
    }
    Index index = 0;
    if (out.form == ArrayForm::flat) {
      if (!cursor.try_index(index)) return fail_index(cursor, {i});
      out.indices.push_back(index);
      continue;
    }
    if (cursor.type() != Type::array) return cursor.fail_type(of_form(noun, true), {i});
    const Cursor::Step step(cursor, i);
    if (!cursor.open_array("")) return false;
    std::size_t length = 0;
    for (Cursor::Elements list(cursor); list.next(); ++length) {
      if (!cursor.try_index(index)) return fail_index(cursor, {list.index()});
      out.indices.push_back(index);
    }
    if (cursor.failed()) return false;
    if (length >= kNoIndex) return cursor.fail(ErrorCode::too_large, "this list is too long");
    out.counts.push_back(static_cast<Index>(length));
  }
  return !cursor.failed();
}

bool read_sharpnesses(Cursor& cursor, std::vector<float>& out) {
  constexpr std::string_view right = "a number or \"infinite\"";
  if (!open_scalars(cursor, "an array of numbers or \"infinite\"", out)) return false;
  for (Cursor::Elements elements(cursor); elements.next();) {
    if (cursor.type() == Type::string) {
      const Cursor::Step step(cursor, elements.index());
      std::string_view word;
      if (!cursor.read_string(word)) return false;
      if (word != "infinite")
        return cursor.fail(ErrorCode::bad_enum,
                           std::string("this is ") + in_quotes(word) + "; it must be " + std::string(right));
      out.push_back(kInfiniteSharpness);
    } else {
      double number = 0;
      if (!cursor.try_number(number)) return cursor.read_number(number, right, {elements.index()});
      // From kInfiniteSharpness on all are infinite, also USD's 1e38 and what no float can hold.
      out.push_back(static_cast<float>(std::clamp(number, -1e38, 1e38)));
    }
  }
  return !cursor.failed();
}

bool read_whole_number(Cursor& cursor, Index& out) {
  return cursor.try_index(out) || (!cursor.failed() && fail_index(cursor, {}));
}

}  // namespace subdivd::proto::json
