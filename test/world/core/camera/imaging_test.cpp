#include "world/core/camera/imaging.hpp"

#include <gtest/gtest.h>

#include "common/config.hpp"

namespace priamos::world {
namespace {

TEST(ImagingConfig, RefusesNonsense) {
  EXPECT_THROW(ParseConfig<ImagingConfig>("x.toml", "sub_exposures = 0"), ConfigError);
  EXPECT_THROW(ParseConfig<ImagingConfig>("x.toml", "read_noise = -1"), ConfigError);
  EXPECT_EQ(ParseConfig<ImagingConfig>("x.toml", "sub_exposures = 8").sub_exposures, 8);
}

}  // namespace
}  // namespace priamos::world
