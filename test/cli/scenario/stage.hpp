#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bus/own_types.hpp"
#include "cli/scenario/scenario.hpp"
#include "cli/scenario/scenario_story.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {

/// The cable of a mouse that is switched off.
class DeadCable : public ByteStream {
 public:
  std::size_t Read(std::span<std::byte>) override { return 0; }
  std::size_t Write(std::span<const std::byte> bytes) override { return bytes.size(); }
};

/// A story on two buses of its own, and its counterparts played by hand.
struct Stage {
  explicit Stage(Scenario of) : scenario(std::move(of)) {
    story = FindStory(scenario.story)
                .make({scenario, 1, onboard_node, offboard_node,
                       [this] {
                         ++mice;
                         return std::make_unique<DeadCable>();
                       },
                       [this](Time, const std::string& text) { told.push_back(text); }});
  }

  /// The story, ten times a second, for so long.
  void Run(double seconds) {
    for (const Time end = clock.Now() + FromSeconds(seconds); clock.Now() < end;) {
      clock.Set(clock.Now() + FromSeconds(0.1));
      onboard.Drain();
      offboard.Drain();
      story->Tick(clock.Now());
      onboard.Drain();
      offboard.Drain();
    }
  }
  /// A sign of life of every process of the scenario; of all but one when `but` names it.
  void Live(const std::string& but = "") {
    for (const auto& process : scenario.processes) {
      if (process.module == but || process.module == "spacenavd") continue;
      health_t message{};
      message.process = process.module;
      (process.bus == "onboard" ? onboard_health : offboard_health).Publish(message);
    }
  }
  bool Done() const { return story->Done(clock.Now()); }

  Scenario scenario;
  int mice = 0;  ///< opened
  std::vector<std::string> told;
  bus::Schema schema = bus::OwnTypes();
  bus::SimulatedClock clock{FromUtime(1'000'000'000)};
  bus::LcmBus onboard{"memq://"}, offboard{"memq://"};
  bus::Node onboard_node{onboard, schema, clock}, offboard_node{offboard, schema, clock};
  bus::Node onboard_other{onboard, schema, clock}, offboard_other{offboard, schema, clock};
  bus::Publisher<health_t> onboard_health = onboard_other.Advertise(channels::kHealth);
  bus::Publisher<health_t> offboard_health = offboard_other.Advertise(channels::kHealth);
  std::unique_ptr<ScenarioStory> story;
};

}  // namespace priamos::cli
