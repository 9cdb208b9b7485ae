#pragma once
// How much of everything an asset may have. What is allowed is far more than assets have, and so little that
// work which goes over all of it a few times is short. README.md states the same numbers.

#include "core/base/index.h"

namespace subdivd::proto::gltf {

inline constexpr Count kMaxRootMembers = 1024;
inline constexpr Count kMaxMeshes = 65536;
inline constexpr Count kMaxPrimitives = 65536;  // of all meshes together; of an answer, too
inline constexpr Count kMaxElements = 262144;   // of every other array at the top: accessors, nodes, …
inline constexpr Count kMaxAttributes = 64;     // of a primitive, and different ones in a mesh
inline constexpr Count kMaxNameBytes = 65536;   // of a member of any JSON object
inline constexpr Count kMaxRepeatedName = 256;  // bytes of a mesh's name that messages and statistics repeat

}  // namespace subdivd::proto::gltf
