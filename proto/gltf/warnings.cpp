#include "proto/gltf/warnings.h"

namespace subdivd::proto::gltf {

void Warnings::add(std::string_view kind, std::string_view place) {
  auto found = known_.find(kind);
  if (found == known_.end()) {
    found = known_.emplace(std::string(kind), entries_.size()).first;
    entries_.push_back({std::string(kind), std::string(place), 0});
  }
  ++entries_[found->second].count;
}

std::vector<std::string> Warnings::sentences() const {
  std::vector<std::string> sentences;
  for (const Entry& entry : entries_) {
    std::string sentence = entry.kind + " (" + entry.first_place;
    if (entry.count > 1) sentence += " and " + std::to_string(entry.count - 1) + " more";
    sentences.push_back(sentence + ").");
  }
  return sentences;
}

}  // namespace subdivd::proto::gltf
