#include "proto/json/cursor.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <system_error>

namespace subdivd::proto::json {
namespace {

using simdjson::ondemand::json_type;

std::string_view name_of_type(json_type type) {
  switch (type) {
    case json_type::array:
      return "an array";
    case json_type::object:
      return "an object";
    case json_type::number:
      return "a number";
    case json_type::string:
      return "a string";
    case json_type::boolean:
      return "a boolean";
    case json_type::null:
      return "null";
  }
  return "something else";
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Does the token begin with a number as JSON writes it, ended by white space, a comma, a bracket or its end?
bool is_json_number(std::string_view token) {
  std::size_t i = 0;
  const auto digits = [&] {
    const std::size_t begin = i;
    while (i < token.size() && is_digit(token[i])) ++i;
    return i > begin;
  };
  if (i < token.size() && token[i] == '-') ++i;
  const bool leading_zero = i + 1 < token.size() && token[i] == '0' && is_digit(token[i + 1]);
  if (leading_zero || !digits()) return false;
  if (i < token.size() && token[i] == '.' && (++i, !digits())) return false;
  if (i < token.size() && (token[i] == 'e' || token[i] == 'E')) {
    ++i;
    if (i < token.size() && (token[i] == '+' || token[i] == '-')) ++i;
    if (!digits()) return false;
  }
  return i == token.size() || std::string_view(" \t\r\n,]}").find(token[i]) != std::string_view::npos;
}

// Of a number that no double can hold: is it too large, not too small? Decided by where its first digit
// stands, for 1000…e-10 and 0.000…1e10 mislead whoever looks at the exponent alone.
bool is_too_large(std::string_view token) {
  const std::string_view mantissa = token.substr(0, token.find_first_not_of("-0123456789."));
  const auto first = static_cast<std::int64_t>(mantissa.find_first_of("123456789"));
  const auto point = static_cast<std::int64_t>(std::min(mantissa.find('.'), mantissa.size()));
  std::int64_t exponent = 0;
  if (mantissa.size() < token.size() && (token[mantissa.size()] | 0x20) == 'e') {
    std::string_view digits = token.substr(mantissa.size() + 1);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    const auto failure = std::from_chars(digits.data(), digits.data() + digits.size(), exponent).ec;
    if (failure == std::errc::result_out_of_range) return !digits.starts_with('-');
  }
  // Before the point the first digit counts tens, behind it tenths; bodies are shorter than 2^40.
  const std::int64_t before_point = first < point ? point - first : point + 1 - first;
  return before_point > -exponent;
}

// The number at the beginning of a token that holds one, correctly rounded.
bool read_number(std::string_view token, double& out) {
  if (!is_json_number(token)) return false;
  double number = 0;
  const auto failure = std::from_chars(token.data(), token.data() + token.size(), number).ec;
  if (failure == std::errc::result_out_of_range) {
    if (is_too_large(token)) return false;
    number = token.starts_with('-') ? -0.0 : 0.0;
  }
  out = number;
  return true;
}

}  // namespace

bool get_number(Value& value, double& out) {
  constexpr std::size_t kMostTrusted = 19;  // characters, so digits too
  const std::string_view token = value.raw_json_token();
  if (token.size() <= kMostTrusted) return !value.get_double().get(out);
  return read_number(token, out);
}

Cursor::Step::Step(Cursor& cursor, std::string_view member) : cursor_(cursor) {
  cursor_.path_.emplace_back(std::in_place_type<std::string>, member);
}

Cursor::Step::Step(Cursor& cursor, std::uint64_t element) : cursor_(cursor) {
  cursor_.path_.emplace_back(element);
}

bool Cursor::fail(ErrorCode code, std::string message, Path below) {
  if (error_) return false;
  Path where = path_;
  where.insert(where.end(), std::make_move_iterator(below.begin()), std::make_move_iterator(below.end()));
  error_ = Error{code, std::move(message), std::move(where), 0, 0};
  return false;
}

bool Cursor::fail_as(Error error) {
  if (!error_) error_ = std::move(error);
  return false;
}

bool Cursor::fail_syntax() {
  if (!error_) malformed_ = true;
  return fail(ErrorCode::malformed, "the body is not valid JSON");
}

bool Cursor::fail_type(Value value, std::string_view right, Path below) {
  json_type type{};
  if (value.type().get(type)) return fail_syntax();
  return fail(
      ErrorCode::wrong_type,
      std::string("this is ") + std::string(name_of_type(type)) + "; it must be " + std::string(right),
      std::move(below));
}

bool Cursor::fail_number(Value value, std::string_view right, Path below) {
  json_type type{};
  if (value.type().get(type)) return fail_syntax();
  if (type != json_type::number) return fail_type(value, right, std::move(below));
  const std::string_view token = value.raw_json_token();
  if (!is_json_number(token)) return fail_syntax();
  return fail(ErrorCode::not_finite,
              in_quotes(token.substr(0, token.find_first_of(" \t\r\n,]}"))) +
                  " is beyond what a double can hold; it must be " + std::string(right),
              std::move(below));
}

bool Cursor::read_string(Value value, std::string& out) {
  std::string_view text;
  json_type type{};
  if (value.type().get(type)) return fail_syntax();
  if (type != json_type::string) return fail_type(value, "a string");
  if (value.get_string().get(text)) return fail_syntax();
  out = text;
  return true;
}

bool Cursor::read_word(Value value, std::span<const std::string_view> valid, std::size_t& out) {
  std::string text;
  json_type type{};
  if (value.type().get(type)) return fail_syntax();
  if (type != json_type::string) return fail_type(value, std::string("one of ") + either_of(valid));
  if (!read_string(value, text)) return false;
  const auto found = std::find(valid.begin(), valid.end(), text);
  if (found == valid.end())
    return fail(ErrorCode::bad_enum, std::string("this is ") + in_quotes(text) + hint(text, valid));
  out = static_cast<std::size_t>(found - valid.begin());
  return true;
}

bool Cursor::skip(Value value, std::size_t depth_left) {
  json_type type{};
  if (value.type().get(type)) return fail_syntax();
  // A body of nothing but "[" would otherwise use up our stack.
  if (depth_left == 0) return fail(ErrorCode::too_large, "arrays and objects are nested too deeply");
  switch (type) {
    case json_type::array: {
      simdjson::ondemand::array array;
      if (value.get_array().get(array)) return fail_syntax();
      for (auto element : array) {
        Value inner;
        if (element.get(inner)) return fail_syntax();
        if (!skip(inner, depth_left - 1)) return false;
      }
      return true;
    }
    case json_type::object: {
      simdjson::ondemand::object object;
      if (value.get_object().get(object)) return fail_syntax();
      for (auto field : object) {
        std::string_view name;
        Value inner;
        if (field.unescaped_key().get(name) || field.value().get(inner)) return fail_syntax();
        if (!skip(inner, depth_left - 1)) return false;
      }
      return true;
    }
    case json_type::number: {
      double number = 0;
      return get_number(value, number) ? true : fail_number(value, "a finite number");
    }
    case json_type::string: {
      std::string_view text;
      return value.get_string().get(text) ? fail_syntax() : true;
    }
    case json_type::boolean: {
      bool truth = false;
      return value.get_bool().get(truth) ? fail_syntax() : true;
    }
    case json_type::null: {
      bool null = false;
      return value.is_null().get(null) || !null ? fail_syntax() : true;
    }
  }
  return fail_syntax();
}

bool Cursor::fail_unknown(std::string_view name, std::span<const std::string_view> valid) {
  return fail(ErrorCode::unknown_field,
              std::string("there is no member ") + in_quotes(name) + " here" + hint(name, valid),
              {std::string(name)});
}

bool Cursor::fail_twice(std::string_view name) {
  return fail(ErrorCode::duplicate_field,
              std::string("the member ") + in_quotes(name) + " is given twice; give it once",
              {std::string(name)});
}

}  // namespace subdivd::proto::json
