#include <fmt/format.h>

#include <array>
#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

#include "head/core/look/landmark_memory.hpp"
#include "test/bench/vision/cupboard_looks.hpp"
#include "test/bench/vision/door_looks.hpp"
#include "test/bench/vision/fix_series.hpp"
#include "test/bench/vision/landmark_fixes.hpp"
#include "test/bench/vision/rooms/made_up_doors.hpp"
#include "test/bench/vision/vision_bench.hpp"

namespace priamos::bench {
namespace {

using head::LandmarkMemory;

/// What stands in the place of the landmark that was looked at before.
struct Scene {
  const char* name;
  std::function<LandmarkLook(std::uint64_t seed, const CalibratedHead& head, int visit)> take;
};

/// Ways of remembering, side by side on the same images.
class Study {
 public:
  Study(std::vector<Scene> scenes, const VisionOptions& options)
      : scenes_(std::move(scenes)), options_(options), series_(scenes_.size()) {}

  void Run(int n) {
    for (int i = 0; i < n; ++i) {
      One(options_.seed + i);
      if (options_.verbose) Print();
    }
  }

  int Print() const {
    int wrong = 0;
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      fmt::print("  {}:", scenes_[s].name);
      for (std::size_t w = 0; w < kWays.size(); ++w) {
        fmt::print(" {} {} right, {} wrong of {};", kWays[w], series_[s][w].good, series_[s][w].wrong,
                   series_[s][w].looks);
        wrong += w + 1 == kWays.size() ? series_[s][w].wrong : 0;
      }
      fmt::print("\n");
    }
    fmt::print(
        "  ratio beside what was known: median {:.3f}, 84 % {:.3f}, 95 % {:.3f}; over its sigma 84 % "
        "{:.2f}\n",
        Quantile(beside_, 0.5), Quantile(beside_, 0.84), Quantile(beside_, 0.95),
        Quantile(beside_sigma_, 0.84));
    return wrong;
  }

 private:
  static constexpr std::array kWays{"nothing remembered", "edges alone", "greys as well"};

  void One(std::uint64_t seed) {
    std::array<LandmarkMemory, 3> ways{LandmarkMemory({}, false), LandmarkMemory({}, false),
                                       LandmarkMemory()};
    for (int visit = 1; visit <= 2; ++visit) {
      const LandmarkLook look = scenes_[0].take(seed, head_, visit);
      for (std::size_t w = 1; w < ways.size(); ++w) Look(look, ways[w]);
    }
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      const LandmarkLook look = scenes_[s].take(seed, head_, 0);
      for (std::size_t w = 0; w < ways.size(); ++w) {
        LandmarkMemory memory = ways[w];
        const head::LandmarkFix fix = Look(look, memory);
        series_[s][w].Judge(fix, look, seed);
        if (s == 0 && w == 2) Compare(ways[w].greys(), fix);
      }
    }
  }

  head::LandmarkFix Look(const LandmarkLook& look, LandmarkMemory& memory) {
    std::array<head::CameraView, 2> views;
    for (int c = 0; c < 2; ++c) {
      edge_operator_.Extract(look.images[c], edges_[c]);
      views[c] = MakeView(look.calibrated[c], edges_[c]);
    }
    return memory.Find(head::LandmarkFinder(Told(look)), look.model, {look.believed, LookBelief()}, views);
  }

  void Compare(const head::EdgeGreys& known, const head::LandmarkFix& fix) {
    if (fix.verdict != head::Verdict::kFound || known.empty()) return;
    for (const head::EdgeMatch& match : fix.matches) {
      const auto& grey = known[match.edge];
      if (!grey) continue;
      beside_.push_back(std::abs(match.grey_ratio - grey->ratio));
      beside_sigma_.push_back(beside_.back() / grey->sigma);
      if (options_.verbose)
        fmt::print("    edge {} camera {}: {:.2f}, known {:.2f} ({:.2f})\n", match.edge, match.camera,
                   match.grey_ratio, grey->ratio, grey->sigma);
    }
  }

  std::vector<Scene> scenes_;
  VisionOptions options_;
  CalibratedHead head_ = CalibrateSpecimen(1);
  head::EdgeOperator edge_operator_{head::EdgeOptions(head::VisionConfig())};
  std::array<head::EdgeImage, 2> edges_;
  std::vector<std::array<FixSeries, 3>> series_;  // by scene and way
  std::vector<double> beside_, beside_sigma_;
};

template <class Photographer, class Trouble>
Scene SceneOf(Photographer& photographer, Trouble trouble) {
  return {Describe(trouble),
          [&photographer, trouble](std::uint64_t seed, const CalibratedHead& head, int visit) {
            if constexpr (std::is_same_v<Photographer, RoomPhotographer>)
              return photographer.Take(seed % 3 == 0 ? "floor" : "room", seed, trouble, head, visit).look;
            else if constexpr (std::is_same_v<Photographer, DoorPhotographer>)
              return photographer.Take(seed, trouble, head, {}, static_cast<int>((seed + visit) % 3), visit);
            else
              return photographer.Take(seed, trouble, head, visit);
          }};
}

template <class Photographer, class Troubles>
int Remember(const char* what, const Troubles& troubles, const VisionOptions& options) {
  const int n = options.quick ? 12 : 120;
  fmt::print("{} looked at twice before, from other places: {}\n", what, n);
  Photographer photographer;
  std::vector<Scene> scenes;
  for (const auto trouble : troubles) scenes.push_back(SceneOf(photographer, trouble));
  Study study(scenes, options);
  study.Run(n);
  return study.Print();
}

}  // namespace

void BenchGreys(const VisionOptions& options, Figures& figures) {
  using enum RoomTrouble;
  int wrong = Remember<RoomPhotographer>("doors of made-up buildings",
                                         std::array{kNone, kOtherLight, kDoorAbsent, kAnotherDoor}, options);
  wrong +=
      Remember<DoorPhotographer>("doors",
                                 std::array{Trouble::kNone, Trouble::kOtherLight, Trouble::kDoorAbsent,
                                            Trouble::kAnotherDoor, Trouble::kHalfHidden, Trouble::kLightsOut},
                                 options);
  wrong += Remember<CupboardPhotographer>(
      "cupboards",
      std::array{CupboardTrouble::kNone, CupboardTrouble::kOtherLight, CupboardTrouble::kAbsent,
                 CupboardTrouble::kAnother, CupboardTrouble::kHalfHidden, CupboardTrouble::kLightsOut},
      options);
  figures.AtMost("  silent wrong fixes", wrong, 0, "");
}

}  // namespace priamos::bench
