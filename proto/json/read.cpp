#include <algorithm>
#include <new>

#include "proto/json/cursor.h"
#include "proto/json/diagnose.h"
#include "proto/json/document.h"
#include "proto/json/json.h"
#include "proto/json/read_mesh.h"
#include "proto/options.h"

namespace subdivd::proto::json {
namespace {

using simdjson::ondemand::json_type;

// An empty mesh takes 40 bytes of text and over a thousand here, in the engine and in the answer.
constexpr std::size_t kMostObjects = 65536;

template <class ReadOne>
bool each(Cursor& cursor, Value value, std::string_view right, ReadOne read_one) {
  simdjson::ondemand::array array;
  if (value.get_array().get(array)) return cursor.fail_type(value, right);
  std::uint64_t i = 0;
  for (auto element : array) {
    Value one;
    if (element.get(one)) return cursor.fail_syntax();
    if (i == kMostObjects)
      return cursor.fail(ErrorCode::too_large,
                         std::string("there are more than ") + std::to_string(kMostObjects) + " of them");
    const Cursor::Step step(cursor, i);
    if (!read_one(one)) return false;
    ++i;
  }
  return true;
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

  bool read(simdjson::ondemand::object object) {
    std::bitset<kMembers> seen;
    if (!cursor_.read_members(object, members(), *this, seen)) return false;
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

  bool meshes(Value value) {
    return each(cursor_, value, "an array of meshes", [&](Value one) {
      MeshRead mesh;
      if (!read_mesh(cursor_, one, mesh)) return false;
      add(std::move(mesh));
      return true;
    });
  }

  bool curves(Value value) { return read_curve_list(cursor_, value, out_); }

  bool surfaces(Value value) { return read_surface_list(cursor_, value, out_); }

  bool options(Value value) { return read_options(cursor_, value, out_.options); }

  // Members of an answer: it is a valid request, so they may stand here. They are looked at, not used.
  bool ignored(Value value) { return cursor_.skip(value, limits_.max_json_depth); }

  template <bool (MeshReader::*member)(Value)>
  bool of_mesh(Value value) {
    return (top_mesh_.*member)(value);
  }

 private:
  void add(MeshRead mesh) {
    if (mesh.had_normals)
      warn_once(out_.warnings, normals_warned_,
                "normals of the body are not used; ask for new ones with the option normals");
    out_.meshes.push_back(std::move(mesh.mesh));
    out_.mesh_forms.push_back(std::move(mesh.form));
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
      {"subdivisionScheme", &D::of_mesh<&M::subdivision_scheme>},
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

bool read_curve_list(Cursor& cursor, Value value, RefineRequest& out) {
  bool warned = false;
  return each(cursor, value, "an array of curves", [&](Value one) {
    CurvesRead curves;
    if (!read_curves(cursor, one, curves)) return false;
    if (curves.had_tangents) warn_once(out.warnings, warned, "tangents of the body are not used");
    out.curves.push_back(std::move(curves.curves));
    out.curve_forms.push_back(curves.form);
    return true;
  });
}

bool read_surface_list(Cursor& cursor, Value value, RefineRequest& out) {
  return each(cursor, value, "an array of surfaces", [&](Value one) {
    CurvesRead read;
    if (!read_surface(cursor, one, read)) return false;
    out.surfaces.push_back(*std::move(read.surface));
    out.surface_forms.push_back(read.form);
    return true;
  });
}

bool read_options(Cursor& cursor, Value value, Options& out) {
  simdjson::ondemand::object object;
  if (value.get_object().get(object)) return cursor.fail_type(value, "an object of options");
  std::bitset<64> seen;
  for (auto field : object) {
    std::string_view key;
    Value one;
    json_type type{};
    if (field.unescaped_key().get(key) || field.value().get(one) || one.type().get(type))
      return cursor.fail_syntax();
    const std::string name(key);
    if (const OptionSpec* spec = find_option(name)) {
      const auto number = static_cast<std::size_t>(spec - option_table().data());
      if (seen[number]) return cursor.fail_twice(name);
      seen.set(number);
    }
    const Cursor::Step step(cursor, std::string_view(name));
    OptionValue given;
    std::string_view text;
    bool truth = false;
    double real = 0;
    if (type == json_type::boolean) {
      if (one.get_bool().get(truth)) return cursor.fail_syntax();
      given.boolean = truth;
    } else if (type == json_type::number) {
      if (!get_number(one, real)) return cursor.fail_number(one, "a number within range");
      given.number = real;
    } else if (type == json_type::string) {
      if (one.get_string().get(text)) return cursor.fail_syntax();
      given.text = text;
    }
    if (Result<void> done = set_option(out, name, given, cursor.path()); !done) {
      const Error& error = done.error();
      return cursor.fail_as(error);
    }
  }
  return true;
}

namespace {

// Opens the document, lets the reader walk it and makes sure that nothing follows.
bool walk(Cursor& cursor, simdjson::ondemand::parser& parser, const simdjson::padded_string& text,
          const std::function<bool(Cursor&, simdjson::ondemand::object)>& read) {
  simdjson::ondemand::document document;
  if (parser.iterate(text).get(document)) return cursor.fail_syntax();
  json_type type{};
  if (document.type().get(type)) return cursor.fail_syntax();
  if (type != json_type::object) return cursor.fail(ErrorCode::wrong_type, "the body must be a JSON object");
  simdjson::ondemand::object object;
  if (document.get_object().get(object)) return cursor.fail_syntax();
  if (!read(cursor, object)) return false;
  const char* next = nullptr;
  if (document.current_location().get(next) != simdjson::OUT_OF_BOUNDS)
    return cursor.fail(ErrorCode::malformed, "something follows the JSON object; the body must end with it");
  return true;
}

}  // namespace

Result<void> read_document(std::string_view body,
                           const std::function<bool(Cursor&, simdjson::ondemand::object)>& read) {
  // A byte order mark is no JSON, but some editors write it.
  if (body.starts_with("\xEF\xBB\xBF")) body.remove_prefix(3);
  const simdjson::padded_string text(body);  // simdjson reads up to 64 bytes past the end
  if (text.size() != body.size())
    return Error{ErrorCode::too_large, "there is no memory for this body", {}, body.size(), 0};
  simdjson::ondemand::parser parser;
  Cursor cursor;
  if (walk(cursor, parser, text, read)) return {};
  if (cursor.malformed()) return diagnose(body);
  return *cursor.error();
}

Result<RefineRequest> read(std::string_view body, const Limits& limits,
                           [[maybe_unused]] const Budget& budget) {
  RefineRequest request;
  request.input = Format::json;
  const auto done = read_document(body, [&](Cursor& cursor, simdjson::ondemand::object object) {
    return DocumentReader(cursor, limits, request).read(object);
  });
  if (!done) return done.error();
  return request;
}

bool has_member(std::string_view body, std::string_view name) {
  const simdjson::padded_string text(body);
  simdjson::ondemand::parser parser;
  simdjson::ondemand::document document;
  simdjson::ondemand::object object;
  if (text.size() != body.size() || parser.iterate(text).get(document) || document.get_object().get(object))
    return false;
  for (auto field : object) {
    std::string_view key;
    if (field.unescaped_key().get(key)) return false;
    if (key == name) return true;
  }
  return false;
}

}  // namespace subdivd::proto::json
