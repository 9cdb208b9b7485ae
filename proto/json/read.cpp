#include <algorithm>

#include "proto/json/cursor.h"
#include "proto/json/document.h"
#include "proto/json/json.h"
#include "proto/json/read_mesh.h"
#include "proto/options.h"

namespace subdivd::proto::json {
namespace {

// An empty mesh takes 40 bytes of text and over a thousand here, in the engine and in the answer.
constexpr std::size_t kMostObjects = 65536;

template <class ReadOne>
bool each(Cursor& cursor, std::string_view right, ReadOne read_one) {
  if (!cursor.open_array(right)) return false;
  for (Cursor::Elements all(cursor); all.next();) {
    if (all.index() == kMostObjects)
      return cursor.fail(ErrorCode::too_large,
                         std::string("there are more than ") + std::to_string(kMostObjects) + " of them");
    const Cursor::Step step(cursor, all.index());
    if (!read_one()) return false;
  }
  return !cursor.failed();
}

void warn_once(std::vector<std::string>& warnings, bool& warned, const char* text) {
  if (!warned) warnings.emplace_back(text);
  warned = true;
}

class DocumentReader {
 public:
  DocumentReader(Cursor& cursor, const Limits& limits, RefineRequest& out)
      : cursor_(cursor), limits_(limits), out_(out), top_mesh_(cursor) {}

  // The members of a mesh may stand at the top, too.
  static constexpr std::size_t kOwnMembers = 7;
  static constexpr std::size_t kMembers = kOwnMembers + MeshReader::kMembers;
  static const std::array<Cursor::Member<DocumentReader>, kMembers>& members();

  bool read() {
    std::bitset<kMembers> seen;
    if (!cursor_.read_members(members(), *this, seen)) return false;
    if ((seen >> kOwnMembers).any()) {
      if (seen[0])
        return cursor_.fail(ErrorCode::duplicate_field,
                            "the body has meshes and members of a single mesh; give one or the other",
                            {"meshes"});
      if (!top_mesh_.finish()) return false;
      out_.single_mesh_at_top = true;
      add(top_mesh_.take());
      return true;
    }
    if (seen[0] || seen[1] || seen[2]) return true;
    return cursor_.fail(ErrorCode::missing_field,
                        "the body holds nothing to refine; give points and "
                        "faceVertexIndices, or meshes, curves or surfaces");
  }

  bool meshes() {
    return each(cursor_, "an array of meshes", [&] {
      MeshRead mesh;
      if (!read_mesh(cursor_, mesh)) return false;
      add(std::move(mesh));
      return true;
    });
  }

  bool curves() { return read_curve_list(cursor_, out_); }

  bool surfaces() { return read_surface_list(cursor_, out_); }

  bool options() { return read_options(cursor_, limits_.max_json_depth, out_.options, option_names()); }

  // Members of an answer: it is a valid request, so they may stand here. They are looked at, not used.
  bool ignored() { return cursor_.skip(limits_.max_json_depth); }

  template <bool (MeshReader::*member)()>
  bool of_mesh() {
    return (top_mesh_.*member)();
  }

 private:
  void add(MeshRead mesh) {
    if (mesh.had_normals)
      warn_once(out_.warnings, normals_warned_,
                "normals of the body are not used; ask for new ones with the option normals");
    out_.meshes.push_back(std::move(mesh.mesh));
    out_.mesh_forms.push_back(std::move(mesh.form));
    out_.primvar_names.push_back(std::move(mesh.primvar_names));
  }

  Cursor& cursor_;
  const Limits& limits_;
  RefineRequest& out_;
  MeshReader top_mesh_;
  bool normals_warned_ = false;
};

const std::array<Cursor::Member<DocumentReader>, DocumentReader::kMembers>& DocumentReader::members() {
  using D = DocumentReader;
  using M = MeshReader;
  static constexpr std::array<Cursor::Member<D>, kMembers> table = {{
      {"meshes", &D::meshes},
      {"curves", &D::curves},
      {"surfaces", &D::surfaces},
      {"options", &D::options},
      {"statistics", &D::ignored},
      {"warnings", &D::ignored},
      {"verification", &D::ignored},
      {"name", &D::of_mesh<&M::name>},
      {"points", &D::of_mesh<&M::points>},
      {"faceVertexCounts", &D::of_mesh<&M::face_vertex_counts>},
      {"faceVertexIndices", &D::of_mesh<&M::face_vertex_indices>},
      {"orientation", &D::of_mesh<&M::orientation>},
      {"subdivisionScheme", &D::of_mesh<&M::subdivision_scheme>},
      {"triangleSubdivisionRule", &D::of_mesh<&M::triangle_subdivision_rule>},
      {"interpolateBoundary", &D::of_mesh<&M::interpolate_boundary>},
      {"faceVaryingLinearInterpolation", &D::of_mesh<&M::face_varying_linear_interpolation>},
      {"creaseIndices", &D::of_mesh<&M::crease_indices>},
      {"creaseLengths", &D::of_mesh<&M::crease_lengths>},
      {"creaseSharpnesses", &D::of_mesh<&M::crease_sharpnesses>},
      {"cornerIndices", &D::of_mesh<&M::corner_indices>},
      {"cornerSharpnesses", &D::of_mesh<&M::corner_sharpnesses>},
      {"holeIndices", &D::of_mesh<&M::hole_indices>},
      {"primvars", &D::of_mesh<&M::primvars>},
      {"normals", &D::of_mesh<&M::normals>},
  }};
  return table;
}

}  // namespace

bool read_curve_list(Cursor& cursor, RefineRequest& out) {
  bool warned = false;
  return each(cursor, "an array of curves", [&] {
    CurvesRead curves;
    if (!read_curves(cursor, curves)) return false;
    if (curves.had_tangents) warn_once(out.warnings, warned, "tangents of the body are not used");
    out.curves.push_back(std::move(curves.curves));
    out.curve_forms.push_back(curves.form);
    return true;
  });
}

bool read_surface_list(Cursor& cursor, RefineRequest& out) {
  return each(cursor, "an array of surfaces", [&] {
    CurvesRead read;
    if (!read_surface(cursor, read)) return false;
    out.surfaces.push_back(*std::move(read.surface));
    out.surface_forms.push_back(read.surface_form);
    return true;
  });
}

namespace {

// The value of an option, of whatever type it is; arrays and objects are looked at and left.
bool read_option_value(Cursor& cursor, std::size_t deepest, OptionValue& out) {
  switch (cursor.type()) {
    case Type::boolean:
      return cursor.read_bool(out.boolean.emplace(), "true or false");
    case Type::number:
      return cursor.read_number(out.number.emplace(), "a number within range");
    case Type::string:
      return cursor.read_string(out.text.emplace());
    case Type::null:
      out.other = "null";
      return cursor.read_null();
    case Type::array:
      out.other = "an array";
      return cursor.skip(deepest);
    case Type::object:
      out.other = "an object";
      return cursor.skip(deepest);
    case Type::none:
      break;
  }
  return cursor.fail_syntax();
}

}  // namespace

bool read_options(Cursor& cursor, std::size_t deepest, Options& out,
                  std::span<const std::string_view> taken) {
  if (!cursor.open_object("an object of options")) return false;
  std::bitset<64> seen;
  std::string_view key;
  for (Cursor::Members all(cursor); all.next(key);) {
    const OptionSpec* const spec = find_option(key);
    const Cursor::Step step(cursor, key);
    if (Result<void> known = check_option(key, taken, cursor.path()); !known)
      return cursor.fail_as(std::move(known).error());
    const auto number = static_cast<std::size_t>(spec - option_table().data());
    if (seen[number])
      return cursor.fail(ErrorCode::duplicate_field,
                         "the member " + in_quotes(key) + " is given twice; give it once");
    seen.set(number);
    OptionValue given;
    if (!read_option_value(cursor, deepest, given)) return false;
    if (Result<void> done = set_option(out, spec->name, given, cursor.path()); !done)
      return cursor.fail_as(std::move(done).error());
  }
  return !cursor.failed();
}

Result<void> read_document(std::string_view body, const Budget& budget,
                           const std::function<bool(Cursor&)>& read) {
  Cursor cursor(body, budget);
  const auto walk = [&] {
    const Type type = cursor.type();
    if (type == Type::none && cursor.at_end())
      return cursor.fail(ErrorCode::malformed,
                         "the body is empty; it must be a JSON object, a GLB or a glTF");
    if (type != Type::object && type != Type::none)
      return cursor.fail(ErrorCode::wrong_type, "the body must be a JSON object");
    if (!cursor.open_object("an object") || !read(cursor)) return false;
    return cursor.at_end() ||
           cursor.fail(ErrorCode::malformed, "something follows the JSON object; the body must end with it");
  };
  if (walk()) return {};
  return *cursor.error();
}

Result<RefineRequest> read(std::string_view body, const Limits& limits, const Budget& budget) {
  RefineRequest request;
  request.input = Format::json;
  const auto done = read_document(
      body, budget, [&](Cursor& cursor) { return DocumentReader(cursor, limits, request).read(); });
  if (!done) return done.error();
  return request;
}

}  // namespace subdivd::proto::json
