#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <span>

#include "common/time.hpp"

namespace priamos::head {

/// Something to be told, as it is now.
struct Tellable {
  int id = 0;
  Eigen::Vector2d place;  ///< map [m]
  int state = 0;          ///< whatever is news when it changes
  int weight = 0;         ///< of two that are news the heavier one goes first
};

/// How often things are told.
struct TurnOptions {
  double every_s = 5;      ///< between two messages: what the radio carries
  double moved_m = 0.03;   ///< a thing that is farther from where it was told is news
  bool news_only = false;  ///< what is known is not told again
};

/// Which thing is told next: one that is new or has changed, else the one that was told longest ago, so that
/// a message that the radio loses is made up for.
class TurnTaking {
 public:
  explicit TurnTaking(const TurnOptions& options = {}) : options_(options) {}

  /// The number of the one to tell now; nullopt: none, or it is not time yet.
  std::optional<int> Next(std::span<const Tellable> things, Time now);
  /// What was told belongs to things that are forgotten.
  void Forget() { told_.clear(); }

 private:
  struct Told {
    Time at{};
    Eigen::Vector2d place;
    int state = 0;
  };
  bool IsNews(const Tellable& thing) const;

  TurnOptions options_;
  std::map<int, Told> told_;  ///< by the thing's number
  std::optional<Time> last_;
};

}  // namespace priamos::head
