#pragma once

#include <optional>
#include <vector>

#include "common/drawing/box.hpp"

namespace priamos::drawing {

/// A label that wants to stand near the point it names.
struct LabelWish {
  Eigen::Vector2d at{0, 0};      ///< the point that it names
  double width = 0, height = 0;  ///< size of the text [px]
  double distance = 0;           ///< from `at` to the label's border, at least [px]
  bool centred = false;          ///< stand on the point itself if that is free
};

/// Areas and lines that labels avoid.
struct Surroundings {
  Box page;                            ///< no label leaves it
  std::vector<Box> taken;              ///< never covered
  std::vector<Eigen::Vector2d> lines;  ///< points of lines: covered only where nothing else is left
};

/// A place for every label, in the order of the wishes: inside the page, off what is taken, off each other,
/// and as near to its point as that allows. None for a label that fits nowhere.
std::vector<std::optional<Box>> PlaceLabels(const std::vector<LabelWish>& wishes, const Surroundings& around);

}  // namespace priamos::drawing
