#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bus/bus_choice.hpp"

namespace priamos::cli {

/// What was heard on one bus while an e-stop waited for its answer.
struct EstopEar {
  std::string name;                ///< the bus as a person types it behind --bus
  std::set<std::string> channels;  ///< without the e-stop's own
};

/// Why an e-stop may have got no answer, as the end of a sentence: what `here` carries, and whether the
/// robot's other bus carries more.
std::string WhyNoAnswer(const EstopEar& here, const std::optional<EstopEar>& other);

/// Listens to the bus of an e-stop and to the other one of the same robot.
class EstopSilence {
 public:
  /// A bus that cannot be opened is left out: nothing may end an e-stop but its answer.
  explicit EstopSilence(const bus::BusChoice& choice);
  ~EstopSilence();

  /// Takes what has come; to be called often.
  void Drain();
  std::string Why() const;

 private:
  struct Side;
  std::vector<std::unique_ptr<Side>> sides_;
};

}  // namespace priamos::cli
