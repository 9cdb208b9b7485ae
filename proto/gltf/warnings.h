#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/index.h"
#include "proto/gltf/fields.h"

namespace subdivd::proto::gltf {

// One sentence for each kind of warning, however many places it concerns: a hundred thousand primitives with
// tangents are one line in the answer.
class Warnings {
 public:
  // `kind` is a sentence without its full stop; what `amount` counts is added up over all places.
  void add(std::string_view kind, const Place& place, Count amount = 0);
  std::vector<std::string> sentences() const;  // in order of first appearance

 private:
  struct Entry {
    std::string kind, first_place;
    Count places = 0, amount = 0;
  };
  std::vector<Entry> entries_;
  std::map<std::string, std::size_t, std::less<>> known_;
};

}  // namespace subdivd::proto::gltf
