#include "core/oracle/far_timing.h"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/stencilTableFactory.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>
#include <opensubdiv/osd/cpuEvaluator.h>

#include <cmath>
#include <vector>

namespace subdivd::oracle {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;
namespace Osd = OpenSubdiv::Osd;
using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;

struct Point {
  float xyz[3];  // left unset by default, as our own buffers are
  void Clear() { xyz[0] = xyz[1] = xyz[2] = 0; }
  void AddWithWeight(const Point& from, float weight) {
    for (int k = 0; k < 3; ++k) xyz[k] += weight * from.xyz[k];
  }
};

// Plain arrays as Far's templates want to see them.
struct In {
  const Point* data;
  explicit In(const float* xyz) : data(reinterpret_cast<const Point*>(xyz)) {}
  const Point& operator[](int i) const { return data[i]; }
};
struct Out {
  Point* data;
  explicit Out(float* xyz) : data(reinterpret_cast<Point*>(xyz)) {}
  Point& operator[](int i) const { return data[i]; }
};

Sdc::Options options_of(BoundaryInterpolation boundary) {
  Sdc::Options options;
  options.SetVtxBoundaryInterpolation(
      boundary == BoundaryInterpolation::edge_and_corner ? Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER
      : boundary == BoundaryInterpolation::edge_only     ? Sdc::Options::VTX_BOUNDARY_EDGE_ONLY
                                                         : Sdc::Options::VTX_BOUNDARY_NONE);
  return options;
}

}  // namespace

struct FarTiming::State {
  std::vector<int> face_sizes;
  Far::TopologyDescriptor descriptor;
  Factory::Options options;
  std::unique_ptr<Far::TopologyRefiner> refiner;
  std::unique_ptr<const Far::StencilTable> stencils;

  const Far::TopologyLevel& last() const { return refiner->GetLevel(refiner->GetMaxLevel()); }
};

FarTiming::FarTiming(const FarCage& cage) : state_(std::make_unique<State>()) {
  state_->face_sizes.assign(cage.corners.size() / static_cast<std::size_t>(cage.face_size), cage.face_size);
  Far::TopologyDescriptor& descriptor = state_->descriptor;
  descriptor.numVertices = cage.vertex_count;
  descriptor.numFaces = static_cast<int>(state_->face_sizes.size());
  descriptor.numVertsPerFace = state_->face_sizes.data();
  descriptor.vertIndicesPerFace = cage.corners.data();
  descriptor.numCreases = static_cast<int>(cage.crease_sharpnesses.size());
  descriptor.creaseVertexIndexPairs = cage.creases.data();
  descriptor.creaseWeights = cage.crease_sharpnesses.data();
  state_->options = Factory::Options(cage.face_size == 3 ? Sdc::SCHEME_LOOP : Sdc::SCHEME_CATMARK,
                                     options_of(cage.boundary));
}

FarTiming::~FarTiming() = default;

bool FarTiming::create() {
  state_->refiner.reset(Factory::Create(state_->descriptor, state_->options));
  return state_->refiner != nullptr;
}

void FarTiming::refine(int level, bool full_last_level) {
  Far::TopologyRefiner::UniformOptions options(level);
  options.fullTopologyInLastLevel = full_last_level;
  state_->refiner->RefineUniform(options);
}

std::size_t FarTiming::point_count() const {
  return static_cast<std::size_t>(state_->last().GetNumVertices());
}
std::size_t FarTiming::face_count() const { return static_cast<std::size_t>(state_->last().GetNumFaces()); }

void FarTiming::interpolate(const float* control, float* points) const {
  const Far::PrimvarRefiner primvars(*state_->refiner);
  const int levels = state_->refiner->GetMaxLevel();
  std::unique_ptr<Point[]> from_buffer, to_buffer;
  In from(control);
  for (int level = 1; level <= levels; ++level) {
    Out to(points);
    if (level < levels) {
      to_buffer.reset(new Point[static_cast<std::size_t>(state_->refiner->GetLevel(level).GetNumVertices())]);
      to.data = to_buffer.get();
    }
    primvars.Interpolate(level, from, to);
    from.data = to.data;
    from_buffer = std::move(to_buffer);
  }
}

void FarTiming::extract(std::uint32_t* corners) const {
  const Far::TopologyLevel& level = state_->last();
  const int count = level.GetNumFaces(), size = state_->face_sizes.front();
  for (int face = 0; face < count; ++face, corners += size) {
    const Far::ConstIndexArray vertices = level.GetFaceVertices(face);
    for (int k = 0; k < size; ++k) corners[k] = static_cast<std::uint32_t>(vertices[k]);
  }
}

void FarTiming::limit(const float* points, float* limits, float* tangents_u, float* tangents_v) const {
  Out to(limits), u(tangents_u), v(tangents_v);
  Far::PrimvarRefiner(*state_->refiner).Limit(In(points), to, u, v);
}

void FarTiming::build_stencils() {
  Far::StencilTableFactory::Options options;
  options.generateControlVerts = false;
  options.generateIntermediateLevels = false;
  options.factorizeIntermediateLevels = true;
  options.generateOffsets = true;
  state_->stencils.reset(Far::StencilTableFactory::Create(*state_->refiner, options));
}

void FarTiming::update_stencils(const float* control, float* points) const {
  Out to(points);
  state_->stencils->UpdateValues(In(control), to);
}

void FarTiming::evaluate_stencils(const float* control, float* points) const {
  const Far::StencilTable& table = *state_->stencils;
  const Osd::BufferDescriptor layout(0, 3, 3);
  Osd::CpuEvaluator::EvalStencils(control, layout, points, layout, table.GetSizes().data(),
                                  table.GetOffsets().data(), table.GetControlIndices().data(),
                                  table.GetWeights().data(), 0, table.GetNumStencils());
}

void FarTiming::release() {
  state_->stencils.reset();
  state_->refiner.reset();
}

void normals_of_tangents(std::size_t count, const float* tangents_u, const float* tangents_v,
                         float* normals) {
  for (std::size_t k = 0; k < 3 * count; k += 3) {
    const float *u = tangents_u + k, *v = tangents_v + k;
    const float x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
    const float length = std::sqrt(x * x + y * y + z * z), scale = length > 0 ? 1 / length : 0;
    normals[k] = x * scale, normals[k + 1] = y * scale, normals[k + 2] = z * scale;
  }
}

}  // namespace subdivd::oracle
