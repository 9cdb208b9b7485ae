#include "tests/shapes/shapes.h"

#include <iterator>

namespace subdivd::shapes {

std::vector<NamedShape> all_shapes() {
  std::vector<NamedShape> all;
  for (const auto family : {closed_shapes, border_shapes, crease_shapes, corner_shapes, non_manifold_shapes,
                            seam_shapes, primvar_shapes}) {
    std::vector<NamedShape> shapes = family();
    all.insert(all.end(), std::make_move_iterator(shapes.begin()), std::make_move_iterator(shapes.end()));
  }
  return all;
}

}  // namespace subdivd::shapes
