#include "proto/gltf/warnings.h"

namespace subdivd::proto::gltf {

void Warnings::add(std::string_view kind, const Place& place, Count amount) {
  auto found = known_.find(kind);
  if (found == known_.end()) {
    found = known_.emplace(std::string(kind), entries_.size()).first;
    entries_.push_back({std::string(kind), place.pointer(), 0, 0});
  }
  Entry& entry = entries_[found->second];
  ++entry.places;
  entry.amount += amount;
}

std::vector<std::string> Warnings::sentences() const {
  std::vector<std::string> sentences;
  for (const Entry& entry : entries_) {
    std::string sentence = entry.kind;
    if (entry.amount > 0) sentence += ": " + std::to_string(entry.amount);
    if (!entry.first_place.empty()) {
      sentence += " (" + entry.first_place;
      if (entry.places > 1) sentence += " and " + std::to_string(entry.places - 1) + " more";
      sentence += ")";
    }
    sentences.push_back(sentence + ".");
  }
  return sentences;
}

}  // namespace subdivd::proto::gltf
