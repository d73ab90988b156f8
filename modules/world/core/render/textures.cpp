#include "world/core/render/textures.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "common/random.hpp"
#include "world/core/render/texture_pictures.hpp"
#include "world/core/scene/scene.hpp"

namespace priamos::world {

namespace {

constexpr int kPosters = 16;
constexpr double kMirrorGrey = 0.30;  // a room is darker than its white walls

/// Smooth noise with `cells_x` by `cells_y` bumps, mean 0, about +-1, seamless.
cv::Mat Noise(Rng& rng, int cells_x, int cells_y) {
  cv::Mat grid(cells_y, cells_x, CV_32F);
  for (auto it = grid.begin<float>(); it != grid.end<float>(); ++it)
    *it = static_cast<float>(rng.Uniform(-1, 1));
  constexpr int kMargin = 2;
  cv::Mat wrapped, large;
  cv::copyMakeBorder(grid, wrapped, kMargin, kMargin, kMargin, kMargin, cv::BORDER_WRAP);
  const double sx = double(kTextureSide) / cells_x, sy = double(kTextureSide) / cells_y;
  cv::resize(wrapped, large, {}, sx, sy, cv::INTER_CUBIC);
  const cv::Rect inner(static_cast<int>(kMargin * sx), static_cast<int>(kMargin * sy), kTextureSide,
                       kTextureSide);
  return large(inner).clone();
}

/// Reflectance of a rough covering: its mean, and the amplitudes of three layers of noise.
struct Covering {
  double albedo;  ///< mean
  double coarse;  ///< amplitude at 4 bumps a side
  double middle;  ///< amplitude at 32 bumps a side
  double fine;    ///< amplitude at 256 bumps a side
};

cv::Mat Covered(Rng& rng, const Covering& covering) {
  cv::Mat image(kTextureSide, kTextureSide, CV_32F, cv::Scalar(covering.albedo));
  image += covering.coarse * Noise(rng, 4, 4) + covering.middle * Noise(rng, 32, 32) +
           covering.fine * Noise(rng, 256, 256);
  return image;
}

/// Grain along v (up the box).
cv::Mat Grain(Rng& rng, double albedo, double contrast) {
  cv::Mat image(kTextureSide, kTextureSide, CV_32F, cv::Scalar(albedo));
  image += contrast * (Noise(rng, 16, 2) + 0.7 * Noise(rng, 64, 4) + 0.5 * Noise(rng, 256, 8));
  return image;
}

/// Floor tiles, `count` a side, with joints; each tile a little different.
cv::Mat Tiles(Rng& rng, int count, double albedo, double spread) {
  cv::Mat image = Covered(rng, {.albedo = albedo, .coarse = 0.01, .middle = 0.01, .fine = 0.02});
  const int side = kTextureSide / count;
  for (int y = 0; y < count; ++y) {
    for (int x = 0; x < count; ++x) {
      const cv::Rect tile(x * side, y * side, side, side);
      image(tile) += rng.Uniform(-spread, spread);
      cv::rectangle(image, tile, cv::Scalar(albedo * 0.75), 2);
    }
  }
  return image;
}

}  // namespace

Textures::Textures(std::uint64_t seed) {
  Rng rng = Rng::Stream(seed, "textures");
  // The order is that of MaterialNames().
  Add(Covered(rng, {.albedo = 0.74, .coarse = 0.02, .middle = 0.008, .fine = 0.02}));    // plaster
  Add(Covered(rng, {.albedo = 0.50, .coarse = 0.04, .middle = 0.03, .fine = 0.03}));     // concrete
  Add(Grain(rng, 0.42, 0.05));                                                           // wood
  Add(Covered(rng, {.albedo = 0.40, .coarse = 0.005, .middle = 0.003, .fine = 0.004}));  // door frame
  Add(LeafPicture(Grain(rng, 0.56, 0.015)));                                             // door leaf
  Add(Covered(rng, {.albedo = 0.24, .coarse = 0.01, .middle = 0.01, .fine = 0.01}));     // skirting
  Add(Covered(rng, {.albedo = 0.33, .coarse = 0.02, .middle = 0.02, .fine = 0.05}));     // lino
  Add(Tiles(rng, 4, 0.45, 0.03));                                                        // tiles
  Add(Covered(rng, {.albedo = 0.22, .coarse = 0.02, .middle = 0.02, .fine = 0.04}));     // carpet
  Add(Tiles(rng, 4, 0.82, 0.01));                                                        // ceiling
  Add(Grain(rng, 0.50, 0.03));                                                           // furniture
  Add(CupboardPicture(Grain(rng, 0.52, 0.03)));                                          // cupboard
  Add(Covered(rng, {.albedo = 0.48, .coarse = 0.02, .middle = 0.01, .fine = 0.01}));     // metal
  Add(Covered(rng, {.albedo = 0.46, .coarse = 0.03, .middle = 0.01, .fine = 0.02}));     // cardboard
  Add(Covered(rng, {.albedo = 0.30, .coarse = 0.03, .middle = 0.03, .fine = 0.06}));     // fabric
  first_poster_ = static_cast<int>(layers_.size());
  posters_ = kPosters;
  for (int i = 0; i < kPosters; ++i) Add(PosterPicture(rng));
  Rng smears = Rng::Stream(seed, "mirror");
  mirror_ = Add(Covered(smears, {.albedo = kMirrorGrey, .coarse = 0.01, .middle = 0.004, .fine = 0.004}));
}

int Textures::Add(const cv::Mat& layer) {
  cv::Mat bytes;
  layer.convertTo(bytes, CV_8U, 255);
  layers_.push_back(bytes);
  return static_cast<int>(layers_.size()) - 1;
}

Surface Textures::Find(const std::string& material, const std::string& solid_name) const {
  const auto& names = MaterialNames();
  const auto found = std::find(names.begin(), names.end(), material);
  if (found == names.end())
    throw std::invalid_argument("unknown material \"" + material + "\" of " + solid_name);
  const int layer = static_cast<int>(found - names.begin());
  const auto index = [&](const char* name) {
    return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  if (material == "poster") {
    const int choice = static_cast<int>(Rng::Stream(0, solid_name).Below(posters_));
    return {first_poster_ + choice, 1, true, index("plaster"), false};
  }
  // Nobody draws the glass.
  if (IsMirror(material) || IsGlass(material)) return {mirror_, 1, false, mirror_, false};
  if (material == "door_leaf") return {layer, 1, true, index("furniture"), true};
  if (material == "cupboard") return {layer, 1, true, index("furniture"), false};
  const bool large = material == "tiles" || material == "ceiling" || material == "plaster";
  return {layer, large ? 2.0 : 1.2, false, layer, false};
}

}  // namespace priamos::world
