#include "console/console_app.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <utility>
#include <variant>

#include "bus/schema/schema.hpp"
#include "common/config.hpp"
#include "common/data_folders.hpp"
#include "common/ground_plan.hpp"
#include "common/random.hpp"
#include "common/web/token_file.hpp"
#include "console/greeting.hpp"
#include "console/server_options.hpp"

namespace priamos::console {
namespace {

using Json = nlohmann::ordered_json;

int DrawSession(const bus::Context& context) {
  if (context.lockstep()) return static_cast<int>(Rng::Stream(context.seed(), "console session").Below(256));
  return static_cast<int>(std::random_device{}() % 256);
}

std::vector<ShownParameter> ShownParameters(const bus::ParameterSheet& sheet) {
  std::vector<ShownParameter> shown;
  for (std::size_t i = 0; i < sheet.values.size(); ++i)
    shown.push_back({sheet.table.all()[i].name, sheet.values[i]});
  return shown;
}

/// Who may do least of those who have a token: that is enough to look.
const TokenHolder& LeastOf(const std::vector<TokenHolder>& holders) {
  const auto viewer = std::find_if(holders.begin(), holders.end(),
                                   [](const TokenHolder& holder) { return holder.role == Role::kViewer; });
  return viewer == holders.end() ? holders.front() : *viewer;
}

/// What is written down whoever sends it; of the stick it is who holds it, and when.
bool IsOrder(const BrowserMessage& message) {
  if (const auto* wish = std::get_if<ParameterWish>(&message))
    return wish->kind != ParameterWish::Kind::kRead;
  if (const auto* wish = std::get_if<ProcessWish>(&message)) return wish->kind != ProcessWish::Kind::kLog;
  return std::holds_alternative<StopOrder>(message) || std::holds_alternative<MissionOrder>(message) ||
         std::holds_alternative<AlarmSeen>(message) || std::holds_alternative<AimOrder>(message) ||
         std::holds_alternative<PlaceOrder>(message);
}

std::string_view PhaseName(PilotPhase phase) {
  using enum PilotPhase;
  switch (phase) {
    case kNoDevice:
      return "no_device";
    case kIdle:
      return "idle";
    case kMustLetGo:
      return "must_let_go";
    case kAsking:
      return "asking";
    case kDriving:
      return "driving";
  }
  return "idle";
}

}  // namespace

ConsoleApp::ConsoleApp(const ConsoleConfig& config, bus::Context& context)
    : config_(config),
      context_(context),
      link_(LoadConfig<bus::radio::LinkConfig>(context.ResolvePath(config.link))),
      plan_(LoadConfig<GroundPlan>(context.ResolvePath(config.map))),
      greeting_(Greeting(config, plan_, link_)),
      files_(context.node().schema()),
      audit_(config.audit_file.empty() ? "" : context.ResolvePath(config.audit_file)),
      feed_(context.node().schema()),
      bridge_(context.node().schema(), {config.body.length_m, config.body.width_m}, context.instance(),
              [this](ClientId client, std::string message, bool binary) {
                return server_ && server_->Queue(client, std::move(message), binary);
              }),
      seat_(config.pilot, FromSeconds(config.freshness_s)),
      pilot_(config.pilot),
      wanted_(OnRequest(link_)),
      beat_(config.beat_hz),
      processes_(context.node()),
      status_(context.node().Subscribe(channels::kDriveStatus)),
      corrections_(context.node().SubscribeAll(channels::kPoseCorrection)),
      parameter_values_(context.node().SubscribeAll(channels::kParameterValue)),
      drive_(context.node().Advertise(channels::kDriveCommand)),
      head_drive_(context.node().Advertise(channels::kHeadDrive)),
      lease_(context.node().Advertise(channels::kLeaseRequest)),
      estop_(context.node().Advertise(channels::kEstop)),
      mission_(context.node().Advertise(channels::kMissionCommand)),
      head_aim_(context.node().Advertise(channels::kHeadAim)),
      alarm_ack_(context.node().Advertise(channels::kAlarmAck)),
      place_(context.node().Advertise(channels::kPoseReset)),
      parameter_(context.node().Advertise(channels::kParameterOrder)),
      request_(context.node().Advertise(channels::kLinkRequest)) {
  base_.session = head_.session = DrawSession(context);
  places_ =
      256 * base_.session;  // so that a robot does not take the first order for one of an earlier station
  for (const std::string_view channel : kShownChannels) Show(channel);
  if (context.lockstep()) return;
  ServeFoxglove();
  if (!config.video.empty()) OpenVideo();
  server_ = std::make_unique<WebServer>(
      ServerOptionsOf(config, [&](const std::string& file) { return context.ResolvePath(file); }),
      files_.files(), *this);
  if (config.certificate_file.empty() && !IsLoopback(config.address))
    context.Log(bus::Level::kWarning,
                "everybody on the way can read the token; next: certificate_file and key_file, or ssh -L");
  context.SetStatus(fmt::format("the station is at {}", server_->address()));
  context.Log(bus::Level::kInfo, context.status());
}

void ConsoleApp::Show(std::string_view channel) {
  const std::string name(channel);
  context_.node().SubscribeRaw(name, [this, name](std::span<const std::byte> bytes, Time arrival) {
    feed_.Hear(name, bytes, arrival);
    bridge_.Hear(name, bytes, arrival);
  });
}

void ConsoleApp::ServeFoxglove() {
  OfferShownChannels(bridge_);
  bridge_.OfferScene(&plan_, context_.node().Now());
  bridge_.TakeOrders([this](ClientId client, std::string_view text) { return Obey(client, text); });
  bridge_.set_needs(
      [this](ClientId client, const std::string& channel, bool on) { wanted_.Wish(client, channel, on); });
}

/// The robot's name is in the address, so that another robot's camera is not shown as this one's.
void ConsoleApp::OpenVideo() {
  PictureAddress camera = *ReadPictureAddress(config_.video);
  camera.target = "/" + context_.robot() + "/third.jpg";
  if (!config_.video_token_file.empty()) {
    const WebAccess tokens = LoadAccess(config_.address, context_.ResolvePath(config_.video_token_file));
    camera.target += "?token=" + LeastOf(tokens.holders).token;
  }
  video_.emplace(std::move(camera));
  bridge_.OfferVideo();
}

void ConsoleApp::Tick(Time now) {
  now_ = now;
  if (server_) server_->Poll(now);
  if (video_) video_->Tick(*server_, bridge_, now);
  bridge_.Tick(now, now);
  TakeSheets();
  if (const auto status = status_.Take()) robot_ = FromMessage(*status, base_.session);
  Drive(now);
  Place(now);
  if (const auto aim = aiming_.Step(now)) head_aim_.Publish(*aim);
  ChangeParameters(now);
  processes_.Tick(now);
  for (const auto& request : wanted_.Step(now)) request_.Publish(ToMessage(request, now));
  if (beat_.Due(now)) {
    beat_.Mark(now);
    const std::int64_t beat = beats_.Next(now);
    if (server_)
      audience_.Tell(*server_, greeting_, feed_.news(), beat, now,
                     [this](ClientId client, Role role) { return Station(client, role); });
  }
  if (count_.Due(now)) Count(now);
}

void ConsoleApp::Drive(Time now) {
  if (stop_.Step(robot_.estop, now)) estop_.Publish(ToMessage(PilotOutput::Estop::kStop, now));
  Send(pilot_.Step(seat_.Look(now), robot_, now), now);
  NoteDriver(now);
}

void ConsoleApp::NoteDriver(Time now) {
  const auto holder = seat_.holder();
  if (holder == drove_) return;
  if (drove_) audit_.Note(now, *drove_, "drive ends");
  if (holder) audit_.Note(now, *holder, "drive begins");
  drove_ = holder;
}

/// The radio does not repeat what it loses of this: an answer of the robot ends it.
void ConsoleApp::Place(Time now) {
  for (const pose_correction_t& answer : corrections_.Drain()) placing_.Answered(answer.request_id);
  if (const auto order = placing_.Step(now)) place_.Publish(*order);
}

void ConsoleApp::TakeSheets() {
  const auto sheets = parameters_.Take();
  if (!sheets) return;
  files_.AddParameters(*sheets);
  for (const auto& [process, sheet] : *sheets)
    if (sheet.live) {
      parameter_orders_.Know(process, sheet.live->table);
      bridge_.KnowParameters(process, ShownParameters(*sheet.live));
    }
}

/// The pages see the answers as messages of their channel.
void ConsoleApp::ChangeParameters(Time now) {
  for (const parameter_value_t& answer : parameter_values_.Drain()) {
    parameter_orders_.Answered(answer);
    if (answer.outcome == parameter_value_t::OTHER_TABLE) continue;  // its numbers mean other keys
    const bool done = answer.outcome == parameter_value_t::DONE;
    bridge_.HearParameter(std::string(bus::ProcessOfParameters(answer.process)), answer.key, answer.value,
                          answer.next_changed, done ? "" : bus::OutcomeText(answer.outcome));
  }
  if (const auto order = parameter_orders_.Step(now)) parameter_.Publish(*order);
}

void ConsoleApp::Send(const PilotOutput& output, Time now) {
  const auto next = [](Sender& sender) -> const Sender& {
    sender.sequence = (sender.sequence + 1) & 0xffff;
    return sender;
  };
  const double time_to_live_s = config_.pilot.time_to_live_s;
  // A stop goes first, and a lease is asked for before it is used.
  if (output.estop) {
    stop_.Forget();
    estop_.Publish(ToMessage(*output.estop, now));
  }
  if (output.lease) lease_.Publish(ToMessage(*output.lease, base_, now));
  if (output.drive) drive_.Publish(ToMessage(*output.drive, next(base_), time_to_live_s, now));
  if (output.head) head_drive_.Publish(ToMessage(*output.head, next(head_), time_to_live_s, now));
}

void ConsoleApp::Joined(std::uint64_t client, const OpenSocket& socket) {
  audit_.Note(now_, client, "joined",
              {{"role", socket.role == Role::kDriver ? "driver" : "viewer"},
               {"who", socket.who},
               {"from", socket.from},
               {"foxglove", socket.dialect == Dialect::kFoxglove}});
  names_[client] = socket.who.empty() ? socket.from : socket.who;
  parameters_.Ask(ThisProgram().program_folder, context_.ResolvePath("."));
  if (socket.dialect == Dialect::kFoxglove) return bridge_.Join(client, socket.role);
  audience_.Join(client, socket.role);
  if (socket.role == Role::kDriver) seat_.Join(client);
}

void ConsoleApp::Left(std::uint64_t client) {
  audit_.Note(now_, client, "left");
  names_.erase(client);
  if (bridge_.Has(client)) bridge_.Leave(client);
  audience_.Leave(client);
  seat_.Leave(client);
  wanted_.Leave(client);
  if (video_) video_->Leave(client);
}

Role ConsoleApp::RoleOf(ClientId client) const {
  return bridge_.Has(client) ? bridge_.RoleOf(client) : audience_.RoleOf(client);
}

bool ConsoleApp::Said(std::uint64_t client, std::string_view message, bool binary) {
  const auto refusal = bridge_.Has(client) ? bridge_.Said(client, message, binary)
                       : binary            ? Refusal{"expected text"}
                                           : Obey(client, message);
  if (refusal) {
    audit_.Note(now_, client, "cut off", {{"reason", refusal->reason}});
    context_.Log(bus::Level::kWarning, fmt::format("a page was cut off: {}", refusal->reason));
  }
  return !refusal;
}

std::optional<Refusal> ConsoleApp::Obey(ClientId client, std::string_view page_message) {
  const auto message = ReadBrowserMessage(page_message);
  if (!message) return Refusal{message.reason()};
  const bool done = std::visit([&](const auto& m) { return Take(client, m); }, *message);
  if (IsOrder(*message))
    audit_.Note(now_, client, done ? "ordered" : "may not order", {{"message", Json::parse(page_message)}});
  if (done) return std::nullopt;
  return Refusal{"expected somebody who may drive, and an order for a robot"};
}

/// A viewer's hand is on nothing: his reports are refused, which ends his connection.
bool ConsoleApp::Take(std::uint64_t client, const StickReport& report) {
  if (RoleOf(client) != Role::kDriver) return false;
  if (!seat_.Take(client, report, beats_.AgeOf(report.beat, now_), now_)) ++late_;
  return true;
}

/// Anybody may stop the robot, who only looks on too.
bool ConsoleApp::Take(std::uint64_t, const StopOrder&) {
  seat_.End();
  stop_.Order();
  return true;
}

bool ConsoleApp::Take(std::uint64_t client, const MissionOrder& order) {
  if (RoleOf(client) != Role::kDriver) return false;
  mission_.Publish(ToMessage(order, now_));
  return true;
}

bool ConsoleApp::Take(std::uint64_t client, const PlaceOrder& order) {
  if (RoleOf(client) != Role::kDriver) return false;
  places_ = places_ % 65535 + 1;
  placing_.Give(ToMessage(order, places_, {config_.place_sigma_m, config_.place_sigma_deg}, now_), now_);
  return true;
}

bool ConsoleApp::Take(std::uint64_t client, const AimOrder& order) {
  if (RoleOf(client) != Role::kDriver) return false;
  aiming_.Give(ToMessage(order, now_));
  return true;
}

/// Every station, and every page of it, is told who it was.
bool ConsoleApp::Take(std::uint64_t client, const AlarmSeen& seen) {
  if (RoleOf(client) != Role::kDriver) return false;
  alarm_ack_.Publish(ToMessage(seen, names_[client], now_));
  return true;
}

bool ConsoleApp::Take(std::uint64_t client, const ParameterWish& wish) {
  return RoleOf(client) == Role::kDriver && parameter_orders_.Wish(wish);
}

/// After a new world nothing goes on that a hand held before.
bool ConsoleApp::Take(std::uint64_t client, const ProcessWish& wish) {
  if (RoleOf(client) != Role::kDriver) return false;
  if (processes_.Wish(wish) && wish.kind == ProcessWish::Kind::kNewWorld) seat_.End();
  return true;
}

bool ConsoleApp::Take(std::uint64_t client, const ListenWish& wish) {
  if (video_ && wish.channel == VideoFeed::kChannel) {
    video_->Wish(client, wish.on);
    return true;
  }
  return wanted_.Wish(client, wish.channel, wish.on);
}

Json ConsoleApp::Station(std::uint64_t client, Role role) const {
  const auto holder = seat_.holder();
  const WebCounters& refused = server_->counters();
  return {{"role", role == Role::kDriver ? "driver" : "viewer"},
          {"seat", !holder             ? "free"
                   : *holder == client ? "yours"
                                       : "other"},
          {"session", base_.session},
          {"phase", PhaseName(pilot_.phase())},
          {"mode", pilot_.mode() == PilotMode::kBase ? "base" : "head"},
          {"fast", pilot_.fast()},
          {"pages", audience_.size() + bridge_.clients()},
          {"refused", refused.requests + refused.messages + refused.crowded + refused.slow},
          {"no_video", video_ ? video_->problem() : ""},
          {"late", late_}};
}

/// Who is refused is counted in the log, once a second at most.
void ConsoleApp::Count(Time now) {
  count_.Mark(now);
  if (!server_) return;
  const WebCounters& c = server_->counters();
  const std::uint64_t all = c.requests + c.messages + c.crowded + c.slow;
  if (all != counted_) audit_.Note(now, 0, "refused", {{"requests_and_pages", all}});
  if (all != counted_)
    context_.Log(
        bus::Level::kWarning,
        fmt::format("refused so far: {} requests, {} pages for what they sent, {} of too many, {} too slow",
                    c.requests, c.messages, c.crowded, c.slow));
  counted_ = all;
}

}  // namespace priamos::console
