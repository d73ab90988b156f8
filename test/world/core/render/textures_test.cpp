#include "world/core/render/textures.hpp"

#include <gtest/gtest.h>

#include <set>

#include "world/core/render/texture_pictures.hpp"
#include "world/core/scene/scene.hpp"

namespace priamos::world {
namespace {

TEST(Textures, EveryMaterialHasOne) {
  const Textures dut(1);
  for (const std::string& material : MaterialNames()) {
    const Surface surface = dut.Find(material, "a solid");
    ASSERT_LT(surface.layer, static_cast<int>(dut.layers().size()));
    const cv::Mat& layer = dut.layers()[surface.layer];
    EXPECT_EQ(layer.type(), CV_8U);
    EXPECT_EQ(layer.size(), cv::Size(kTextureSide, kTextureSide));
    EXPECT_GT(cv::mean(layer)[0], 20) << material;
    EXPECT_LT(cv::mean(layer)[0], 245) << material;
  }
}

TEST(Textures, AnUnknownMaterialIsNamed) {
  try {
    Textures(1).Find("cheese", "north wall");
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("cheese"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("north wall"), std::string::npos);
  }
}

TEST(Textures, TheSeedDecides) {
  const auto differ = [](const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF) > 0; };
  const Textures a(1), again(1), b(2);
  ASSERT_EQ(a.layers().size(), b.layers().size());
  for (std::size_t i = 0; i < a.layers().size(); ++i) {
    EXPECT_FALSE(differ(a.layers()[i], again.layers()[i]));
    EXPECT_TRUE(differ(a.layers()[i], b.layers()[i]));
  }
}

TEST(Textures, CoveringContinuesAtTheBorder) {
  const Textures dut(1);
  const cv::Mat& plaster = dut.layers()[dut.Find("plaster", "").layer];
  const double seam = cv::norm(plaster.col(0), plaster.col(kTextureSide - 1), cv::NORM_L1);
  const double inside = cv::norm(plaster.col(200), plaster.col(201), cv::NORM_L1);
  EXPECT_LT(seam, 2 * inside);
}

TEST(Textures, PostersDifferByName) {
  const Textures dut(1);
  std::set<int> layers;
  for (int i = 0; i < 10; ++i) layers.insert(dut.Find("poster", "poster " + std::to_string(i)).layer);
  EXPECT_GT(layers.size(), 4U);
  EXPECT_TRUE(dut.Find("poster", "a").picture);
  EXPECT_FALSE(dut.Find("plaster", "a").picture);
}

}  // namespace
}  // namespace priamos::world
