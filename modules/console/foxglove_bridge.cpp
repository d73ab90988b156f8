#include "console/foxglove_bridge.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "bus/schema/json.hpp"
#include "bus/schema/json_schema.hpp"
#include "bus/schema/schema.hpp"
#include "console/core/json_line.hpp"
#include "console/foxglove/scene_schemas.hpp"
#include "console/foxglove/services.hpp"
#include "console/greeting.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::console {
namespace {

using Json = nlohmann::ordered_json;

/// State that later messages refer to: the scene hears of it though nobody looks.
constexpr std::string_view kRemembered = "LANDMARK_MODEL";

std::string SchemaOf(const bus::Struct& type) {
  try {
    return bus::JsonSchemaOf(type).dump();
  } catch (const bus::SchemaError&) {  // it contains itself: any object
    return Json{{"title", type.full_name}, {"type", "object"}}.dump();
  }
}

}  // namespace

FoxgloveBridge::FoxgloveBridge(const bus::Schema& schema, const BodySize& body, std::string session,
                               Desk::Sink sink)
    : schema_(schema), desk_("PRIAMOS", std::move(session), std::move(sink)), scene_(body) {
  desk_.set_watcher([this](ClientId client, std::uint32_t id, bool on) { OnWish(client, id, on); });
}

void FoxgloveBridge::OfferParameters(const Orders& orders) {
  board_.emplace(ParameterBoard::Port{
      [this](ClientId client, std::span<const ShownParameter> values, std::string_view id) {
        desk_.SendParameters(client, values, id);
      },
      [this](ClientId client, const std::string& sentence) { desk_.Warn(client, sentence); }, orders});
  desk_.set_parameters([this](ClientId client, const Desk::ParameterRequest& request) {
    std::visit([&](const auto& r) { board_->Take(client, r); }, request);
  });
}

void FoxgloveBridge::KnowParameters(const std::string& process, std::span<const ShownParameter> parameters) {
  if (board_) board_->Know(process, parameters);
}

void FoxgloveBridge::HearParameter(const std::string& process, int key, double value, int next_changed,
                                   std::string_view problem) {
  if (board_) board_->Heard(process, key, value, next_changed, problem);
}

void FoxgloveBridge::TakeOrders(Orders orders) {
  OfferParameters(orders);
  desk_.set_services(Services(),
                     [orders = std::move(orders)](ClientId client, std::uint32_t service,
                                                  std::string_view json) -> std::optional<Refusal> {
                       const auto message = PageMessageOf(service, json);
                       if (!message) return Refusal{message.reason()};
                       return orders(client, *message);
                     });
}

void FoxgloveBridge::Offer(const std::string& channel, std::string_view type) {
  if (const bus::Struct* known = schema_.Find(type)) StreamOf(channel, *known);
}

void FoxgloveBridge::OfferScene(const GroundPlan* plan, Time now) {
  for (const Scene::Topic& topic : Scene::Topics()) {
    const std::uint32_t id =
        desk_.Offer({std::string(topic.name), std::string(topic.schema), SceneSchema(topic.schema)});
    topics_[topic.name] = id;
    sources_[id] = topic.sources;
  }
  if (plan != nullptr) plan_ = Scene::Plan(*plan, now);
}

void FoxgloveBridge::OfferVideo() {
  video_ = desk_.Offer({"/third", std::string(kCompressedImage), SceneSchema(kCompressedImage)});
  sources_[*video_] = {};
}

void FoxgloveBridge::ShowVideo(std::string_view jpeg, Time exposed) {
  if (IsVideoWanted()) desk_.Publish(*video_, exposed, JsonLine(Scene::Picture(jpeg, exposed)));
}

const FoxgloveBridge::Stream* FoxgloveBridge::StreamOf(const std::string& channel, const bus::Struct& type) {
  auto& streams = streams_[channel];
  const auto known =
      std::find_if(streams.begin(), streams.end(), [&](const Stream& s) { return s.type == &type; });
  if (known != streams.end()) return &*known;
  if (sources_.size() >= kMostChannels) return nullptr;
  const std::uint32_t id = desk_.Offer({channel, type.full_name, SchemaOf(type)});
  sources_[id] = {channel};
  return &streams.emplace_back(Stream{&type, id});
}

bool FoxgloveBridge::IsSceneWanted(const std::string& channel) const {
  return std::any_of(topics_.begin(), topics_.end(), [&](const auto& topic) {
    const auto& sources = sources_.at(topic.second);
    return std::find(sources.begin(), sources.end(), channel) != sources.end() &&
           desk_.IsWanted(topic.second);
  });
}

std::vector<Scene::Message> FoxgloveBridge::SceneOf(const std::string& channel, const Newest& message) {
  const Json json = bus::ToJson(*message.type, message.bytes);
  return scene_.Hear(channel, json, message.arrival);
}

void FoxgloveBridge::Hear(const std::string& channel, std::span<const std::byte> bytes, Time arrival) {
  const bus::Struct* type = schema_.Of(bytes);
  const Stream* stream = type == nullptr ? nullptr : StreamOf(channel, *type);
  if (stream == nullptr) return;
  Newest& newest = newest_[channel];
  newest = {type, {bytes.begin(), bytes.end()}, arrival};
  if (desk_.IsWanted(stream->id)) desk_.Publish(stream->id, arrival, JsonLine(bus::ToJson(*type, bytes)));
  if (topics_.empty() || (channel != kRemembered && !IsSceneWanted(channel))) return;
  for (const Scene::Message& message : SceneOf(channel, newest))
    desk_.Publish(topics_.at(message.topic), arrival, JsonLine(message.json));
}

void FoxgloveBridge::Tick(Time now, Time shown) {
  if (board_) board_->Step(now);
  if (!clock_.Due(now)) return;
  clock_.Mark(now);
  desk_.TellTime(shown);
}

void FoxgloveBridge::Join(ClientId client, Role role) {
  roles_[client] = role;
  desk_.Join(client);
}

void FoxgloveBridge::Leave(ClientId client) {
  desk_.Leave(client);
  if (board_) board_->Leave(client);
  needed_.erase(client);
  roles_.erase(client);
}

Role FoxgloveBridge::RoleOf(ClientId client) const {
  const auto role = roles_.find(client);
  return role == roles_.end() ? Role::kViewer : role->second;
}

std::optional<Refusal> FoxgloveBridge::Said(ClientId client, std::string_view message, bool binary) {
  return desk_.Take(client, message, binary);
}

void FoxgloveBridge::OnWish(ClientId client, std::uint32_t id, bool on) {
  for (const std::string& channel : sources_.at(id)) {
    int& count = needed_[client][channel];
    const bool before = count > 0;
    count += on ? 1 : -1;
    if (needs_ && before != (count > 0)) needs_(client, channel, count > 0);
  }
  if (on) ShowNewest(client, id);
}

void FoxgloveBridge::ShowNewest(ClientId client, std::uint32_t id) {
  if (id == video_) return;
  if (plan_ && topics_.at(Scene::kPlan) == id)
    return desk_.Publish(client, id, plan_->time, JsonLine(plan_->json));
  const bool scene =
      std::any_of(topics_.begin(), topics_.end(), [&](const auto& t) { return t.second == id; });
  for (const std::string& channel : sources_.at(id)) {
    const auto newest = newest_.find(channel);
    if (newest == newest_.end()) continue;
    const Newest& known = newest->second;
    if (!scene) {
      const Stream* stream = StreamOf(channel, *known.type);
      if (stream != nullptr && stream->id == id)
        desk_.Publish(client, id, known.arrival, JsonLine(bus::ToJson(*known.type, known.bytes)));
      continue;
    }
    for (const Scene::Message& message : SceneOf(channel, known))
      if (topics_.at(message.topic) == id) desk_.Publish(client, id, known.arrival, JsonLine(message.json));
  }
}

void OfferShownChannels(FoxgloveBridge& bridge) {
  std::map<std::string_view, std::string> types;
  std::apply(
      [&](const auto&... channel) {
        const auto add = [&]<class T>(const Channel<T>& c) { types[c.name] = T::getTypeName(); };
        (add(channel), ...);
      },
      channels::kAll);
  for (const std::string_view channel : kShownChannels) bridge.Offer(std::string(channel), types.at(channel));
}

}  // namespace priamos::console
