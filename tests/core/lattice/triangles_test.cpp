#include "core/lattice/triangle_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "core/lattice/lattice.h"
#include "core/lattice/split.h"
#include "core/mesh/topology.h"
#include "core/refine/plan.h"
#include "tests/shapes/build.h"
#include "tests/shapes/polygons.h"
#include "tests/shapes/shapes.h"

namespace subdivd {
namespace {

std::shared_ptr<const Lattice> lattice_of(const ControlMesh& mesh) {
  const auto plan = Plan::build(mesh, {.max_level = 0}, {});
  EXPECT_TRUE(plan.ok());
  return plan->mesh().lattice();
}

constexpr Index kUntouched = kNoIndex - 7;

// All that next() writes, asked for in pieces of `room`.
std::vector<Index> in_pieces(TriangleStream stream, Count room) {
  std::vector<Index> all, piece(room + 1, kUntouched);
  for (Count count; (count = stream.next(std::span(piece).first(room))) > 0;) {
    EXPECT_EQ(count % 3, 0u);
    EXPECT_LE(count, room);
    all.insert(all.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(count));
  }
  EXPECT_EQ(piece.back(), kUntouched);  // nothing is written behind the room
  EXPECT_EQ(stream.next(piece), 0u);
  return all;
}

void expect_whole(const ControlMesh& mesh, Index level, std::span<const unsigned char> holes,
                  bool apart = false) {
  TriangleStream stream(lattice_of(mesh), level, holes);
  if (apart) stream.tell_faces_apart();
  const Buffer<Index> whole = *stream.all(1, {});
  const std::vector<Index> expected(whole.begin(), whole.end());
  ASSERT_EQ(stream.index_count(), expected.size());
  for (const Count more : {Count{0}, Count{1}, Count{50}, expected.size() + 100})
    ASSERT_EQ(in_pieces(stream, stream.least_room() + more), expected) << level << " " << more;
}

TEST(TriangleStream, makes_in_pieces_what_is_written_at_once) {
  std::vector<shapes::NamedShape> all = shapes::all_shapes();
  for (auto& shape : shapes::polygon_shapes()) all.push_back(std::move(shape));
  for (const auto& [name, mesh] : all)
    for (Index level = 0; level <= 5; ++level) {
      SCOPED_TRACE(name);
      if (mesh.face_count() * triangles_per_face(level) > 100'000) continue;
      expect_whole(mesh, level, std::vector<unsigned char>(mesh.face_count(), 0));
      expect_whole(mesh, level, std::vector<unsigned char>(mesh.face_count(), 0), true);
    }
}

// Quads from their first corner on, and so polygons where they are not refined.
TEST(TriangleStream, cuts_larger_faces_from_their_first_corner_on) {
  for (const auto& [name, mesh] : shapes::polygon_shapes())
    for (const Index level : {0, 1, 2, 3}) {
      const auto lattice = lattice_of(mesh);
      const std::vector<unsigned char> holes(mesh.face_count(), 0);
      std::vector<Index> corners(lattice->corner_count(level)),
          sizes(lattice->face_count(level), lattice->face_size(level));
      ASSERT_TRUE(lattice->write_faces(level, holes, corners.data(), 1, {}));
      if (lattice->face_size(level) == 0) lattice->write_face_sizes(holes, sizes.data(), Pace());
      std::vector<Index> expected;
      const Index* face = corners.data();
      for (const Index size : sizes) {
        for (Index k = 1; k + 1 < size; ++k) expected.insert(expected.end(), {face[0], face[k], face[k + 1]});
        face += size;
      }
      const Buffer<Index> cut = *TriangleStream(lattice, level, holes).all(1, {});
      ASSERT_EQ(std::vector<Index>(cut.begin(), cut.end()), expected) << name << ' ' << level;
    }
}

// The faces of corners `indices`, from their lowest on, as FB_ngon_encoding has them: triangles that follow one another
// and share their first corner are one face.
std::vector<std::vector<Index>> faces_of_ngons(std::span<const Index> indices) {
  std::vector<std::vector<Index>> faces;
  for (Count t = 0; t < indices.size(); t += 3) {
    if (faces.empty() || faces.back().front() != indices[t]) faces.push_back({indices[t], indices[t + 1]});
    EXPECT_EQ(faces.back().back(), indices[t + 1]);
    faces.back().push_back(indices[t + 2]);
  }
  for (auto& face : faces) std::ranges::rotate(face, std::ranges::min_element(face));
  return faces;
}

std::vector<std::vector<Index>> faces_of(const Lattice& lattice, Index level,
                                         std::span<const unsigned char> holes) {
  const Pace pace;
  std::vector<Index> corners(lattice.corner_count(level, holes, pace)),
      sizes(lattice.face_count(level, holes, pace), lattice.face_size(level));
  EXPECT_TRUE(lattice.write_faces(level, holes, corners.data(), 1, {}));
  if (lattice.face_size(level) == 0) lattice.write_face_sizes(holes, sizes.data(), pace);
  std::vector<std::vector<Index>> faces;
  auto next = corners.begin();
  for (const Index size : sizes) {
    faces.emplace_back(next, next + size);
    next += size;
    std::ranges::rotate(faces.back(), std::ranges::min_element(faces.back()));
  }
  return faces;
}

// Holes of no face, every second one, and two of three.
std::vector<std::vector<unsigned char>> some_holes(Count faces) {
  std::vector<std::vector<unsigned char>> all(3, std::vector<unsigned char>(faces, 0));
  for (Count f = 0; f < faces; ++f) {
    all[1][f] = f % 2 == 0;
    all[2][f] = f % 3 != 0;
  }
  return all;
}

TEST(TriangleStream, tells_faces_apart_at_every_level) {
  for (const auto& [name, mesh] : shapes::polygon_shapes())
    for (Index level = 0; level <= 4; ++level) {
      if (mesh.face_count() * triangles_per_face(level) > 100'000) continue;
      const auto lattice = lattice_of(mesh);
      for (const auto& holes : some_holes(mesh.face_count())) {
        TriangleStream stream(lattice, level, holes);
        const Count count = stream.index_count();
        ASSERT_EQ(stream.tell_faces_apart(), count > 0 && !lattice->has_triangles());
        if (lattice->has_triangles()) continue;
        ASSERT_EQ(stream.index_count(), count);
        const auto expected = faces_of(*lattice, level, holes);
        ASSERT_EQ(faces_of_ngons(in_pieces(stream, stream.least_room())), expected) << name << ' ' << level;
        ASSERT_EQ(faces_of_ngons(*stream.all(1, {})), expected) << name << ' ' << level;
      }
    }
}

TEST(TriangleStream, cuts_a_face_that_begins_like_the_one_before_it_from_its_second_corner_on) {
  ControlMesh mesh;
  mesh.points.resize(24);
  mesh.face_vertex_counts = {4, 4, 4};
  mesh.face_vertex_indices = {0, 1, 2, 3, 0, 3, 4, 5, 0, 5, 6, 7};
  TriangleStream stream(lattice_of(mesh), 0, std::vector<unsigned char>(3, 0));
  EXPECT_EQ(in_pieces(stream, 6), (std::vector<Index>{0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5, 0, 5, 6, 0, 6, 7}));
  ASSERT_TRUE(stream.tell_faces_apart());
  EXPECT_EQ(in_pieces(stream, 6), (std::vector<Index>{0, 1, 2, 0, 2, 3, 3, 4, 5, 3, 5, 0, 0, 5, 6, 0, 6, 7}));
}

TEST(TriangleStream, leaves_holes_out_wherever_they_are) {
  const ControlMesh mesh = shapes::cube();
  std::vector<std::vector<unsigned char>> all = {std::vector<unsigned char>(mesh.face_count(), 1)};
  for (const std::size_t begin : {0, 5, 11}) {
    all.emplace_back(mesh.face_count(), 0);
    for (std::size_t face = begin; face < mesh.face_count(); face += 2) all.back()[face] = 1;
  }
  for (const auto& holes : all)
    for (const Index level : {0, 1, 3, 4, 6}) expect_whole(mesh, level, holes);
}

// A slow reader keeps the base mesh's connectivity in memory: the numbers of every array of it.
TEST(TriangleStream, knows_what_it_keeps_in_memory) {
  for (const auto& [name, mesh] : shapes::all_shapes()) {
    const auto topology = std::make_shared<const Topology<Triangles>>(static_cast<Index>(mesh.point_count()),
                                                                      Triangles(mesh.face_vertex_indices));
    const TriangleStream stream(
        std::make_shared<const Lattice>(std::shared_ptr<const Connectivity<Triangles>>(topology)), 5,
        std::vector<unsigned char>(mesh.face_count(), 0));
    Count bytes = mesh.face_count() + topology->corner_vertices().size_bytes() +
                  topology->half_edge_edges().size_bytes() + topology->edge_vertices().size_bytes() +
                  topology->edge_sides().size_bytes() + topology->edge_kinds().size_bytes() +
                  topology->all_vertex_edges().size_bytes() + topology->vertex_edge_offsets().size_bytes() +
                  topology->non_manifold_vertices().size_bytes();
    for (Index v = 0; v < topology->vertex_count(); ++v)
      bytes += topology->vertex_corners(v).size_bytes() + sizeof(Index);
    EXPECT_GE(stream.held_bytes(), bytes) << name;
    EXPECT_LT(stream.held_bytes(), 3 * bytes) << name;
  }
}

TEST(TriangleStream, of_nothing_is_empty) {
  TriangleStream stream;
  EXPECT_EQ(stream.index_count(), 0u);
  std::vector<Index> piece(1000);
  EXPECT_EQ(stream.next(piece), 0u);
  EXPECT_TRUE(stream.all(1, {})->empty());
}

// A face of the deepest level has 3 * 2^30 indices; its rows are made one by one.
TEST(TriangleStream, needs_room_for_a_row_and_not_for_a_face) {
  ControlMesh mesh;
  mesh.points.resize(9);
  mesh.face_vertex_indices = {0, 1, 2};
  TriangleStream stream(lattice_of(mesh), kMaxLevel, std::vector<unsigned char>(1, 0));
  EXPECT_LT(stream.least_room(), Count{1} << 18);
  std::vector<Index> piece(stream.least_room());
  EXPECT_EQ(stream.next(piece), 3 * (2 * segments(kMaxLevel) - 1));
}

}  // namespace
}  // namespace subdivd
