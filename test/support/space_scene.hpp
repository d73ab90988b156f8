#pragma once

#include <Eigen/Core>
#include <array>
#include <deque>
#include <vector>

#include "common/random.hpp"
#include "head/core/stereo/view_line.hpp"

namespace priamos::test {

/// Straight edges of an indoor scene, as the operator would give them in three images: with noise, some
/// broken, some missing, some of no edge at all. The truth is known for every image line.
struct SpaceScene {
  struct Edge {
    Eigen::Vector3d from, to;
    double dark = 80, bright = 140;
  };
  struct Options {
    int n_edges = 120;
    double noise_px = 0.05, missing = 0.1, broken = 0.1;
    int n_clutter = 40;
    bool only_horizontal = false;
  };

  SpaceScene(const Options& options, Rng& rng);

  std::vector<Edge> edges;
  std::array<head::CameraModel, 3> cameras;  ///< left, right, third (above, between them)
  std::array<head::EdgeImage, 3> images;
  std::array<std::vector<int>, 3> truth;  ///< edge of each segment, -1 for clutter
  std::deque<head::CameraView> views;
};

}  // namespace priamos::test
