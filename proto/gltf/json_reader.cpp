// nlohmann's parser reads the document, into a tree whose memory json_shape has counted. Its text comes from
// an iterator that looks at the clock, and that leaves out what the parser would hold several times over.

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>

#include "proto/gltf/caps.h"
#include "proto/gltf/json_shape.h"
#include "proto/gltf/json_tree.h"
#include "proto/gltf/polled_sort.h"
#include "proto/suggest.h"

namespace subdivd::proto::gltf {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 16;  // bytes between two looks at the clock
// The parser's two copies of a token, each up to twice as large and both old and new while it grows.
constexpr Count kTokenCopies = 16;

Error broken_at(std::size_t byte, const std::string& what) {
  return Error{ErrorCode::malformed, "the glTF JSON is broken at byte " + std::to_string(byte) + ": " + what};
}

// The text as the parser sees it. Stopped, it is at its end.
class Feed {
 public:
  Feed(std::string_view text, const std::vector<LongText>& longs, Work& work)
      : text_(text), longs_(longs), work_(work) {
    pause();
  }
  Feed(const Feed&) = delete;
  Feed& operator=(const Feed&) = delete;

  bool at_end() const { return at_ == end_; }
  char front() const { return text_[at_]; }
  void step() {
    if (++at_ == pause_) pause();
  }

  // The string whose closing quote has just been read was left out: where it stands.
  std::optional<LongText> take_skipped() { return std::exchange(skipped_, std::nullopt); }
  void stop(Error why) {
    stopped_ = std::move(why);
    end_ = at_;
  }
  const std::optional<Error>& stopped() const { return stopped_; }
  // The byte that was read last when the parser had read `count`. What is left out next may be behind us
  // already: the iterator is one step ahead of the parser.
  std::size_t byte(std::size_t count) const {
    std::size_t at = count - 1;
    for (std::size_t i = 0; i < next_ && longs_[i].begin <= at; ++i) at += longs_[i].end - longs_[i].begin;
    return std::min(at, text_.size());
  }
  std::string_view text() const { return text_; }

 private:
  void pause() {
    if (next_ < longs_.size() && at_ == longs_[next_].begin) {
      const LongText& skip = longs_[next_++];
      if (skip.string) skipped_ = skip;
      at_ = skip.end;
    }
    if (auto why = work_.spend(kPiece / 4)) stop(*std::move(why));
    pause_ = next_ < longs_.size() ? std::min(longs_[next_].begin, at_ + kPiece) : at_ + kPiece;
  }

  std::string_view text_;
  const std::vector<LongText>& longs_;
  Work& work_;
  std::size_t at_ = 0, end_ = text_.size(), pause_ = 0, next_ = 0;
  std::optional<LongText> skipped_;
  std::optional<Error> stopped_;
};

// A Feed's place, or (default) its end.
class FeedIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = char;

  FeedIterator() = default;
  explicit FeedIterator(Feed& feed) : feed_(&feed) {}
  char operator*() const { return feed_->front(); }
  FeedIterator& operator++() {
    feed_->step();
    return *this;
  }
  FeedIterator operator++(int) = delete;
  bool operator==(const FeedIterator& end) const { return end.feed_ != nullptr || feed_->at_end(); }
  bool operator!=(const FeedIterator& end) const { return !(*this == end); }

 private:
  Feed* feed_ = nullptr;
};

using Sax = nlohmann::json_sax<nlohmann::json>;

// Appends the only string of a document to another.
class StringAppender : public Sax {
 public:
  explicit StringAppender(std::string& out) : out_(out) {}
  bool string(string_t& value) override { return out_ += value, true; }
  bool parse_error(std::size_t position, const std::string&, const nlohmann::json::exception&) override {
    return broken_ = position, false;
  }
  std::size_t broken() const { return broken_; }  // bytes read when it broke

  bool null() override { return false; }
  bool boolean(bool) override { return false; }
  bool number_integer(number_integer_t) override { return false; }
  bool number_unsigned(number_unsigned_t) override { return false; }
  bool number_float(number_float_t, const string_t&) override { return false; }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return false; }
  bool start_array(std::size_t) override { return false; }
  bool end_object() override { return false; }
  bool end_array() override { return false; }
  bool key(string_t&) override { return false; }

 private:
  std::string& out_;
  std::size_t broken_ = 0;
};

// Where a slice of a string may end: some kLongText bytes further, not within a character, an escape or a
// pair of surrogates. Of a broken string anywhere: what is broken then stands in one of the slices.
std::size_t end_of_slice(std::string_view text, std::size_t begin, std::size_t end) {
  std::size_t at = begin;
  while (at < end && at < begin + kLongText) {
    if (text[at] != '\\') {
      ++at;
    } else if (end - at < 4 || text[at + 1] != 'u') {
      at += 2;
    } else {
      const bool surrogate = (text[at + 2] | 0x20) == 'd' && text[at + 3] > '7';
      at += surrogate ? 12 : 6;
    }
  }
  for (int i = 0; i < 3 && at < end && (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80; ++i) ++at;
  return std::min(at, end);
}

// The parser reads a long string slice by slice, each a document of its own.
Result<void> read_long(std::string_view text, const LongText& whole, std::string& out, Work& work) {
  out.clear();
  out.reserve(whole.end - whole.begin);
  std::string slice;
  for (std::size_t begin = whole.begin; begin < whole.end;) {
    const std::size_t end = end_of_slice(text, begin, whole.end);
    slice = '"';
    slice += text.substr(begin, end - begin);
    slice += '"';
    StringAppender appender(out);
    if (!nlohmann::json::sax_parse(slice.begin(), slice.end(), &appender))
      return broken_at(begin + std::max<std::size_t>(appender.broken(), 2) - 2,
                       "this cannot stand in a string");
    if (auto stop = work.spend(4 * (end - begin))) return *std::move(stop);
    begin = end;
  }
  return {};
}

// Builds the tree from the parser's events. It keeps no stack of calls.
class TreeBuilder : public Sax {
 public:
  TreeBuilder(Feed& feed, const JsonShape& shape, Work& work) : feed_(feed), shape_(shape), work_(work) {}

  bool null() override { return put(Json()); }
  bool boolean(bool value) override { return put(Json(value)); }
  // Only what has a minus is an integer with a sign.
  bool number_integer(number_integer_t value) override {
    return put(Json::raw(value == 0 ? "-0" : std::to_string(value)));
  }
  bool number_unsigned(number_unsigned_t value) override { return put(Json::raw(std::to_string(value))); }
  bool number_float(number_float_t, const string_t& text) override { return put(Json::raw(text)); }
  bool string(string_t& value) override;
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(Json(Json::Object())); }
  bool start_array(std::size_t) override { return open(Json(Json::Array())); }
  bool end_array() override { return open_.pop_back(), true; }
  bool key(string_t& name) override;
  bool end_object() override;
  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::json::exception& reason) override;

  Json take() { return std::move(root_); }
  const std::optional<Error>& error() const { return error_; }

 private:
  bool put(Json value) { return place(std::move(value)) != nullptr; }
  bool open(Json container);
  Json* place(Json value);
  Result<std::string> whole(const std::string& value);
  Result<void> check_names(const Json::Object& members);
  Path path() const;
  bool fail(Error error) { return error_ = std::move(error), false; }

  Feed& feed_;
  const JsonShape& shape_;
  Work& work_;
  Json root_;
  Count opened_ = 0;
  // Outermost first. A container's own array does not move while one of its elements is open.
  std::vector<Json*> open_;
  std::optional<Error> error_;
};

Json* TreeBuilder::place(Json value) {
  if (auto stop = work_.spend(8)) return fail(*std::move(stop)), nullptr;
  if (open_.empty()) return &(root_ = std::move(value));
  if (Json::Array* array = open_.back()->array()) return &array->emplace_back(std::move(value));
  return &(open_.back()->object()->back().value = std::move(value));
}

bool TreeBuilder::open(Json container) {
  Json* const slot = place(std::move(container));
  if (slot == nullptr) return false;
  const Index size = opened_ < shape_.sizes.size() ? shape_.sizes[opened_] : 0;
  ++opened_;
  if (Json::Array* array = slot->array())
    array->reserve(size);
  else
    slot->object()->reserve(size);
  open_.push_back(slot);
  return true;
}

// What the parser has read, exactly as long as it is, or what it was not shown.
Result<std::string> TreeBuilder::whole(const std::string& value) {
  const auto skipped = feed_.take_skipped();
  if (!skipped) return std::string(value);
  std::string read;
  if (auto good = read_long(feed_.text(), *skipped, read, work_); !good) return good.error();
  return read;
}

bool TreeBuilder::string(string_t& value) {
  auto text = whole(value);
  if (!text) return fail(text.error());
  return put(Json(*std::move(text)));
}

bool TreeBuilder::key(string_t& name) {
  auto text = whole(name);
  if (!text) return fail(text.error());
  if (text->size() > kMaxNameBytes)
    return fail({.code = ErrorCode::too_large,
                 .message = "the name of a member has " + std::to_string(text->size()) + " bytes; " +
                            std::to_string(kMaxNameBytes) + " are allowed",
                 .where = path(),
                 .predicted = text->size(),
                 .allowed = kMaxNameBytes});
  open_.back()->object()->push_back({*std::move(text), Json()});
  return true;
}

bool TreeBuilder::end_object() {
  if (auto good = check_names(*open_.back()->object()); !good) return fail(good.error());
  open_.pop_back();
  return true;
}

// Readers disagree on which of two equal names counts, so a file with both is two files.
Result<void> TreeBuilder::check_names(const Json::Object& members) {
  if (members.size() < 2) return {};
  auto held = work_.hold(members.size() * sizeof(void*));
  if (!held) return held.error();
  std::vector<const std::string*> names;
  names.reserve(members.size());
  Count bytes = 0;
  for (const Json::Member& member : members) {
    names.push_back(&member.name);
    bytes += member.name.size();
  }
  // Names may begin alike for as long as they are.
  const Count cost = 1 + bytes / members.size() / 64;
  const auto by_name = [](const std::string* a, const std::string* b) { return *a < *b; };
  if (auto sorted = polled_sort(names, by_name, work_, cost); !sorted) return sorted;
  const auto twice =
      std::adjacent_find(names.begin(), names.end(), [](const auto* a, const auto* b) { return *a == *b; });
  if (twice == names.end()) return {};
  Error error{ErrorCode::duplicate_field,
              "the member " + in_quotes(**twice) + " appears twice; write it once", path(), 0, 0};
  error.where.back() = **twice;
  return error;
}

bool TreeBuilder::parse_error(std::size_t position, const std::string&,
                              const nlohmann::json::exception& reason) {
  constexpr int kOutOfRange = 406;
  const std::size_t byte = feed_.byte(position);
  if (reason.id == kOutOfRange)
    return fail(broken_at(byte, "the number before it is too large for double precision"));
  if (byte >= feed_.text().size()) return fail(broken_at(byte, "the text ends here"));
  const char c = feed_.text()[byte];
  if (c > ' ' && c <= '~') return fail(broken_at(byte, std::string("'") + c + "' cannot stand here"));
  return fail(broken_at(byte, "this character, or part of one, cannot stand here"));
}

Path TreeBuilder::path() const {
  Path path;
  for (const Json* container : open_) {
    if (const Json::Array* array = container->array()) {
      path.emplace_back(std::uint64_t{array->empty() ? 0 : array->size() - 1});
    } else if (const Json::Object* object = container->object(); !object->empty()) {
      path.emplace_back(object->back().name);
    }
  }
  return path;
}

// Others take NUL for the end: what hides behind one would be read by some and not by others.
Result<std::string_view> without_nuls(std::string_view text, Work& work) {
  const std::size_t nul = text.find('\0');
  if (nul == std::string_view::npos) return text;
  for (std::size_t at = nul; at < text.size(); at += kPiece) {
    if (text.substr(at, kPiece).find_first_not_of('\0') != std::string_view::npos)
      return Error{ErrorCode::malformed, "the glTF JSON has a NUL at byte " + std::to_string(nul)};
    if (auto stop = work.spend(kPiece / 8)) return *std::move(stop);
  }
  return text.substr(0, nul);
}

}  // namespace

Result<Json> parse_json(std::string_view whole, const JsonLimits& limits, Work& work) {
  const auto text = without_nuls(whole, work);
  if (!text) return text.error();
  const auto shape = shape_of(*text, limits, work);
  if (!shape) return shape.error();
  if (auto kept = work.keep(shape->bytes); !kept) return kept.error();
  const auto held = work.hold(kTokenCopies * std::min<Count>(text->size(), kLongText));
  if (!held) return held.error();
  Feed feed(*text, shape->longs, work);
  TreeBuilder builder(feed, *shape, work);
  const bool complete = nlohmann::json::sax_parse(FeedIterator(feed), FeedIterator(), &builder);
  work.drop(memory_of(*shape));
  if (feed.stopped()) return *feed.stopped();
  if (builder.error()) return *builder.error();
  if (!complete) return broken_at(0, "it is no JSON");
  return builder.take();
}

}  // namespace subdivd::proto::gltf
