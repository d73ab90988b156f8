#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/geometry.hpp"
#include "common/ground_plan.hpp"
#include "common/robot/body_size.hpp"
#include "common/time.hpp"

namespace priamos::console {

/// What the 3-D and image panels of Foxglove and Lichtblick draw of the robot: its messages, translated into
/// their schemas. Frames `map` and `base`. Pure. A message that is not as PRIAMOS writes it (a foreign bus
/// may have channels of these names) gives nothing.
class Scene {
 public:
  using Json = nlohmann::ordered_json;

  /// A stream of such messages.
  struct Topic {
    std::string_view name, schema;
    std::vector<std::string> sources;  ///< channels of the bus that it is made of
  };
  /// One of them.
  struct Message {
    std::string_view topic;
    Time time;  ///< the moment it speaks of
    Json json;
  };

  static constexpr std::string_view kTransform = "/tf", kPlan = "/scene/plan", kRobot = "/scene/robot",
                                    kPath = "/scene/path", kEchoes = "/sonars", kLandmarks = "/scene/edges",
                                    kView = "/edges", kObstacles = "/scene/obstacles";

  explicit Scene(const BodySize& body) : body_(body) {}

  static std::vector<Topic> Topics();
  /// The schema of one of these topics.
  static std::string_view SchemaOf(std::string_view topic);
  /// What a message of `channel` looks like.
  std::vector<Message> Hear(std::string_view channel, const Json& message, Time arrival);
  /// Walls, doors and cupboards; they stand still.
  static Message Plan(const GroundPlan& plan, Time now);
  /// A picture of the third camera.
  static Json Picture(std::string_view jpeg, Time exposed);

 private:
  std::vector<Message> Pose(const Json& message, Time valid) const;
  std::vector<Message> Path(const Json& message, Time valid) const;
  std::vector<Message> Sonars(const Json& message, Time valid) const;
  std::vector<Message> Model(const Json& message, Time valid);
  std::vector<Message> Fix(const Json& message, Time valid) const;
  std::vector<Message> View(const Json& message, Time valid) const;
  std::vector<Message> Obstacles(const Json& message, Time valid) const;

  BodySize body_;
  std::map<int, Json> models_;  ///< landmark_model_t, by the landmark's number
};

}  // namespace priamos::console
