#include "test/bench/vision/corridor_states.hpp"

#include <fmt/format.h>

namespace priamos::bench {
namespace {

constexpr std::array<const char*, 4> kNames{"unknown", "closed", "ajar", "open"};

head::DoorState TrueState(const TrueDoor& door) {
  if (door.open_deg == 0) return head::DoorState::kClosed;
  return door.open_deg < 30 ? head::DoorState::kAjar : head::DoorState::kOpen;
}

GreyImage Copy(const cv::Mat& image) {
  return {image.cols, image.rows, std::vector<std::uint8_t>(image.datastart, image.dataend)};
}

}  // namespace

void StateTally::Add(const CorridorLook& look, const TrueDoor& truth, const head::DetectedDoor& door,
                     bool verbose) {
  const std::array<GreyImage, 2> images{Copy(look.images[0]), Copy(look.images[1])};
  const head::StereoPictures pictures{{&images[0], &images[1]}, {&look.calibrated[0], &look.calibrated[1]}};
  const head::OpeningShape opening{door.base_from_door, door.width_m, door.height_m};
  const double start = CpuSeconds();
  const auto surfaces = head::SurfacesIn(opening, pictures);
  const auto evidence = head::StateOf(opening, surfaces);
  seconds_ += CpuSeconds() - start;
  ++n_;
  const head::DoorState is = TrueState(truth), told = evidence.State(kLead);
  ++told_[static_cast<std::size_t>(is)][static_cast<std::size_t>(told)];
  if (!verbose || told == is) return;
  fmt::print("  {} ({:.0f} degrees, {}) told {}: {} surfaces, {:.1f} {:.1f} {:.1f}, {:.1f} m, slant {:.0f}\n",
             kNames[static_cast<std::size_t>(is)], truth.open_deg, truth.opens_to_us ? "to us" : "away",
             kNames[static_cast<std::size_t>(told)], surfaces.size(), evidence.log_likelihood[0],
             evidence.log_likelihood[1], evidence.log_likelihood[2], truth.range_m, truth.slant_deg);
  for (const auto& s : surfaces) fmt::print(" ({:.2f},{:.2f})", s.at.x(), s.at.y());
  fmt::print("\n");
}

void StateTally::Print(Figures& figures) const {
  int right = 0, wrong = 0;
  for (std::size_t is = 1; is < 4; ++is) {
    fmt::print("  {}:", kNames[is]);
    for (std::size_t told = 0; told < 4; ++told) {
      fmt::print(" {} {}", kNames[told], told_[is][told]);
      right += told == is ? told_[is][told] : 0;
      wrong += told != is && told != 0 ? told_[is][told] : 0;
    }
    fmt::print("\n");
  }
  figures.Note("  state told by one look, of doors that were found",
               100.0 * (right + wrong) / std::max(1, n_), "%");
  figures.AtLeast("  of these right", 100.0 * right / std::max(1, right + wrong), 97, "%");
  figures.Note("  time for the state of a door", 1000 * seconds_ / std::max(1, n_), "ms");
}

}  // namespace priamos::bench
