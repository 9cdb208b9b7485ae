#pragma once
// The meshes that everything is timed on. Points and faces stand in the order in which a modeller or scanner
// would write them: ring by ring, band by band, never shuffled. The same on every machine.

#include <string>
#include <vector>

#include "core/mesh/control_mesh.h"

namespace subdivd::bench {

struct Workload {
  std::string name;
  std::vector<Index> levels;
  ControlMesh mesh;
  std::vector<float> points;  // the mesh's, in single precision

  // The mesh's topology as libraries that count in int want it.
  int face_size = 3;                  // corners of every face, 3 or 4
  std::vector<int> corners, creases;  // creases: 2 per creased edge
};

// icosahedron  12 points, 20 triangles; levels 6 and 8.
// blob100k     closed, lumpy, 100,352 triangles, every edge that may be flipped as likely as any other until
//              two thirds of the points are irregular (valences 4 to 9); levels 1 to 3.
// torus1m      1000 x 500 quads with jittered points, each cut along one of its diagonals at random:
//              1,000,000 triangles; levels 1 and 2.
// model6k      a jar, open above and below, with two slots in its side: 6,060 triangles, four borders;
//              infinite creases around rim and foot, semi-sharp ones around the shoulders and down two seams;
//              levels 3 to 5.
// scan120k     like blob100k, of 119,072 triangles; levels 1 to 3.
// By Catmull and Clark's scheme:
// quads6k      the jar of 6,090 quads, with the same creases and slots; levels 3 to 5.
// quads100k    closed, lumpy, 101,400 quads: every triangle of a lumpy sphere cut into three, two thirds of whose points
//              are irregular; levels 2 and 3.
// quads1m      the torus of 1000 x 1000 quads; levels 1 and 2.
Workload icosahedron();
Workload blob100k();
Workload scan120k();
Workload torus1m();
Workload model6k();
Workload quads6k();
Workload quads100k();
Workload quads1m();

}  // namespace subdivd::bench
