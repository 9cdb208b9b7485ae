#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/index.h"

namespace subdivd::proto::gltf {

// One sentence for each kind of warning, however many places it concerns: a hundred thousand primitives with
// tangents are one line in the answer.
class Warnings {
 public:
  // `kind` is a sentence without its full stop; `place` a JSON Pointer.
  void add(std::string_view kind, std::string_view place);
  std::vector<std::string> sentences() const;  // in order of first appearance

 private:
  struct Entry {
    std::string kind, first_place;
    Count count = 0;
  };
  std::vector<Entry> entries_;
  std::map<std::string, std::size_t, std::less<>> known_;
};

}  // namespace subdivd::proto::gltf
