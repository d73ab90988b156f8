#pragma once

#include "head/core/bodies/polyhedron.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::test {

/// A cupboard of 0.6 x 0.8 x 1.2 m, its front at x = 0, each face with its grey value.
struct GreyCupboard {
  head::Polyhedron body;
  std::vector<Quad> quads;

  GreyCupboard() {
    const double x = 0.6, y = 0.8, z = 1.2;
    body.points = {{0, 0, 0}, {0, y, 0}, {0, y, z}, {0, 0, z}, {x, 0, 0}, {x, y, 0}, {x, y, z}, {x, 0, z}};
    body.faces = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 4, 7, 3}, {1, 2, 6, 5}, {3, 7, 6, 2}, {0, 1, 5, 4}};
    const auto quad = [&](int corner, int u, int v, double grey) {
      const auto& p = body.points;
      quads.push_back({p[corner], p[u] - p[corner], p[v] - p[corner], grey});
    };
    quad(0, 1, 3, 180);
    quad(4, 5, 7, 180);
    quad(0, 4, 3, 120);
    quad(1, 5, 2, 140);
    quad(3, 7, 2, 210);
  }
};

}  // namespace priamos::test
