#include "proto/openapi/compose.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace subdivd::proto::openapi {
namespace {

constexpr auto kUse = "$use";

class Composer {
 public:
  explicit Composer(const Json& shared) : shared_(shared) {}

  Json value(const Json& text) {
    if (text.is_array()) return array(text);
    if (!text.is_object()) return text;
    if (only_use(text)) return named(text[kUse].get<std::string>());
    return object(text);
  }

 private:
  static bool only_use(const Json& text) {
    return text.is_object() && text.size() == 1 && text.contains(kUse) && text[kUse].is_string();
  }

  Json array(const Json& text) {
    Json made = Json::array();
    for (const Json& element : text) {
      Json one = value(element);
      if (only_use(element) && one.is_array())
        made.insert(made.end(), one.begin(), one.end());
      else
        made.push_back(std::move(one));
    }
    return made;
  }

  Json object(const Json& text) {
    Json made = Json::object();
    if (text.contains(kUse)) {
      const Json& names = text[kUse];
      for (const Json& name : names.is_array() ? names : Json::array({names})) {
        const Json members = named(name.get<std::string>());
        if (!members.is_object())
          throw std::runtime_error(name.get<std::string>() + " has no members to use");
        made.update(members);
      }
    }
    for (const auto& [name, member] : text.items())
      if (name != kUse) made[name] = value(member);
    return made;
  }

  Json named(const std::string& name) {
    if (!shared_.contains(name)) throw std::runtime_error("$use: there is no " + name);
    for (const std::string& outer : open_)
      if (outer == name) throw std::runtime_error("$use: " + name + " uses itself");
    open_.push_back(name);
    Json made = value(shared_[name]);
    open_.pop_back();
    return made;
  }

  const Json& shared_;
  std::vector<std::string> open_;  // names whose values are being composed, outermost first
};

}  // namespace

Json compose(const Json& text, const Json& shared) { return Composer(shared).value(text); }

}  // namespace subdivd::proto::openapi
