#pragma once
// Requests and answers as they travel, in terms of core types. What may be left out, its default and its unit
// stand in the table of proto/options; the JSON spelling in proto/json, the glTF mapping in proto/gltf.

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/byte_maker.h"
#include "core/base/index.h"
#include "core/curves/subdivision.h"
#include "core/mesh/control_mesh.h"
#include "core/oracle/report.h"
#include "core/refine/refine.h"
#include "core/refine/refined_mesh.h"
#include "core/surfaces/patch.h"
#include "proto/name_list.h"

namespace subdivd::proto {

enum class Format { json, glb, gltf, obj, off };
enum class Precision { single_precision, double_precision };  // "single", "double" on the wire
enum class Faces { triangles, quads };                        // of meshes and B-spline surfaces
enum class Weld {
  exact,  // glTF vertices of one mesh with bit-identical positions are one point for connectivity (-0 == +0)
  none,   // the input's indices are the connectivity
};

// Limits of one request, from the server's configuration.
struct Limits {
  Index max_level = 8;
  Count max_output_bytes = Count{1} << 30;
  Count max_body_bytes = Count{256} << 20;
  Index max_json_depth = 64;
};

// What the request asked for; absent optionals follow the body (interpolateBoundary, …) or the input
// (format).
struct Options {
  Index level = 2;
  bool limit = false;
  bool normals = false;
  bool verify = false;
  bool triangulate = false;
  bool ngons = false;       // glTF answers: mark the triangles that make quads and larger faces
  AllSchemes schemes = {};  // the options of every scheme that meshes may name
  CreaseMethod crease_method = CreaseMethod::uniform;
  Weld weld = Weld::exact;
  std::optional<Index> subdivision_scheme;  // place in kSchemeNames; overrides every mesh of the body
  std::optional<BoundaryInterpolation> interpolate_boundary;  // overrides every mesh of the body
  std::optional<FaceVaryingInterpolation> face_varying_linear_interpolation;
  std::optional<Faces> faces;          // default: those there are; glTF answers have triangles always
  std::optional<Precision> precision;  // default: single for glTF answers, double for others
  std::optional<Format> format;        // default: the kind that came in
};

// How arrays of tuples were written in the JSON body; the answer follows.
enum class ArrayForm { nested, flat };

// Which way a mesh's faces run, seen from outside: counter-clockwise or clockwise. The core knows the first
// only; what it makes of the faces as they are is turned when it is written.
enum class Orientation { right_handed, left_handed };

struct JsonMeshForm {
  ArrayForm points = ArrayForm::nested;
  ArrayForm faces = ArrayForm::flat;                    // faceVertexIndices
  ArrayForm creases = ArrayForm::flat;                  // creaseIndices
  std::vector<ArrayForm> primvars;                      // values, in the order of ControlMesh::primvars
  Orientation orientation = Orientation::right_handed;  // of the mesh as it is now, see prepare()
};

struct JsonCurvesForm {
  ArrayForm points = ArrayForm::nested;
  ArrayForm ranges = ArrayForm::nested;
  bool order_list = false;  // order is an array
};

struct JsonSurfaceForm {
  ArrayForm points = ArrayForm::nested;
  // What the body has itself; the rest followed from its other members.
  bool u_degree = true, v_degree = true, u_count = true, v_count = true;
};

namespace gltf {
class Source;  // the original document and its buffers, for patching (proto/gltf/source.h)
}

struct RefineRequest {
  Format input = Format::json;  // of OBJ and OFF, too: unless they are asked for, answers are JSON
  bool from_text = false;       // OBJ or OFF, whose numbers no JSON Pointer leads to
  Options options;
  std::vector<ControlMesh> meshes;  // checked: check() has passed
  std::vector<ControlCurves> curves;
  std::vector<ControlPatch> surfaces;
  // For every mesh the face of the input that each face came from, when faces were dropped or triangulated
  // (otherwise empty: they are the input's faces).
  std::vector<std::vector<Index>> face_origins;
  std::vector<std::string> warnings;  // what is not carried over or was repaired, one sentence each
  // For every mesh and primvar the names that its whole numbers stand for, if any; either list may be shorter.
  std::vector<std::vector<NameList>> primvar_names;
  NameList material_libraries;  // that an OBJ names, for an answer in its format
  // JSON only
  bool single_mesh_at_top = false, single_curve_at_top = false, single_surface_at_top = false;
  bool without_meshes = false;  // the door takes none, and its answers name none
  std::vector<JsonMeshForm> mesh_forms;
  std::vector<JsonCurvesForm> curve_forms;
  std::vector<JsonSurfaceForm> surface_forms;
  // glTF only: meshes and curves of this request belong to source in the order it knows
  std::shared_ptr<const gltf::Source> source;
};

template <class Real>
struct RefineAnswer {
  std::vector<RefinedMesh<Real>> meshes;  // in the order of the request
  std::vector<RefinedCurves<Real>> curves;
  std::vector<RefinedPatch<Real>> surfaces;
  std::optional<oracle::Report> verification;
};
using AnyAnswer = std::variant<RefineAnswer<float>, RefineAnswer<double>>;

// What an answer of this format is sent as. OFF has no type of its own: "text/plain; charset=utf-8".
std::string_view media_type(Format format);
inline bool is_gltf(Format format) { return format == Format::glb || format == Format::gltf; }
inline bool is_text(Format format) { return format == Format::obj || format == Format::off; }

// Effective values of what Options leaves open.
Format answer_format(const RefineRequest& request);
Precision answer_precision(const RefineRequest& request);
Faces answer_faces(const RefineRequest& request);

// The names that the numbers of a mesh's primvar stand for; none where they are plain numbers.
const NameList& names_of(const RefineRequest& request, std::size_t mesh, std::size_t primvar);

// What the request asks of the core, for every mesh, curve and surface of it alike.
RefineOptions mesh_options(const RefineRequest& request);
CurveOptions curve_options(const RefineRequest& request, const ControlCurves& curves);
PatchOptions patch_options(const RefineRequest& request, const ControlPatch& patch);

// A piece of an answer's body: bytes and whatever keeps them alive, or what makes them while they are sent.
struct Chunk {
  std::shared_ptr<const void> owner;
  std::span<const std::byte> bytes;
  std::shared_ptr<ByteMaker> maker = nullptr;  // where it is set, `bytes` is empty

  Count size() const { return maker ? maker->size() : bytes.size(); }

  static Chunk own(std::string text);
  template <class T, class Allocator>
  static Chunk own(std::vector<T, Allocator> values) {
    auto kept = std::make_shared<const std::vector<T, Allocator>>(std::move(values));
    return {kept, std::as_bytes(std::span(*kept))};
  }
};

struct Payload {
  std::string content_type;   // media_type() of its format
  std::vector<Chunk> chunks;  // sent one after the other
  Count size() const {
    Count total = 0;
    for (const Chunk& chunk : chunks) total += chunk.size();
    return total;
  }
};

}  // namespace subdivd::proto
