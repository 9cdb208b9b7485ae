// The GLB and glTF decoder, and the encoder of whatever it lets through.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "core/refine/refine.h"
#include "proto/gltf/gltf.h"

using namespace subdivd;

namespace {

// Level 0 keeps the cost at the decoder; what it lets through must then refine and encode.
void answer(const proto::RefineRequest& request) {
  RefineOptions options{.level = 0, .normals = request.options.normals};
  proto::RefineAnswer<float> refined;
  Budget budget;
  budget.max_bytes = Count{1} << 24;
  for (const ControlMesh& mesh : request.meshes) {
    auto made = refine<float>(mesh, options, budget);
    if (!made) return;
    refined.meshes.push_back(*std::move(made));
  }
  for (const ControlCurves& curves : request.curves) {
    auto made = refine<float>(curves, CurveOptions{.level = 0}, budget);
    if (!made) return;
    refined.curves.push_back(*std::move(made));
  }
  (void)proto::gltf::write(request, std::move(refined), proto::Format::glb, "{}");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view body(reinterpret_cast<const char*>(data), size);
  const auto format = body.starts_with("glTF") ? proto::Format::glb : proto::Format::gltf;
  proto::Options options;
  options.level = 0;
  proto::Limits limits;
  limits.max_output_bytes = Count{1} << 24;
  auto request = proto::gltf::read(body, format, options, limits);
  if (!request) {
    // A refusal blamed on ourselves means that something unchecked reached the reader library.
    if (request.error().code == ErrorCode::internal) std::abort();
    return 0;
  }
  for (ControlMesh& mesh : request->meshes) {
    if (!drop_degenerate_faces(mesh)) return 0;
    // What the reader makes is never at fault in itself.
    if (!mesh.check()) std::abort();
  }
  answer(*request);
  return 0;
}
