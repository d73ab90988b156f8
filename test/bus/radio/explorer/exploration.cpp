#include "test/bus/radio/explorer/exploration.hpp"

#include <fmt/format.h>

#include <array>
#include <span>

namespace priamos::bus::radio {
namespace {

constexpr std::size_t kMostFindings = 100;
constexpr std::array kNames{"lost",       "twice",           "late",    "very late", "killed",   "stopped",
                            "power lost", "power lost late", "emptied", "put back",  "disk full"};

std::span<const Accident> AccidentsAt(PlaceKind kind) {
  return kind == PlaceKind::kFrame ? std::span<const Accident>(kFrameAccidents)
                                   : std::span<const Accident>(kEndAccidents);
}

/// A search in depth: behind the accidents so far, each at each later place.
class Search {
 public:
  Search(ExploredWorld world, std::size_t part, std::size_t parts)
      : world_(world), part_(part), parts_(parts) {}

  void Try(const std::vector<Mishap>& mishaps, int more) {
    ExploredRun run(world_, mishaps);
    const auto broken = run.Run();
    ++result_.runs;
    for (const std::string& sentence : broken)
      if (result_.findings.size() < kMostFindings)
        result_.findings.push_back(TextOf(mishaps) + ": " + sentence);
    // What breaks a promise already is a finding of its own; what follows from it is none.
    if (more > 0 && broken.empty()) TryMore(mishaps, run.places(), more);
  }
  Explored& result() { return result_; }

 private:
  void TryMore(const std::vector<Mishap>& mishaps, const std::vector<PlaceKind>& places, int more) {
    for (std::size_t i = mishaps.empty() ? 0 : mishaps.back().place + 1; i < places.size(); ++i) {
      if (mishaps.empty() && i % parts_ != part_) continue;
      for (const Accident accident : AccidentsAt(places[i])) {
        std::vector<Mishap> next = mishaps;
        next.push_back({.place = i, .accident = accident});
        Try(next, more - 1);
      }
    }
  }

  ExploredWorld world_;
  std::size_t part_, parts_;
  Explored result_;
};

}  // namespace

Explored Explore(const ExploredWorld& world, int depth, std::size_t part, std::size_t parts) {
  Search search(world, part, parts);
  search.Try({}, depth);
  return std::move(search.result());
}

std::vector<Mishap> RandomMishaps(const ExploredWorld& world, std::size_t accidents, std::uint64_t seed) {
  Rng rng = Rng::Stream(seed, "mishaps");
  std::vector<Mishap> mishaps;
  for (std::size_t place = 0; mishaps.size() < accidents; ++place) {
    ExploredRun run(world, mishaps);
    run.Run();
    const std::size_t left = run.places().size() - std::min(place, run.places().size());
    if (left == 0) break;
    place += rng.Below((left + accidents - mishaps.size() - 1) / (accidents - mishaps.size()));
    const auto kinds = AccidentsAt(run.places()[place]);
    mishaps.push_back({.place = place, .accident = kinds[rng.Below(kinds.size())]});
  }
  return mishaps;
}

std::string TextOf(const std::vector<Mishap>& mishaps) {
  std::string text;
  for (const Mishap& m : mishaps)
    text += fmt::format("{}{} at place {}", text.empty() ? "" : ", ",
                        kNames[static_cast<std::size_t>(m.accident)], m.place);
  return text.empty() ? "no accident" : text;
}

}  // namespace priamos::bus::radio
