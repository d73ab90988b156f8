#pragma once

#include "common/random.hpp"
#include "head/core/camera/camera_model.hpp"
#include "head/core/camera/head_setting.hpp"
#include "world/core/camera/optics.hpp"

namespace priamos::bench {

/// Where the axes rest when a setting was approached from below: gears have play, motors repeat only so well.
world::HeadAxes RestAfter(const head::HeadSetting& setting, Rng& rng);

/// The camera that the simulator draws with.
head::CameraModel ExactCamera(const world::HeadBuild& build, int camera, const world::HeadAxes& axes);

}  // namespace priamos::bench
