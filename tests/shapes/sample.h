#pragma once
// The sample of the README: a jug and a pear as glTF, a vase as JSON. Bytes are the same on every machine:
// coordinates are rounded to a grid that is coarse against any difference between mathematical libraries.

#include <array>
#include <string>
#include <vector>

#include "core/base/index.h"

namespace subdivd::shapes {

// One corner of a face: a point, and what the surface carries there.
struct SampleCorner {
  Index point = 0;
  double u = 0, v = 0;
};

// A cage whose faces belong to materials. Faces are triangles, counter-clockwise from outside; y is up.
struct SampleSurface {
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<double, 3>>
      colours;  // per point; empty: none, and corners carry texture coordinates
  struct Face {
    std::array<SampleCorner, 3> corners;
    std::size_t material = 0;
  };
  std::vector<Face> faces;
};

inline constexpr std::size_t kGlaze = 0, kClay = 1, kPearSkin = 2, kWood = 3;

SampleSurface sample_jug();   // closed, of genus 1; kGlaze outside, kClay inside and below
SampleSurface sample_pear();  // kPearSkin, and a stem of kWood

// 256 x 256 pixels of four colours, for the glaze; v runs from the foot (0) to the lip (0.86), the handle
// uses 0.9 to 1.
std::string sample_texture_png();

std::string sample_glb();
// A vase with a creased rim and a texture seam down one side, as a body of POST /v1/refine.
std::string sample_vase_json();

}  // namespace subdivd::shapes
