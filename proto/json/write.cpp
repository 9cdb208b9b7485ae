#include <utility>

#include "core/base/overloaded.h"
#include "core/base/pace.h"
#include "proto/json/json.h"
#include "proto/json/text_writer.h"
#include "proto/json/words.h"

namespace subdivd::proto::json {
namespace {

// Writes one answer; the first number that is not finite ends it.
template <class Real>
class AnswerWriter {
 public:
  AnswerWriter(const RefineRequest& request, RefineAnswer<Real> answer, const Budget& budget)
      : request_(request), answer_(std::move(answer)), budget_(budget), text_(budget) {}

  Result<Payload> write(std::string_view envelope) {
    const bool nothing = answer_.meshes.empty() && answer_.curves.empty() && answer_.surfaces.empty();
    text_.open('{');
    write_parts("meshes", answer_.meshes.size(), request_.single_mesh_at_top,
                nothing && !request_.without_meshes, [&](std::size_t i) { write_mesh(i); });
    write_parts("curves", answer_.curves.size(), request_.single_curve_at_top,
                nothing && request_.without_meshes, [&](std::size_t i) { write_curves(i); });
    write_parts("surfaces", answer_.surfaces.size(), request_.single_surface_at_top, false,
                [&](std::size_t i) { write_surface(i); });
    if (text_.stopped()) return *text_.stopped();
    if (error_) return *error_;
    if (envelope != "{}") text_.separate();
    text_.raw(envelope.substr(1));  // the rest of an object, closing brace included
    Payload payload;
    payload.content_type = "application/json";
    payload.chunks = text_.finish();
    if (text_.stopped()) return *text_.stopped();
    return payload;
  }

 private:
  // One at the top, or a list; an empty one only where it is `wanted`.
  template <class WriteOne>
  void write_parts(std::string_view name, std::size_t count, bool at_top, bool wanted, WriteOne write_one) {
    if (error_ || (count == 0 && !wanted)) return;
    if (at_top && count == 1) return write_one(0);
    text_.key(name);
    text_.open('[');
    for (std::size_t i = 0; i < count && !error_ && !text_.stopped(); ++i) {
      text_.separate();
      text_.open('{');
      write_one(i);
      text_.close('}');
    }
    text_.close(']');
  }

  void write_mesh(std::size_t i) {
    RefinedMesh<Real>& mesh = answer_.meshes[i];
    const ControlMesh& control = request_.meshes[i];
    const JsonMeshForm form = i < request_.mesh_forms.size() ? request_.mesh_forms[i] : JsonMeshForm{};
    word("name", mesh.name, !mesh.name.empty());
    array(chosen(mesh.points, mesh.limit_points), "points", 3, form.points, i);
    // Faces of a body without counts are triangles.
    if (mesh.face_size != 3) {
      text_.key("faceVertexCounts");
      if (mesh.face_size != 0) mesh.face_vertex_counts = Buffer<Index>(mesh.face_count, mesh.face_size);
      text_.indices(std::exchange(mesh.face_vertex_counts, {}), 1, ArrayForm::flat);
    }
    text_.key("faceVertexIndices");
    text_.indices(std::exchange(mesh.faces, {}), std::max<Index>(mesh.face_size, 1),
                  mesh.face_size == 0 ? ArrayForm::flat : form.faces);
    const bool left_handed = form.orientation == Orientation::left_handed;
    word("orientation", word_of(form.orientation), left_handed);
    word("subdivisionScheme", mesh.scheme, !mesh.scheme.empty());
    word("triangleSubdivisionRule", word_of(control.triangle_subdivision_rule),
         control.triangle_subdivision_rule != TriangleRule::catmull_clark);
    word("interpolateBoundary", word_of(control.interpolate_boundary));
    word("faceVaryingLinearInterpolation", word_of(control.face_varying_linear_interpolation));
    if (!mesh.primvars.empty()) {
      text_.key("primvars");
      text_.open('{');
      for (std::size_t p = 0; p < mesh.primvars.size() && !error_; ++p)
        write_primvar(mesh.primvars[p], p < form.primvars.size() ? form.primvars[p] : ArrayForm::nested, i,
                      names_of(request_, i, p));
      text_.close('}');
    }
    if (left_handed) turn(mesh.normals);
    if (request_.options.normals) array(std::exchange(mesh.normals, {}), "normals", 3, form.points, i);
  }

  // To the other side; a difference, so that no zero becomes -0.
  void turn(Buffer<Real>& normals) {
    auto turned = stoppable(budget_, [&](const Pace& pace) {
      pace.for_each(normals.size(), [&](Count k) { normals[k] = Real(0) - normals[k]; });
    });
    if (!turned) error_ = std::move(turned).error();
  }

  void write_primvar(RefinedPrimvar<Real>& primvar, ArrayForm form, std::size_t mesh, const NameList& names) {
    text_.key(primvar.name);
    text_.open('{');
    word("interpolation", word_of(primvar.interpolation));
    text_.key("elementSize");
    text_.raw(std::to_string(primvar.element_size));
    array(chosen(primvar.values, primvar.limit_values), "values", primvar.element_size, form, mesh);
    if (!primvar.indices.empty()) {
      text_.key("indices");
      text_.indices(std::exchange(primvar.indices, {}), 1, ArrayForm::flat);
    }
    if (!names.empty()) {
      text_.key("names");
      text_.open('[');
      for (Count k = 0; k < names.size() && !text_.stopped(); ++k) {
        text_.separate();
        text_.string(names[k]);
      }
      text_.close(']');
    }
    text_.close('}');
  }

  void write_surface(std::size_t i) {
    RefinedPatch<Real>& surface = answer_.surfaces[i];
    const ControlPatch& control = request_.surfaces[i];
    const ArrayForm form = form_of(surface.width, request_.surface_forms, i);
    word("name", surface.name, !surface.name.empty());
    word("type", "bsplineSurface");
    number("uVertexCount", surface.u_count);
    number("vVertexCount", surface.v_count);
    number("uDegree", control.u_degree);
    number("vDegree", control.v_degree);
    word("uWrap", word_of(surface.u_wrap));
    word("vWrap", word_of(surface.v_wrap));
    array(chosen(surface.points, surface.limit_points), "points", surface.width, form, i, "surfaces");
    // Faces of a body without counts are triangles.
    if (surface.corners_per_face == 4) {
      text_.key("faceVertexCounts");
      text_.indices(Buffer<Index>(surface.faces.size() / 4, 4), 1, ArrayForm::flat);
    }
    text_.key("faceVertexIndices");
    text_.indices(std::exchange(surface.faces, {}), surface.corners_per_face, ArrayForm::flat);
    if (!surface.normals.empty())
      array(std::exchange(surface.normals, {}), "normals", 3, form, i, "surfaces");
  }

  // A flat array would be read back as points of three numbers.
  template <class Form>
  static ArrayForm form_of(Index width, const std::vector<Form>& forms, std::size_t i) {
    return width != 3 || i >= forms.size() ? ArrayForm::nested : forms[i].points;
  }

  void write_curves(std::size_t i) {
    RefinedCurves<Real>& curves = answer_.curves[i];
    const ArrayForm form = form_of(curves.width, request_.curve_forms, i);
    word("name", curves.name, !curves.name.empty());
    write_kind(curves);
    array(chosen(curves.points, curves.limit_points), "points", curves.width, form, i, "curves");
    text_.key("curveVertexCounts");
    text_.indices(curves.vertex_counts, 1, ArrayForm::flat);
    if (const Nurbs* nurbs = std::get_if<Nurbs>(&curves.basis)) {
      text_.key("order");
      text_.indices(nurbs->orders, 1, ArrayForm::flat);
      array(std::span<const double>(nurbs->knots), "knots", 1, ArrayForm::flat, i, "curves");
      if (!nurbs->weights.empty())
        array(std::span<const double>(nurbs->weights), "pointWeights", 1, ArrayForm::flat, i, "curves");
    }
    if (!curves.tangents.empty())
      array(std::exchange(curves.tangents, {}), "tangents", curves.width, form, i, "curves");
  }

  // What makes the points a curve, in words that a request takes.
  void write_kind(const RefinedCurves<Real>& curves) {
    const std::string_view type = type_of(curves.basis);
    if (!type.empty()) word("type", type);
    if (family_of(curves.basis) == CurveFamily::on_knots) return;
    word("basis", word_of(curves.basis));
    word("wrap", word_of(curves.wrap));
    std::visit(Overloaded{[&](const UniformBSpline& kind) {
                            if (type.empty()) number("degree", kind.degree);
                          },
                          [&](const FourPoint& kind) { number("tension", kind.tension); },
                          [&](const CornerCutting& kind) { number("ratio", kind.ratio); },
                          [](const PiecewiseKind auto&) {},  // they come back as Bezier curves
                          [](const Nurbs&) {}},
               curves.basis);
  }

  // Empty where the basis and its parameters say all.
  static std::string_view type_of(const CurveBasis& basis) {
    using Word = std::string_view;
    return std::visit(Overloaded{[](const UniformBSpline& kind) -> Word {
                                   return kind.degree == 1 ? "linear" : kind.degree == 3 ? "cubic" : "";
                                 },
                                 [](const FourPoint&) -> Word { return ""; },
                                 [](const CornerCutting&) -> Word { return ""; },
                                 [](const PiecewiseKind auto&) -> Word { return "cubic"; },
                                 [](const Nurbs&) -> Word { return "nurbs"; }},
                      basis);
  }

  void number(std::string_view name, double value) {
    text_.key(name);
    text_.number(value);
  }

  // The option limit puts the limits in the place of the refined values. Takes them out of the answer, so
  // that they are freed once written.
  template <class Array>
  Array chosen(Array& values, Array& limits) {
    const bool limit = request_.options.limit && !limits.empty();
    Array taken = std::exchange(limit ? limits : values, {});
    Array().swap(limit ? values : limits);
    return taken;
  }

  void word(std::string_view name, std::string_view value, bool wanted = true) {
    if (!wanted) return;
    text_.key(name);
    text_.string(value);
  }

  template <class Values>
  void array(const Values& values, const char* name, std::size_t width, ArrayForm form, std::size_t number,
             const char* of = "meshes") {
    if (error_) return;
    text_.key(name);
    const std::size_t place = text_.tuples(std::span(values), width, form);
    if (place == TextWriter::kAllFinite) return;
    error_ = Error{ErrorCode::not_finite,
                   std::string("number ") + std::to_string(place) + " of the refined " + name +
                       " is too large for the precision of the answer; scale the input down or take "
                       "precision double"};
    const bool top = request_.single_mesh_at_top && std::string_view(of) == "meshes";
    if (!top && !request_.single_curve_at_top && !request_.single_surface_at_top)
      error_->where = {of, std::uint64_t{number}};
  }

  const RefineRequest& request_;
  RefineAnswer<Real> answer_;
  const Budget& budget_;
  TextWriter text_;
  std::optional<Error> error_;
};

}  // namespace

Result<Payload> write(const RefineRequest& request, AnyAnswer answer, const Budget& budget) {
  const Result<std::string> members = envelope(request, answer, budget);
  if (!members) return members.error();
  return write(request, std::move(answer), *members, budget);
}

Result<Payload> write(const RefineRequest& request, AnyAnswer answer, std::string_view members,
                      const Budget& budget) {
  return std::visit(
      [&]<class Real>(RefineAnswer<Real>& typed) {
        return AnswerWriter<Real>(request, std::move(typed), budget).write(members);
      },
      answer);
}

}  // namespace subdivd::proto::json
