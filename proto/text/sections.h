#pragma once
// An OBJ or OFF before it is text: arrays in the order of its lines, and what makes the lines of them.

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/budget.h"
#include "core/base/buffer.h"
#include "core/base/index.h"
#include "core/base/result.h"
#include "proto/name_list.h"
#include "proto/text/labels.h"
#include "proto/wire.h"

namespace subdivd::proto::text {

// Numbers of every row: `count` of each `stride`, and zeros behind them.
template <class Real>
struct Column {
  const Real* values = nullptr;
  Index stride = 0, count = 0, zeros = 0;
  bool decimal = false;  // 1 is written as 1.0: colours of an OFF that are whole numbers go to 255
};

// One line for each row: "v 1 2 3".
template <class Real>
struct Rows {
  std::string_view word;  // with the blank behind it; none in an OFF
  Count count = 0;
  std::array<Column<Real>, 4> columns = {};  // those with values
};

// Names of faces, by `g` or `usemtl`: those of faces that are not numbered here are none.
template <class Real>
struct Labels {
  const Real* numbers = nullptr;  // one per face, whole; null: no face has a name
  const NameList* names = nullptr;
};

// One line for each face. An OBJ's has its corners' points, texture coordinates and normals, an OFF's their
// number, points and the face's colour.
template <class Real>
struct Faces {
  Count count = 0;
  Index face_size = 3;                                          // 0: `counts` tells
  const Index* counts = nullptr;                                // one per face
  const Index* points = nullptr;                                // one per corner
  const Index* texcoords = nullptr;                             // one per corner; null: none
  bool has_normals = false;                                     // numbered as the points are
  Count first_point = 0, first_texcoord = 0, first_normal = 0;  // the numbers of those that are 0 here
  std::array<Labels<Real>, kLabelKinds> labels = {};            // OBJ
  Column<Real> color = {};                                      // OFF
};

// One line `l` for each curve over consecutive points.
struct Lines {
  const std::vector<Index>* counts = nullptr;
  Count first_point = 0;
  bool closed = false;  // ends with the point it begins with
};

// All of an answer, and the arrays that it is made from.
template <class Real>
struct Document {
  using Section = std::variant<std::string, Rows<Real>, Faces<Real>, Lines>;

  Format format = Format::obj;
  RefineAnswer<Real> answer;
  std::vector<std::array<NameList, kLabelKinds>> names;  // of every mesh
  std::vector<Section> sections;                         // point into both
  Count held_bytes = 0;                                  // of all of it
};

// Walks through the whole text once: it is as long as numbers are. Short texts are kept, others are made again
// while they are sent. Refuses (not_finite) numbers that are not finite.
template <class Real>
Result<Chunk> make_chunk(std::unique_ptr<const Document<Real>> document, const Budget& budget);

// What make_chunk() holds beside the document, at most.
Count chunk_bytes(Count text_bytes);

}  // namespace subdivd::proto::text
