#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/options/bus_options.hpp"
#include "cli/terminal/silence_text.hpp"
#include "common/time.hpp"

namespace priamos::cli {

/// Names of PRIAMOS's channels; `events`: only those without a rate.
std::vector<std::string> ChannelNames(bool events);

/// Tells a person who waits in vain why: listens to both buses of the robot until something came or its
/// patience is over, then writes one sentence to standard error, once.
class SilenceWatch {
 public:
  /// `who` is the verb, "priamos topic echo". `channel`: what is waited for; empty: anything.
  SilenceWatch(std::string who, const BusOptions& options, std::string channel, Time now,
               Duration patience = std::chrono::seconds(1));
  ~SilenceWatch();
  SilenceWatch(const SilenceWatch&) = delete;
  SilenceWatch& operator=(const SilenceWatch&) = delete;

  /// Something came: there is nothing to tell.
  void Heard();
  /// To be called often.
  void Step(Time now);
  /// Tells it now when nothing came.
  void Tell(Time now);

 private:
  struct Ear;
  std::string who_, channel_;
  std::unique_ptr<bus::Schema> schema_;
  std::unique_ptr<Ear> here_, other_;  ///< none when there is nothing to tell any more
  Time until_;
};

}  // namespace priamos::cli
