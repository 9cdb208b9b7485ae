// The GLB and glTF decoder, and the encoder of whatever it lets through.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "core/mesh/repair.h"
#include "proto/gltf/gltf.h"
#include "server/tasks/refine_task.h"

using namespace subdivd;

namespace {

// Level 0 keeps the cost at the decoder; what it lets through must then refine and encode.
void answer(const proto::RefineRequest& request) {
  proto::Limits limits;
  limits.max_output_bytes = Count{1} << 24;
  server::tasks::Phases phases;
  (void)server::tasks::refine(request, limits, Budget(), phases);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view body(reinterpret_cast<const char*>(data), size);
  const auto format = body.starts_with("glTF") ? proto::Format::glb : proto::Format::gltf;
  proto::Options options;
  options.level = 0;
  options.format = proto::Format::glb;
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
