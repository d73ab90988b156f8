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

/// Explains to a person why nothing arrives: listens to both buses of the robot until something came or its
/// patience is over, then writes one sentence to standard error, once.
class SilenceWatch {
 public:
  /// Watch for the verb `who`, e.g. "priamos topic echo". `channel`: what is waited for; empty: anything.
  SilenceWatch(std::string who, const BusOptions& options, std::string channel, Time now,
               Duration patience = std::chrono::seconds(1));
  ~SilenceWatch();
  SilenceWatch(const SilenceWatch&) = delete;
  SilenceWatch& operator=(const SilenceWatch&) = delete;

  /// Notes that a message came, so that there is no silence to explain.
  void Heard();
  /// Listens, and writes the sentence when the patience is over. Call it often.
  void Step(Time now);
  /// Writes the sentence now if nothing came.
  void Explain(Time now);

 private:
  struct Ear;
  std::string who_, channel_;
  std::unique_ptr<bus::Schema> schema_;
  std::unique_ptr<Ear> here_, other_;  ///< none when there is nothing left to explain
  Time until_;
};

}  // namespace priamos::cli
