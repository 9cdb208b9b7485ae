#pragma once
// FB_ngon_encoding: a list of triangles in which the order of corners tells which triangles were one polygon. The
// polygon is a fan of triangles, one after the other, all of which begin with the same index; the next polygon begins
// with another one. The extension has no data: its empty object on a primitive says so.
// (Draft of a vendor extension: github.com/KhronosGroup/glTF/pull/1620.)

#include <span>
#include <string_view>
#include <vector>

#include "core/base/index.h"
#include "core/base/result.h"
#include "proto/gltf/json_tree.h"
#include "proto/gltf/work.h"

namespace subdivd::proto::gltf {

inline constexpr std::string_view kNgonEncoding = "FB_ngon_encoding";

// The extension on a primitive; null: there is none.
const Json* ngon_encoding_of(const Json& primitive);
void set_ngon_encoding(Json& primitive);
// False: there was none.
bool drop_ngon_encoding(Json& primitive);

// Makes faces of triangles, in place: a triangle continues the face before it if it begins with that face's first
// corner and then its last, and brings a point that the face does not have. Any other begins a face, so that no face
// repeats a point unless one triangle does. `corners`: of triangles, 3 each; afterwards of the faces, one after the
// other. `points`: of every vertex that corners name, its point. `faces_of`: of every point the last face that has it,
// kNoIndex where none has; `sizes`: of the mesh's faces before these, to which those of these are appended; whoever
// calls has made room for one of each triangle.
Result<void> join_triangles(std::vector<Index>& corners, std::span<const Index> points,
                            std::vector<Index>& faces_of, std::vector<Index>& sizes, Work& work);

}  // namespace subdivd::proto::gltf
