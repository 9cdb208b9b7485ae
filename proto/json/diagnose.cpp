#include "proto/json/diagnose.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace subdivd::proto::json {
namespace {

constexpr std::size_t kLongest = std::size_t{32} << 20;  // 0.8 s of reading
constexpr std::size_t kDeepest = 64;                     // of the path that is told
constexpr std::size_t kLongestKey = 256;

// Follows where the parser is; builds nothing.
class Trail final : public nlohmann::json_sax<nlohmann::json> {
 public:
  bool null() override { return scalar(); }
  bool boolean(bool) override { return scalar(); }
  bool number_integer(number_integer_t) override { return scalar(); }
  bool number_unsigned(number_unsigned_t) override { return scalar(); }
  bool number_float(number_float_t, const string_t&) override { return scalar(); }
  bool string(string_t&) override { return scalar(); }
  bool binary(binary_t&) override { return scalar(); }
  bool start_object(std::size_t) override { return open(std::string()); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(std::uint64_t{0}); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    if (depth_ > 0 && depth_ <= kDeepest) path_[depth_ - 1] = name.substr(0, kLongestKey);
    return true;
  }
  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::json::exception& error) override {
    position_ = position;
    not_finite_ = error.id == 406;
    return false;
  }

  bool not_finite() const { return not_finite_; }
  std::size_t position() const { return position_; }
  // Where the parser stood; an object entered without a key yet is left out.
  Path path() const {
    Path path(path_.begin(), path_.begin() + static_cast<std::ptrdiff_t>(std::min(depth_, kDeepest)));
    while (!path.empty() && path.back() == PathStep(std::string())) path.pop_back();
    return path;
  }

 private:
  bool open(PathStep first) {
    ++depth_;
    if (depth_ <= kDeepest) {
      path_.resize(depth_);
      path_[depth_ - 1] = std::move(first);
    }
    return true;
  }
  bool close() {
    --depth_;
    return scalar();
  }
  // After a value: the next element of the array around it.
  bool scalar() {
    if (depth_ > 0 && depth_ <= kDeepest)
      if (auto* index = std::get_if<std::uint64_t>(&path_[depth_ - 1])) ++*index;
    return true;
  }

  Path path_;
  std::size_t depth_ = 0, position_ = 0;
  bool not_finite_ = false;
};

std::string place(std::string_view body, std::size_t position) {
  // nlohmann counts the byte it has just read, from 1.
  const std::size_t byte = std::min(position > 0 ? position - 1 : 0, body.size());
  const std::string_view before = body.substr(0, byte);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t newline = before.rfind('\n');
  const std::size_t column = newline == std::string_view::npos ? byte + 1 : byte - newline;
  return std::string("line ") + std::to_string(line) + ", column " + std::to_string(column) + " (byte " +
         std::to_string(byte) + ")";
}

}  // namespace

Error diagnose(std::string_view body) {
  Error error{ErrorCode::malformed, "the body is not valid JSON", {}, 0, 0};
  if (body.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    error.message = "the body is empty; it must be a JSON object, a GLB or a glTF";
    return error;
  }
  if (body.size() > kLongest) return error;
  Trail trail;
  if (nlohmann::json::sax_parse(body, &trail)) return error;
  if (trail.not_finite()) {
    error.code = ErrorCode::not_finite;
    error.message =
        std::string("a number is beyond what a double can hold, at ") + place(body, trail.position());
    error.where = trail.path();
    return error;
  }
  const bool ends_early = trail.position() > body.size();
  error.message = ends_early
                      ? "the body ends in the middle of its JSON; is it cut short?"
                      : std::string("the body stops being valid JSON at ") + place(body, trail.position());
  error.where = trail.path();
  return error;
}

}  // namespace subdivd::proto::json
