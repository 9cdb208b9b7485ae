#include "proto/json/arrays.h"

#include <algorithm>
#include <cmath>

namespace subdivd::proto::json {
namespace {

using simdjson::ondemand::array;
using simdjson::ondemand::json_type;

constexpr std::string_view kWholeNumber = "a whole number from 0 to 4294967294";

bool open_array(Cursor& cursor, Value value, std::string_view right, array& out) {
  json_type type{};
  if (value.type().get(type)) return cursor.fail_syntax();
  if (type != json_type::array) return cursor.fail_type(value, right);
  return value.get_array().get(out) ? cursor.fail_syntax() : true;
}

// The type of the next element, or a failure.
bool type_of(Cursor& cursor, Value value, json_type& type) {
  return value.type().get(type) ? cursor.fail_syntax() : true;
}

// What is wrong with a number that is no index. `below` leads to it.
bool fail_index(Cursor& cursor, Value value, Path below) {
  double number = 0;
  if (!get_number(value, number)) return cursor.fail_number(value, kWholeNumber, std::move(below));
  const bool whole = number == std::floor(number);
  return cursor.fail(whole ? ErrorCode::out_of_range : ErrorCode::wrong_type,
                     std::string("this is ") +
                         std::string(whole ? (number < 0 ? "negative" : "too large") : "not whole") +
                         "; it must be " + std::string(kWholeNumber),
                     std::move(below));
}

// The hot path of indices; false: let fail_index explain.
bool get_index(Value& value, Index& out) {
  std::uint64_t number = 0;
  if (!value.get_uint64().get(number)) {
    out = static_cast<Index>(number);
    return number < kNoIndex;
  }
  double real = 0;  // 3.0 and 1e2 are whole, too
  if (!get_number(value, real) || !(real >= 0) || real >= kNoIndex || real != std::floor(real)) return false;
  out = static_cast<Index>(real);
  return true;
}

std::string of_form(std::string_view noun, bool nested) {
  return nested ? std::string("an array, as the ") + std::string(noun) + "s before it are"
                : "a number, as what stands before it";
}

bool read_tuple(Cursor& cursor, Value element, std::size_t i, std::string_view noun, Tuples& out) {
  array tuple;
  if (element.get_array().get(tuple)) return cursor.fail_type(element, of_form(noun, true), {i});
  const std::size_t begin = out.values.size();
  for (auto scalar : tuple) {
    Value value;
    double number = 0;
    if (scalar.get(value)) return cursor.fail_syntax();
    if (!get_number(value, number))
      return cursor.fail_number(value, "a number", {i, out.values.size() - begin});
    out.values.push_back(number);
    // A first tuple without end would make every further one an error, after all the memory is used.
    if (out.values.size() - begin > kMaxCurveWidth)
      return cursor.fail(ErrorCode::wrong_length,
                         std::string("this ") + std::string(noun) + " has more than " +
                             std::to_string(kMaxCurveWidth) + " numbers",
                         {i});
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

}  // namespace

bool read_tuples(Cursor& cursor, Value value, Index width, Index widest, std::string_view noun, Tuples& out) {
  const std::string right =
      std::string("an array of ") + std::string(noun) + "s, nested [[…], …] or flat [x, y, …]";
  array elements;
  if (!open_array(cursor, value, right, elements)) return false;
  out.width = width;
  std::size_t i = 0;
  for (auto element : elements) {
    Value one;
    if (element.get(one)) return cursor.fail_syntax();
    if (i == 0) {
      json_type type{};
      if (!type_of(cursor, one, type)) return false;
      if (type != json_type::array && type != json_type::number)
        return cursor.fail_type(one, "a number or an array of numbers", {i});
      out.form = type == json_type::array ? ArrayForm::nested : ArrayForm::flat;
    }
    if (out.form == ArrayForm::nested) {
      if (!read_tuple(cursor, one, i, noun, out)) return false;
    } else {
      double number = 0;
      if (!get_number(one, number)) return cursor.fail_number(one, of_form(noun, false), {i});
      out.values.push_back(number);
    }
    ++i;
  }
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

bool read_indices(Cursor& cursor, Value value, std::vector<Index>& out) {
  array elements;
  if (!open_array(cursor, value, "an array of whole numbers", elements)) return false;
  std::size_t i = 0;
  for (auto element : elements) {
    Value one;
    Index index = 0;
    if (element.get(one)) return cursor.fail_syntax();
    if (!get_index(one, index)) return fail_index(cursor, one, {i});
    out.push_back(index);
    ++i;
  }
  return true;
}

bool read_reals(Cursor& cursor, Value value, std::vector<double>& out) {
  array elements;
  if (!open_array(cursor, value, "an array of numbers", elements)) return false;
  std::size_t i = 0;
  for (auto element : elements) {
    Value one;
    double number = 0;
    if (element.get(one)) return cursor.fail_syntax();
    if (!get_number(one, number)) return cursor.fail_number(one, "a number", {i});
    out.push_back(number);
    ++i;
  }
  return true;
}

bool read_lists(Cursor& cursor, Value value, std::string_view noun, Lists& out) {
  array elements;
  if (!open_array(cursor, value, "an array of whole numbers, or of arrays of them", elements)) return false;
  std::size_t i = 0;
  for (auto element : elements) {
    Value one;
    json_type type{};
    if (element.get(one)) return cursor.fail_syntax();
    if (i == 0) {
      if (!type_of(cursor, one, type)) return false;
      out.form = type == json_type::array ? ArrayForm::nested : ArrayForm::flat;
    }
    Index index = 0;
    if (out.form == ArrayForm::flat) {
      if (!get_index(one, index)) return fail_index(cursor, one, {i});
      out.indices.push_back(index);
    } else {
      array list;
      if (one.get_array().get(list)) return cursor.fail_type(one, of_form(noun, true), {i});
      std::size_t length = 0;
      for (auto entry : list) {
        Value number;
        if (entry.get(number)) return cursor.fail_syntax();
        if (!get_index(number, index)) return fail_index(cursor, number, {i, length});
        out.indices.push_back(index);
        ++length;
      }
      if (length >= kNoIndex) return cursor.fail(ErrorCode::too_large, "this list is too long", {i});
      out.counts.push_back(static_cast<Index>(length));
    }
    ++i;
  }
  return true;
}

bool read_sharpnesses(Cursor& cursor, Value value, std::vector<float>& out) {
  constexpr std::string_view right = "a number or \"infinite\"";
  array elements;
  if (!open_array(cursor, value, "an array of numbers or \"infinite\"", elements)) return false;
  std::size_t i = 0;
  for (auto element : elements) {
    Value one;
    json_type type{};
    if (element.get(one)) return cursor.fail_syntax();
    if (!type_of(cursor, one, type)) return false;
    if (type == json_type::string) {
      std::string_view word;
      if (one.get_string().get(word)) return cursor.fail_syntax();
      if (word != "infinite")
        return cursor.fail(ErrorCode::bad_enum,
                           std::string("this is ") + in_quotes(word) + "; it must be " + std::string(right),
                           {i});
      out.push_back(kInfiniteSharpness);
    } else {
      double number = 0;
      if (!get_number(one, number)) return cursor.fail_number(one, right, {i});
      // USD writes 1e38 for infinite; what no float can hold is no less infinite.
      out.push_back(static_cast<float>(std::clamp(number, -1e38, 1e38)));
    }
    ++i;
  }
  return true;
}

bool read_whole_number(Cursor& cursor, Value value, Index& out) {
  return get_index(value, out) ? true : fail_index(cursor, value, {});
}

}  // namespace subdivd::proto::json
