#pragma once

#include "common/archive.hpp"

namespace priamos::world {

/// Lens blur, sensor and noise, alike for the three cameras.
struct ImagingConfig {
  int sub_exposures = 4;           ///< pictures over the exposure time that are averaged
  double blur_px = 0.6;            ///< sigma of the lens at best focus
  double defocus_px = 4.0;         ///< sigma per dioptre of wrong focus at 1000 px focal length
  bool focus_by_distance = false;  ///< things at other distances are otherwise sharp; off: the whole picture
                                   ///< is as sharp as what is at the median distance
  double vignetting = 0.25;        ///< loss of light in the corners at 800 px focal length
  double read_noise = 1.2;         ///< sigma [grey levels] at gain 1
  double photon_noise = 0.02;      ///< variance per grey level at gain 1
  double black_level = 8;          ///< grey level without light
  double white_level = 230;        ///< grey level of white under full light at 10 ms, gain 1

  void Describe(Archive& a);
};

/// Settings of one exposure.
struct Exposure {
  double exposure_s = 0.010;
  double gain = 1;
  double camera_light = 0;  ///< lamp beside the lens; 1 makes retro-reflective discs white at 10 ms, gain 1
  double laser = 0;         ///< the laser line; 1 makes it white at 10 ms, gain 1
  double defocus_dioptre = 0;  ///< the lens is set nearer than its motor says by this [1/m]
};

}  // namespace priamos::world
