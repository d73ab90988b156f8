#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace priamos::world {

/// How a material is laid on a box.
struct Surface {
  int layer = 0;         ///< texture
  double tile_m = 1;     ///< length of the texture's side on the surface ...
  bool picture = false;  ///< ... unless it shows one picture on front and back, filling each
  int edge_layer = 0;    ///< texture of the other faces of a picture
  bool handed = false;   ///< the picture is mirrored on the back: a door handle is on one side of the door
};

/// Grey albedo textures of one world: squares of kTextureSide that continue at their borders. White is 1.
class Textures {
 public:
  explicit Textures(std::uint64_t seed);

  /// The surface of a material; `solid_name` chooses among the posters. std::invalid_argument for an unknown
  /// one.
  Surface Find(const std::string& material, const std::string& solid_name) const;
  const std::vector<cv::Mat>& layers() const { return layers_; }

 private:
  int Add(const cv::Mat& layer);

  std::vector<cv::Mat> layers_;
  int first_poster_ = 0, posters_ = 0, mirror_ = 0;
};

}  // namespace priamos::world
