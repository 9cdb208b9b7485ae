#pragma once
// The glTF 2.0 encoding of requests and answers.
//
// read: every triangle primitive of a glTF mesh together is one ControlMesh (points welded per options.weld;
// its RenderMeshes are the primitives, in order; TEXCOORD_n and COLOR_n are face-varying primvars whose
// values are welded per point when bit-identical); every line primitive is one ControlCurves, LINES with open
// and closed chains are two. write: patches the original document (materials, nodes, … kept), or makes a new
// one for a JSON request.

#include <string_view>
#include <vector>

#include "core/base/budget.h"
#include "core/base/result.h"
#include "proto/wire.h"

namespace subdivd::proto::gltf {

// `options` are already known (weld is needed while reading); the request's options are set to them, with
// normals when any primitive had them. Error::where is a path into the glTF JSON.
Result<RefineRequest> read(std::string_view body, Format format, const Options& options, const Limits& limits,
                           const Budget& budget = {});

// For a checked JSON request that will be answered in glTF, before it is predicted and refined: gives meshes
// with face-varying primvars the render mesh that says where their vertices split. Without one write() leaves
// those primvars out.
Result<void> add_render_meshes(RefineRequest& request, const Budget& budget = {});

// Exact size of the BIN chunk (no holes, boundary not "none"; otherwise an upper bound) plus an upper bound
// of all other bytes of the answer. Refuses an answer of more primitives than caps.h allows.
Result<Count> predicted_bytes(const RefineRequest& request, const std::vector<RefinedSize>& meshes,
                              const Budget& budget = {});

// Format::glb or Format::gltf (embedded base64). `envelope` is a JSON object for asset.extras.subdivd.
Result<Payload> write(const RefineRequest& request, AnyAnswer answer, Format format,
                      std::string_view envelope, const Budget& budget = {});

}  // namespace subdivd::proto::gltf
