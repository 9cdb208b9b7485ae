#pragma once
// Many names in one text: as strings a million short ones would take ten times their bytes.

#include <string>
#include <string_view>
#include <vector>

#include "core/base/index.h"

namespace subdivd::proto {

// Numbers that stand for names may be refined as floats: beyond this, not all of them are there.
inline constexpr Count kMostNames = Count{1} << 24;

class NameList {
 public:
  void add(std::string_view name) {
    text_.append(name);
    ends_.push_back(text_.size());
  }
  Count size() const { return ends_.size(); }
  bool empty() const { return ends_.empty(); }
  std::string_view operator[](Count i) const {
    const Count begin = i == 0 ? 0 : ends_[i - 1];
    return std::string_view(text_).substr(begin, ends_[i] - begin);
  }
  // `names` of so many bytes together are to come.
  void reserve(Count names, Count bytes) {
    ends_.reserve(names);
    text_.reserve(bytes);
  }
  Count text_size() const { return text_.size(); }
  static Count bytes_of(Count names, Count text) { return names * sizeof(Count) + text; }
  bool operator==(const NameList&) const = default;

 private:
  std::string text_;
  std::vector<Count> ends_;  // in the text, of every name
};

}  // namespace subdivd::proto
