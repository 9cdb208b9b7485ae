#pragma once
// A glTF document that grows by arrays of data, and its last step into GLB or embedded glTF.

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/buffer.h"
#include "core/base/result.h"
#include "core/lattice/triangles.h"
#include "proto/gltf/floats.h"
#include "proto/gltf/source.h"
#include "proto/wire.h"

namespace subdivd::proto::gltf {

enum class Target : Count { vertices = 34962, indices = 34963 };

class Output {
 public:
  // `data`: what buffer 0 holds already, a multiple of 4 bytes. What the answer's own bytes take was
  // predicted and asked for by whoever sends it; what else there must be beside them is asked for here.
  Output(Json document, Chunk data, Format format, Work& work);

  Json& primitive(Index mesh, Index primitive);
  // Both append one bufferView and one accessor and return the accessor's number.
  // values: `components` per element; 1 SCALAR, 2..4 VECn. `bounds`: of them, where it has any.
  Index add_floats(Buffer<float> values, Index components, const FloatScan& bounds);
  // Of 16 bits where `vertex_count` allows it.
  Result<Index> add_indices(Buffer<Index> values, Index vertex_count);
  // The same; where they are many, they are made while the answer is sent.
  Result<Index> add_indices(TriangleStream triangles, Index vertex_count);

  // Names it among those in use.
  void use_extension(std::string_view name);

  Json& asset() { return *document_.find("asset"); }
  // `source` owns `foreign` and stays alive as long as the answer.
  Result<Payload> finish(const std::shared_ptr<const void>& source,
                         const std::vector<Source::Foreign>& foreign) &&;

 private:
  Index add_accessor(Chunk data, Count count, Count component, std::string_view type, Target target,
                     Json bounds);
  Result<Payload> finish_glb(const std::shared_ptr<const void>& source,
                             const std::vector<Source::Foreign>& foreign);
  Result<Payload> finish_gltf();

  Json document_;
  Format format_;
  Work& work_;
  Json::Array views_, accessors_;        // of the document, while they grow
  Json::Array* meshes_ = nullptr;        // null: the document has none
  std::vector<std::string> extensions_;  // that the document must name
  std::vector<Chunk> chunks_;
  Count size_ = 0;
};

// Upper bound of the JSON text that one add_… makes.
inline constexpr Count kAccessorTextBytes = 512;
inline constexpr Count index_bytes(Count indices, Count vertices) {
  return (indices * (vertices <= 65535 ? 2 : 4) + 3) / 4 * 4;
}

}  // namespace subdivd::proto::gltf
