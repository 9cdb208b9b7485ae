#pragma once
// The assets that whole requests are timed on: GLB bodies like those that people post.

#include <string>
#include <vector>

namespace subdivd::bench {

struct Asset {
  std::string name, glb;
};

// scan120k     a lumpy closed scan of 119,072 triangles, a colour of four bytes per vertex, in scanner order.
// shuffled120k the same, its vertices and its triangles in random order.
// textured15k  a closed body of 15,000 triangles with normals and texture coordinates, cut into charts of
//              5 x 5 quads: every seam has its vertices twice, those in corners of charts four times.
// jar6k        a modelled jar of 6,060 triangles, positions alone.
std::vector<Asset> request_assets();

}  // namespace subdivd::bench
