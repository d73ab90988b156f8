#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "head/core/scene/box_depth.hpp"
#include "head/core/scene/level_borders.hpp"
#include "head/core/scene/level_ends.hpp"
#include "head/core/scene/missing_border.hpp"
#include "head/core/scene/scene_object.hpp"
#include "head/core/scene/table_tops.hpp"
#include "head/core/scene/upright_edges.hpp"
#include "head/core/scene/upright_faces.hpp"
#include "head/core/stereo/edge_stereo.hpp"

namespace priamos::head {

/// What one look showed of the scene, base frame.
struct Scene {
  CameraModel left;  ///< which saw it
  std::vector<SceneObject> objects;
  std::vector<SceneEdge> edges;  ///< all that have a place in space
  std::vector<ImageLine> lines;  ///< all edges of its image, whether matched or not
};

/// How the edges of a scene are matched and grouped.
struct SceneOptions {
  StereoOptions stereo;  ///< for who matches the edges
  UprightOptions uprights;
  LevelEndOptions level_ends;
  FaceOptions faces;
  DepthOptions depth;
  LevelBorderOptions borders;
  TableTopOptions tops;
  double square_rad = 0.2;       ///< faces of a box are square to each other within this and 3 sigmas
  double corner_m = 0.04;        ///< ends of two faces that are nearer meet
  double same_top_m = 0.05;      ///< largest difference between the upper edges of a box's faces
  double min_edge_m = 0.3;       ///< height of an edge that stands alone
  double frame_sigma_m = 0.003;  ///< error of the calibrated base frame, and of arrises that are not sharp
  double arris_sigma_m = 0.015;  ///< along a front: what was taken for its arris may be a line beside it
};

/// Puts together what stands before the head (the paper's reconstruction of the scene): edges of space from
/// `matches` of both pictures, and beside them those of all three, then upright faces, then boxes. What
/// nothing joins to a face remains an edge. Level edges in the robot's height that belong to nothing of this
/// are borders of what hangs, where the picture of a `third` camera shows them too.
Scene ReconstructScene(const StereoViews& views, std::span<const StereoMatch> matches,
                       const SceneOptions& options, const CameraView* third = nullptr);

}  // namespace priamos::head
