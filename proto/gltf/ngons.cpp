#include "proto/gltf/ngons.h"

#include <utility>

namespace subdivd::proto::gltf {

const Json* ngon_encoding_of(const Json& primitive) {
  const Json* extensions = primitive.find("extensions");
  return extensions == nullptr ? nullptr : extensions->find(kNgonEncoding);
}

void set_ngon_encoding(Json& primitive) {
  Json* extensions = primitive.find("extensions");
  if (extensions == nullptr || extensions->object() == nullptr)
    extensions = &primitive.set("extensions", Json::Object());
  extensions->set(kNgonEncoding, Json::Object());
}

bool drop_ngon_encoding(Json& primitive) {
  if (ngon_encoding_of(primitive) == nullptr) return false;
  Json& extensions = *primitive.find("extensions");
  extensions.erase(kNgonEncoding);
  if (extensions.object()->empty()) primitive.erase("extensions");
  return true;
}

Result<void> join_triangles(std::vector<Index>& corners, std::span<const Index> points,
                            std::vector<Index>& faces_of, std::vector<Index>& sizes, Work& work) {
  Count written = 0;
  bool open = false;  // whether the last face may be continued: a triangle that repeats a point is not
  Index first = kNoIndex, last = kNoIndex;
  for (Count t = 0; t < corners.size(); t += 3) {
    if (auto stop = work.spend(1)) return *std::move(stop);
    const Index a = corners[t], b = corners[t + 1], c = corners[t + 2];
    const auto current = static_cast<Index>(sizes.size()) - 1;  // of an open face
    if (open && a == first && b == last && faces_of[points[c]] != current) {
      ++sizes.back();
      corners[written++] = c;
      faces_of[points[c]] = current;
    } else {
      open = points[a] != points[b] && points[b] != points[c] && points[c] != points[a];
      for (const Index corner : {a, b, c}) {
        corners[written++] = corner;
        faces_of[points[corner]] = static_cast<Index>(sizes.size());
      }
      sizes.push_back(3);
      first = a;
    }
    last = c;
  }
  corners.resize(written);
  return {};
}

}  // namespace subdivd::proto::gltf
