#include "proto/json/read_mesh.h"

#include "proto/json/read_primvar.h"
#include "proto/json/words.h"
#include "proto/options.h"

namespace subdivd::proto::json {
namespace {

constexpr std::size_t kMostPrimvars = 4096;

// A word of an option that a mesh may also set for itself.
template <class Enum>
bool read_option_word(Cursor& cursor, std::string_view option, Enum& out) {
  std::size_t word = 0;
  if (!cursor.read_word(find_option(option)->words, word)) return false;
  out = static_cast<Enum>(word);
  return true;
}

// Nested lists bring their lengths along; a member with the lengths must then agree.
bool merge_counts(Cursor& cursor, Lists& lists, std::vector<Index>& counts, bool given, const char* member) {
  if (lists.form == ArrayForm::flat) return true;
  if (!given) {
    counts = std::move(lists.counts);
    return true;
  }
  if (counts == lists.counts) return true;
  return cursor.fail(ErrorCode::wrong_length,
                     "these lengths differ from those of the nested arrays; leave this member out", {member});
}

}  // namespace

const std::array<Cursor::Member<MeshReader>, MeshReader::kMembers>& MeshReader::members() {
  static constexpr std::array<Cursor::Member<MeshReader>, kMembers> table = {{
      {"name", &MeshReader::name},
      {"points", &MeshReader::points},
      {"faceVertexCounts", &MeshReader::face_vertex_counts},
      {"faceVertexIndices", &MeshReader::face_vertex_indices},
      {"orientation", &MeshReader::orientation},
      {"subdivisionScheme", &MeshReader::subdivision_scheme},
      {"triangleSubdivisionRule", &MeshReader::triangle_subdivision_rule},
      {"interpolateBoundary", &MeshReader::interpolate_boundary},
      {"faceVaryingLinearInterpolation", &MeshReader::face_varying_linear_interpolation},
      {"creaseIndices", &MeshReader::crease_indices},
      {"creaseLengths", &MeshReader::crease_lengths},
      {"creaseSharpnesses", &MeshReader::crease_sharpnesses},
      {"cornerIndices", &MeshReader::corner_indices},
      {"cornerSharpnesses", &MeshReader::corner_sharpnesses},
      {"holeIndices", &MeshReader::hole_indices},
      {"primvars", &MeshReader::primvars},
      {"normals", &MeshReader::normals},
  }};
  return table;
}

bool MeshReader::name() { return cursor_.read_string(result_.mesh.name); }

bool MeshReader::points() {
  Tuples tuples;
  has_points_ = true;
  if (!read_tuples(cursor_, 3, 3, "point", tuples)) return false;
  result_.mesh.points = std::move(tuples.values);
  result_.form.points = tuples.form;
  return true;
}

bool MeshReader::face_vertex_counts() {
  has_counts_ = true;
  return read_indices(cursor_, result_.mesh.face_vertex_counts);
}

bool MeshReader::face_vertex_indices() {
  has_faces_ = true;
  return read_lists(cursor_, "face", faces_);
}

bool MeshReader::orientation() {
  std::size_t word = 0;
  if (!cursor_.read_word(orientation_words(), word)) return false;
  result_.form.orientation = static_cast<Orientation>(word);
  return true;
}

bool MeshReader::subdivision_scheme() {
  std::size_t word = 0;
  if (!cursor_.read_word(kSchemeNames, word)) return false;
  result_.mesh.subdivision_scheme = kSchemeNames[word];
  return true;
}

bool MeshReader::triangle_subdivision_rule() {
  std::size_t word = 0;
  if (!cursor_.read_word(triangle_rule_words(), word)) return false;
  result_.mesh.triangle_subdivision_rule = static_cast<TriangleRule>(word);
  return true;
}

bool MeshReader::interpolate_boundary() {
  return read_option_word(cursor_, "interpolateBoundary", result_.mesh.interpolate_boundary);
}

bool MeshReader::face_varying_linear_interpolation() {
  return read_option_word(cursor_, "faceVaryingLinearInterpolation",
                          result_.mesh.face_varying_linear_interpolation);
}

bool MeshReader::crease_indices() { return read_lists(cursor_, "crease", creases_); }

bool MeshReader::crease_lengths() {
  has_lengths_ = true;
  return read_indices(cursor_, result_.mesh.crease_lengths);
}

bool MeshReader::crease_sharpnesses() { return read_sharpnesses(cursor_, result_.mesh.crease_sharpnesses); }

bool MeshReader::corner_indices() { return read_indices(cursor_, result_.mesh.corner_indices); }

bool MeshReader::corner_sharpnesses() { return read_sharpnesses(cursor_, result_.mesh.corner_sharpnesses); }

bool MeshReader::hole_indices() { return read_indices(cursor_, result_.mesh.hole_indices); }

bool MeshReader::primvars() {
  if (!cursor_.open_object("an object of primvars by name")) return false;
  std::vector<Primvar>& primvars = result_.mesh.primvars;
  const auto by_name = [&](std::size_t a, std::size_t b) { return primvars[a].name < primvars[b].name; };
  std::set<std::size_t, decltype(by_name)> names(by_name);
  std::string_view key;
  for (Cursor::Members all(cursor_); all.next(key);) {
    Primvar& primvar = primvars.emplace_back();
    if (!cursor_.copy(key, primvar.name)) return false;
    if (!names.insert(primvars.size() - 1).second) return cursor_.fail_twice(primvar.name);
    if (names.size() > kMostPrimvars)
      return cursor_.fail(ErrorCode::too_large, std::string("a mesh may have at most ") +
                                                    std::to_string(kMostPrimvars) + " primvars");
    const Cursor::Step step(cursor_, std::string_view(primvar.name));
    if (!read_primvar(cursor_, primvar, result_.form.primvars.emplace_back(ArrayForm::flat),
                      result_.primvar_names.emplace_back()))
      return false;
  }
  return !cursor_.failed();
}

// An answer fed back brings them: they are read, so that faults are found, and come anew from the surface.
bool MeshReader::normals() {
  Tuples unused;
  result_.had_normals = true;
  return read_tuples(cursor_, 3, 3, "normal", unused);
}

bool MeshReader::finish() {
  if (!has_points_ || !has_faces_) {
    const std::string missing = has_points_ ? "faceVertexIndices" : "points";
    return cursor_.fail(ErrorCode::missing_field, std::string("a mesh needs ") + missing, {missing});
  }
  ControlMesh& mesh = result_.mesh;
  if (!merge_counts(cursor_, faces_, mesh.face_vertex_counts, has_counts_, "faceVertexCounts")) return false;
  if (!merge_counts(cursor_, creases_, mesh.crease_lengths, has_lengths_, "creaseLengths")) return false;
  mesh.face_vertex_indices = std::move(faces_.indices);
  mesh.crease_indices = std::move(creases_.indices);
  result_.form.faces = faces_.form;
  result_.form.creases = creases_.form;
  if (mesh.face_vertex_counts.empty() && mesh.face_vertex_indices.size() % 3 != 0)
    return cursor_.fail(ErrorCode::wrong_length,
                        std::string("faceVertexIndices holds ") +
                            std::to_string(mesh.face_vertex_indices.size()) +
                            " indices; without faceVertexCounts all faces are triangles, so it must hold a "
                            "multiple of 3",
                        {"faceVertexIndices"});
  return true;
}

bool read_mesh(Cursor& cursor, MeshRead& out) {
  if (!cursor.open_object("a mesh, an object")) return false;
  MeshReader reader(cursor);
  std::bitset<MeshReader::kMembers> seen;
  if (!cursor.read_members(MeshReader::members(), reader, seen) || !reader.finish()) return false;
  out = reader.take();
  return true;
}

}  // namespace subdivd::proto::json
