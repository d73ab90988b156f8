#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/ground_plan.hpp"
#include "common/rate_limit.hpp"
#include "common/robot/body_size.hpp"
#include "common/time.hpp"
#include "common/web/web_request.hpp"
#include "console/core/seat.hpp"
#include "console/foxglove/desk.hpp"
#include "console/foxglove/parameter_board.hpp"
#include "console/foxglove/scene.hpp"

namespace priamos::bus {
class Schema;
struct Struct;
}  // namespace priamos::bus

namespace priamos::console {

/// Messages of a bus or a log for Foxglove clients: every channel as JSON, and the robot as their panels draw
/// it. Only what somebody has subscribed to is decoded; who subscribes gets the newest message at once.
class FoxgloveBridge {
 public:
  /// Most channels, whatever is on the bus; later ones are not offered.
  static constexpr std::size_t kMostChannels = 1000;

  /// Does what a page's message asks for; returns why not.
  using Orders = std::function<std::optional<Refusal>(ClientId, std::string_view page_message)>;
  /// A client now needs a channel of the bus, or does not any more.
  using Needs = std::function<void(ClientId, const std::string& channel, bool on)>;

  /// `schema` must outlive it.
  FoxgloveBridge(const bus::Schema& schema, const BodySize& body, std::string session, Desk::Sink sink);

  /// Offers services and parameters; without this there are none.
  void TakeOrders(Orders orders);
  /// The parameters of a process that may be changed while it runs, by their numbers, with the values of its
  /// file.
  void KnowParameters(const std::string& process, std::span<const ShownParameter> parameters);
  /// What a process has answered of them (ParameterBoard::Heard).
  void HearParameter(const std::string& process, int key, double value, int next_changed,
                     std::string_view problem);
  void set_needs(Needs needs) { needs_ = std::move(needs); }
  /// Offers a channel of a type of this name before anything was heard on it.
  void Offer(const std::string& channel, std::string_view type);
  /// Offers the robot in the schemas of the panels. `plan`: what stands around it; null when nobody knows.
  void OfferScene(const GroundPlan* plan, Time now);
  /// Offers the pictures of the third camera.
  void OfferVideo();
  bool IsVideoWanted() const { return video_ && desk_.IsWanted(*video_); }
  void ShowVideo(std::string_view jpeg, Time exposed);
  void Hear(const std::string& channel, std::span<const std::byte> bytes, Time arrival);
  /// Forgets what was heard.
  void Forget() { newest_.clear(); }
  /// Tells everybody the time `shown`, ten times a second, and who has waited long enough that nobody
  /// answered.
  void Tick(Time now, Time shown);

  void Join(ClientId client, Role role);
  void Leave(ClientId client);
  bool Has(ClientId client) const { return roles_.contains(client); }
  /// Role of a client; that of a viewer when it is not there.
  Role RoleOf(ClientId client) const;
  /// What a client said; the reason when it must be cut off.
  std::optional<Refusal> Said(ClientId client, std::string_view message, bool binary);

  std::size_t clients() const { return roles_.size(); }
  std::uint64_t dropped() const { return desk_.dropped(); }

 private:
  /// A channel of the bus with one type.
  struct Stream {
    const bus::Struct* type = nullptr;
    std::uint32_t id = 0;  ///< at the desk
  };
  struct Newest {
    const bus::Struct* type = nullptr;
    std::vector<std::byte> bytes;
    Time arrival{};
  };

  void OfferParameters(const Orders& orders);
  const Stream* StreamOf(const std::string& channel, const bus::Struct& type);
  bool IsSceneWanted(const std::string& channel) const;
  std::vector<Scene::Message> SceneOf(const std::string& channel, const Newest& message);
  void OnWish(ClientId client, std::uint32_t id, bool on);
  void ShowNewest(ClientId client, std::uint32_t id);

  const bus::Schema& schema_;
  Desk desk_;
  Scene scene_;
  std::optional<ParameterBoard> board_;  ///< none: parameters are not offered
  Needs needs_;
  RateLimit clock_{10};
  std::map<std::string, std::vector<Stream>> streams_;         ///< by channel
  std::map<std::string_view, std::uint32_t> topics_;           ///< of the scene
  std::map<std::uint32_t, std::vector<std::string>> sources_;  ///< channels that one at the desk is made of
  std::map<std::string, Newest> newest_;
  std::optional<Scene::Message> plan_;
  std::optional<std::uint32_t> video_;  ///< at the desk
  std::map<ClientId, Role> roles_;
  std::map<ClientId, std::map<std::string, int>> needed_;  ///< channels of the bus, by how many subscriptions
};

/// Offers the channels that the station shows (greeting.hpp) with the types that PRIAMOS has for them: some
/// are heard only when somebody wants them.
void OfferShownChannels(FoxgloveBridge& bridge);

}  // namespace priamos::console
