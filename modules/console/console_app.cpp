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
      base_{DrawSession(context)},
      head_(base_),
      beat_(config.beat_hz),
      orders_(context.node(), bridge_, base_.session, {config.place_sigma_m, config.place_sigma_deg}),
      status_(context.node().Subscribe(channels::kDriveStatus)),
      drive_(context.node().Advertise(channels::kDriveCommand)),
      head_drive_(context.node().Advertise(channels::kHeadDrive)),
      lease_(context.node().Advertise(channels::kLeaseRequest)),
      estop_(context.node().Advertise(channels::kEstop)),
      request_(context.node().Advertise(channels::kLinkRequest)) {
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

void ConsoleApp::OpenVideo() {
  std::vector<TokenHolder> holders;
  if (!config_.video_token_file.empty())
    holders = LoadAccess(config_.address, context_.ResolvePath(config_.video_token_file)).holders;
  video_.emplace(CameraOf(*ReadPictureAddress(config_.video), context_.robot(), holders));
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
  orders_.Tick(now);
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

void ConsoleApp::TakeSheets() {
  const auto sheets = parameters_.Take();
  if (!sheets) return;
  files_.AddParameters(*sheets);
  for (const auto& [process, sheet] : *sheets)
    if (sheet.live) {
      orders_.Know(process, sheet.live->table);
      bridge_.KnowParameters(process, ShownParameters(*sheet.live));
    }
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

/// A viewer's hand is on nothing: his reports are refused, which ends his connection.
std::optional<Refusal> ConsoleApp::Obey(ClientId client, std::string_view page_message) {
  const auto message = ReadBrowserMessage(page_message);
  if (!message) return Refusal{message.reason()};
  const bool may = !NeedsDriver(*message) || RoleOf(client) == Role::kDriver;
  const bool done = may && std::visit([&](const auto& m) { return Take(client, m); }, *message);
  if (IsOrder(*message))
    audit_.Note(now_, client, done ? "ordered" : "may not order", {{"message", Json::parse(page_message)}});
  if (done) return std::nullopt;
  return Refusal{"expected somebody who may drive, and an order for a robot"};
}

bool ConsoleApp::Take(std::uint64_t client, const StickReport& report) {
  if (!seat_.Take(client, report, beats_.AgeOf(report.beat, now_), now_)) ++late_;
  return true;
}

/// Anybody may stop the robot, who only looks on too.
bool ConsoleApp::Take(std::uint64_t, const StopOrder&) {
  seat_.End();
  stop_.Order();
  return true;
}

/// After a new world nothing goes on that a hand held before.
bool ConsoleApp::Take(std::uint64_t, const ProcessWish& wish) {
  if (orders_.Take(wish) && wish.kind == ProcessWish::Kind::kNewWorld) seat_.End();
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

/// What could not be written down is no secret: it is in the log, and in HEALTH, which every page shows.
void ConsoleApp::NoteAudit() {
  if (audit_.failed() == unwritten_) return;
  unwritten_ = audit_.failed();
  const std::string problem =
      fmt::format("audit_file {} cannot be written: {} acts are missing", config_.audit_file, unwritten_);
  context_.Log(bus::Level::kError, problem + "; next: make room for it");
  context_.SetHealth(bus::Health::kDegraded, problem);
}

/// Who is refused is counted in the log, once a second at most.
void ConsoleApp::Count(Time now) {
  count_.Mark(now);
  NoteAudit();
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
