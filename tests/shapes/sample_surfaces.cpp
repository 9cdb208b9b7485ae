// The cages of the sample.
#include <cmath>
#include <numbers>
#include <span>

#include "tests/shapes/sample.h"

namespace subdivd::shapes {
namespace {

using Corner = SampleCorner;
using Point = std::array<double, 3>;

// A multiple of 1/4096, never -0.
double rounded(double x) { return std::round(x * 4096) / 4096 + 0.0; }

Index add_point(SampleSurface& surface, double x, double y, double z) {
  surface.points.push_back({rounded(x), rounded(y), rounded(z)});
  return static_cast<Index>(surface.points.size() - 1);
}

void add_quad(SampleSurface& surface, const Corner& a, const Corner& b, const Corner& c, const Corner& d,
              std::size_t material) {
  surface.faces.push_back({{a, b, c}, material});
  surface.faces.push_back({{a, c, d}, material});
}

struct Ring {
  double radius, height;
};

// --- the jug ------------------------------------------------------------------------------------------

// From the underside over foot, belly, neck and lip, and down again inside.
constexpr Ring kJug[] = {{0.34, 0.04}, {0.54, 0.00}, {0.60, 0.14}, {0.90, 0.50}, {1.02, 0.92}, {0.88, 1.36},
                         {0.58, 1.72}, {0.50, 2.04}, {0.60, 2.34}, {0.74, 2.52}, {0.70, 2.60}, {0.60, 2.50},
                         {0.40, 2.04}, {0.46, 1.70}, {0.76, 1.34}, {0.88, 0.92}, {0.62, 0.40}};
constexpr Index kRings = std::size(kJug);
constexpr Index kColumns = 15;      // odd: column 0 is the spout, the handle's quad is opposite
constexpr Index kHandleColumn = 7;  // between columns 7 and 8
constexpr Index kFirstGlazed = 1;   // rows of quads: row r lies between rings r and r + 1
constexpr Index kLastGlazed = 10;
constexpr Index kUpperRow = 7, kLowerRow = 4;  // where the handle joins

class Jug {
 public:
  SampleSurface make() {
    for (Index r = 0; r < kRings; ++r)
      for (Index c = 0; c < kColumns; ++c) add_ring_point(r, c);
    for (Index r = 0; r + 1 < kRings; ++r)
      for (Index c = 0; c < kColumns; ++c)
        if (c != kHandleColumn || (r != kUpperRow && r != kLowerRow)) add_wall(r, c);
    add_floor(0, 0.05, false);
    add_floor(kRings - 1, 0.30, true);
    add_handle();
    return std::move(jug_);
  }

 private:
  static Index point(Index ring, Index column) { return ring * kColumns + column % kColumns; }

  void add_ring_point(Index r, Index c) {
    const double angle = 2 * std::numbers::pi * c / kColumns;
    // The lip is drawn out to a spout where the angle is small, most at the rim.
    const double near_spout = std::pow(std::max(0.0, std::cos(angle)), 8);
    const double near_rim = std::exp(-8 * (kJug[r].height - 2.56) * (kJug[r].height - 2.56));
    const double radius = kJug[r].radius + 0.34 * near_spout * near_rim;
    add_point(jug_, radius * std::cos(angle), kJug[r].height + 0.10 * near_spout * near_rim,
              -radius * std::sin(angle));
  }

  // Glaze: around and along, with a seam at column 0. Clay: seen from above.
  Corner corner(Index r, Index c, bool glazed) const {
    const Index p = point(r, c);
    if (glazed)
      return {p, double(c) / kColumns, rounded(0.86 * (r - kFirstGlazed) / (kLastGlazed + 1 - kFirstGlazed))};
    return {p, 0.5 + jug_.points[p][0] / 4, 0.5 + jug_.points[p][2] / 4};
  }

  void add_wall(Index r, Index c) {
    const bool glazed = r >= kFirstGlazed && r <= kLastGlazed;
    add_quad(jug_, corner(r, c, glazed), corner(r, c + 1, glazed), corner(r + 1, c + 1, glazed),
             corner(r + 1, c, glazed), glazed ? kGlaze : kClay);
  }

  void add_floor(Index ring, double height, bool seen_from_above) {
    const Corner centre = {add_point(jug_, 0, height, 0), 0.5, 0.5};
    for (Index c = 0; c < kColumns; ++c) {
      const Corner here = corner(ring, c, false), next = corner(ring, c + 1, false);
      jug_.faces.push_back(seen_from_above ? SampleSurface::Face{{centre, here, next}, kClay}
                                           : SampleSurface::Face{{centre, next, here}, kClay});
    }
  }

  // A tube of four-cornered sections: two corners towards the body's axis, two away from it.
  //
  //   2 ---- 3   outside of the bow        0, 3: column kHandleColumn   1, 2: the next one
  //   |      |
  //   1 ---- 0   inside of the bow
  void add_handle() {
    using Section = std::array<Index, 4>;
    std::vector<Section> sections = {section_of_wall(kUpperRow, kUpperRow + 1)};
    struct Knot {
      double x, y, direction;  // direction of the bow's outside, in turns from +x towards +y
    };
    for (const Knot& k : {Knot{-0.86, 2.30, 0.30},
                          {-1.16, 2.22, 0.38},
                          {-1.38, 1.98, 0.46},
                          {-1.46, 1.66, 0.51},
                          {-1.42, 1.34, 0.57},
                          {-1.28, 1.10, 0.63}}) {
      const double dx = 0.075 * std::cos(2 * std::numbers::pi * k.direction);
      const double dy = 0.075 * std::sin(2 * std::numbers::pi * k.direction);
      constexpr double kHalfWidth = 0.13;
      // Column kHandleColumn lies at negative z (before the turn of half a circle), the next one at positive
      // z.
      sections.push_back({add_point(jug_, k.x - dx, k.y - dy, -kHalfWidth),
                          add_point(jug_, k.x - dx, k.y - dy, kHalfWidth),
                          add_point(jug_, k.x + dx, k.y + dy, kHalfWidth),
                          add_point(jug_, k.x + dx, k.y + dy, -kHalfWidth)});
    }
    sections.push_back(section_of_wall(kLowerRow + 1, kLowerRow));
    for (std::size_t s = 0; s + 1 < sections.size(); ++s)
      for (Index k = 0; k < 4; ++k) {
        const Index next = (k + 1) % 4;
        const auto at = [&](std::size_t section, Index side, Index side_of_corner) {
          return Corner{sections[section][side], 0.25 * side_of_corner,
                        rounded(0.90 + 0.10 * double(section) / double(sections.size() - 1))};
        };
        add_quad(jug_, at(s, k, k), at(s, next, k + 1), at(s + 1, next, k + 1), at(s + 1, k, k), kGlaze);
      }
  }

  static std::array<Index, 4> section_of_wall(Index inside_ring, Index outside_ring) {
    return {point(inside_ring, kHandleColumn), point(inside_ring, kHandleColumn + 1),
            point(outside_ring, kHandleColumn + 1), point(outside_ring, kHandleColumn)};
  }

  SampleSurface jug_;
};

// --- the pear -----------------------------------------------------------------------------------------

constexpr Ring kPear[] = {{0.16, 0.06}, {0.42, 0.10}, {0.60, 0.40}, {0.54, 0.76},
                          {0.34, 1.06}, {0.28, 1.30}, {0.14, 1.44}};
constexpr Ring kStem[] = {{0.06, 1.30}, {0.045, 1.50}, {0.05, 1.72}};

// A closed surface of revolution, its axis leaning by `lean` per height squared.
void revolve(SampleSurface& surface, std::span<const Ring> rings, Index columns, double lean, double below,
             double above, std::size_t material) {
  const auto first = static_cast<Index>(surface.points.size());
  for (const Ring& ring : rings)
    for (Index c = 0; c < columns; ++c) {
      const double angle = 2 * std::numbers::pi * c / columns;
      add_point(surface, ring.radius * std::cos(angle) + lean * ring.height * ring.height, ring.height,
                -ring.radius * std::sin(angle));
    }
  const auto rows = static_cast<Index>(rings.size());
  const auto at = [&](Index r, Index c) { return Corner{first + r * columns + c % columns, 0, 0}; };
  const Corner bottom = {add_point(surface, lean * below * below, below, 0), 0, 0};
  const Corner top = {add_point(surface, lean * above * above, above, 0), 0, 0};
  for (Index c = 0; c < columns; ++c) {
    surface.faces.push_back({{bottom, at(0, c + 1), at(0, c)}, material});
    for (Index r = 0; r + 1 < rows; ++r)
      add_quad(surface, at(r, c), at(r, c + 1), at(r + 1, c + 1), at(r + 1, c), material);
    surface.faces.push_back({{top, at(rows - 1, c), at(rows - 1, c + 1)}, material});
  }
}

// Green below, yellow above, red where the sun came from.
Point pear_colour(const Point& p) {
  const double ripe = std::min(1.0, std::max(0.0, p[1] / 1.4));
  const double sunny = std::max(0.0, p[0] + 0.6 * p[2]);
  return {rounded(std::min(1.0, 0.50 + 0.34 * ripe + 0.35 * sunny)),
          rounded(0.58 + 0.10 * ripe - 0.45 * sunny), rounded(0.08 + 0.04 * ripe)};
}

}  // namespace

SampleSurface sample_jug() { return Jug().make(); }

SampleSurface sample_pear() {
  SampleSurface pear;
  revolve(pear, kPear, 9, 0.05, 0.12, 1.42, kPearSkin);
  for (const Point& point : pear.points) pear.colours.push_back(pear_colour(point));
  revolve(pear, kStem, 5, 0.09, 1.30, 1.73, kWood);
  pear.colours.resize(pear.points.size(), {rounded(0.30), rounded(0.18), rounded(0.08)});
  return pear;
}

}  // namespace subdivd::shapes
