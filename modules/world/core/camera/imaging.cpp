#include "world/core/camera/imaging.hpp"

namespace priamos::world {

void ImagingConfig::Describe(Archive& a) {
  a.Integer("sub_exposures", sub_exposures,
            {"-", 1, 64, "pictures over the exposure time that are averaged"});
  a.Number("blur_px", blur_px, {"px", 0, 5, "sigma of the lens at best focus"});
  a.Number("defocus_px", defocus_px, {"px/dioptre", 0, 50, "sigma per dioptre of wrong focus at 1000 px"});
  a.Flag("focus_by_distance", focus_by_distance,
         "each thing is as sharp as its distance has it; off: all are as sharp as the median distance");
  a.Number("vignetting", vignetting, {"-", 0, 0.9, "loss of light in the corners at 800 px focal length"});
  a.Number("read_noise", read_noise, {"grey level", 0, 50, "sigma at gain 1"});
  a.Number("photon_noise", photon_noise, {"grey level", 0, 10, "variance per grey level at gain 1"});
  a.Number("black_level", black_level, {"grey level", 0, 100, "without light"});
  a.Number("white_level", white_level, {"grey level", 1, 1000, "white under full light at 10 ms, gain 1"});
}

}  // namespace priamos::world
