#include "proto/json/words.h"

#include "proto/json/read_mesh.h"
#include "proto/json/read_primvar.h"
#include "proto/options.h"

namespace subdivd::proto::json {

std::string_view word_of(Interpolation interpolation) {
  return interpolation_words()[static_cast<std::size_t>(interpolation)];
}

std::string_view word_of(BoundaryInterpolation interpolation) {
  return find_option("interpolateBoundary")->words[static_cast<std::size_t>(interpolation)];
}

std::string_view word_of(FaceVaryingInterpolation interpolation) {
  return find_option("faceVaryingLinearInterpolation")->words[static_cast<std::size_t>(interpolation)];
}

std::string_view word_of(CurveWrap wrap) { return wrap_words()[static_cast<std::size_t>(wrap)]; }

}  // namespace subdivd::proto::json
