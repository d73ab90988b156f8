#pragma once

#include "head/core/camera/head_model.hpp"
#include "head/core/landmark/landmark.hpp"

namespace priamos::head {

/// A head of one focal length, 890 px: half the picture is 23 degrees broad and 18 high.
inline HeadModel HeadOfOneLens() {
  HeadModel head;
  for (LensTable& lens : head.lenses)
    lens = LensTable({250}, {1600}, {LensState{890, {383.5, 287.5}, 0, 0, 0.02}});
  return head;
}

/// Jambs and frame on both sides, and a lintel.
inline LandmarkModel DoorOfFiveEdges() {
  LandmarkModel model;
  for (const double y : {0.45, 0.51}) {
    model.edges.push_back({{0, y, 0}, {0, y, 2}, -kPi, kPi, 1});
    model.edges.push_back({{0, -y, 0}, {0, -y, 2}, -kPi, kPi, 2});
  }
  model.edges.push_back({{0, -0.45, 2}, {0, 0.45, 2}, -kPi, kPi, 0});
  return model;
}

}  // namespace priamos::head
