#include <fcntl.h>
#include <fmt/format.h>
#include <pty.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "test/bench/driving/driving_studies.hpp"

namespace priamos::bench {
namespace {

using std::chrono::milliseconds;

/// Two channels of a bus may be read in another order than they were written.
constexpr Duration kOrder{3'000};
constexpr double kOnboard_ms = 100, kThroughRadio_ms = 150;

/// A program on a terminal of its own, with the keys of this process.
class Terminal {
 public:
  explicit Terminal(const std::vector<std::string>& arguments) {
    std::vector<char*> argv;
    for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
    argv.push_back(nullptr);
    // A terminal is a session, and gets a scheduling group, of its own: with the priority of this one.
    std::string of_parent;
    std::getline(std::ifstream("/proc/self/autogroup"), of_parent);
    pid_ = forkpty(&master_, nullptr, nullptr, nullptr);
    if (pid_ < 0) throw std::runtime_error("no terminal");
    if (pid_ == 0) {
      if (const auto at = of_parent.find("nice "); at != std::string::npos)
        std::ofstream("/proc/self/autogroup") << of_parent.substr(at + 5);
      sigset_t none;
      sigemptyset(&none);
      sigprocmask(SIG_SETMASK, &none, nullptr);
      execv(argv[0], argv.data());
      _exit(127);
    }
    fcntl(master_, F_SETFL, O_NONBLOCK);
  }
  ~Terminal() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
    close(master_);
  }
  void Type(char key) {
    if (write(master_, &key, 1) != 1) throw std::runtime_error("the terminal is gone");
  }
  /// What is not read would block the program.
  void Read() {
    char waste[4096];
    while (read(master_, waste, sizeof waste) > 0) continue;
  }

 private:
  pid_t pid_ = 0;
  int master_ = -1;
};

enum class Source { kMouse, kKeyboard, kCommand, kBus };

const char* Text(Source source) {
  switch (source) {
    case Source::kMouse:
      return "space-mouse button";
    case Source::kKeyboard:
      return "keyboard, SPACE";
    case Source::kCommand:
      return "priamos estop (with its start)";
    case Source::kBus:
      return "message on the operator's bus";
  }
  return "";
}

struct Outcome {
  Sample whole, onboard;
  int lost = 0, moved_after = 0, no_drive = 0;
};

class EstopStudy {
 public:
  explicit EstopStudy(const RigOptions& options)
      : options_(options),
        rig_(options),
        keyboard_({options.program_folder + "/priamos-teleop", "--config",
                   options.source_folder + "/config/sim/teleop.toml", "--bus", "offboard", "--keyboard"}) {
    rig_.Start();
    rig_.Wait(1);
  }

  void Episode(Source source, Outcome& outcome) {
    if (rig_.onboard_status.message.estop) rig_.Rearm();
    rig_.Forget();
    keyboard_.Read();
    if (!Drives()) {
      ++outcome.no_drive;
      return;
    }
    rig_.Wait(rig_.rng.Uniform(0, 0.1));
    const Time pressed = Press(source);
    Time message{}, zero{};
    const auto stopped = [&] {
      for (const auto& e : rig_.onboard_estops)
        if (message == Time{} && e.at >= pressed) message = e.at;
      // A zero before the message is a command that came too late; its own message may be seen after it.
      for (const auto& w : rig_.wheels)
        if (zero == Time{} && message != Time{} && w.at >= message - kOrder && IsZero(w.message)) zero = w.at;
      return message != Time{} && zero != Time{};
    };
    if (!rig_.Until(stopped, milliseconds(3000))) {
      ++outcome.lost;
      return;
    }
    outcome.whole.Add(zero - pressed);
    outcome.onboard.Add(std::max(zero - message, Duration::zero()));
    CheckRest(zero, outcome);
  }

  double utilisation() const { return rig_.offboard_link.message.utilisation; }

 private:
  /// Through a full radio a command may come too late, and the base stops in between.
  bool Drives() {
    for (int attempt = 0; attempt < 4; ++attempt)
      if (rig_.Grip() && rig_.DriveAtFullSpeed()) return true;
    return false;
  }

  Time Press(Source source) {
    const Time now = rig_.Now(), before = rig_.mouse_spoke();
    switch (source) {
      case Source::kMouse:
        rig_.hand.buttons |= DrivingRig::kEstopKey;
        rig_.Until([&] { return rig_.mouse_spoke() != before; }, milliseconds(100));
        return rig_.mouse_spoke();
      case Source::kKeyboard:
        keyboard_.Type(' ');
        return now;
      case Source::kCommand:
        command_ = std::make_unique<Terminal>(
            std::vector<std::string>{options_.program_folder + "/priamos", "estop"});
        return now;
      case Source::kBus:
        rig_.SayEstop(true);
    }
    return now;
  }

  /// The hand pushes on, also when the e-stop has been lifted: the base must not move before the next grip.
  void CheckRest(Time zero, Outcome& outcome) {
    rig_.Until([&] { return rig_.offboard_status.message.estop != 0; }, milliseconds(3000));
    rig_.Wait(0.1);
    command_.reset();
    rig_.hand.buttons &= ~DrivingRig::kEstopKey;
    rig_.Rearm();
    rig_.Wait(0.7);
    outcome.moved_after += std::any_of(rig_.wheels.begin(), rig_.wheels.end(),
                                       [&](const auto& w) { return w.at > zero && !IsZero(w.message); });
  }

  RigOptions options_;
  DrivingRig rig_;
  Terminal keyboard_;
  std::unique_ptr<Terminal> command_;
};

int Print(Source source, const Outcome& o) {
  const bool held = o.lost == 0 && o.moved_after == 0 && o.no_drive == 0 &&
                    o.onboard.Percentile(99) <= kOnboard_ms && o.whole.Percentile(99) <= kThroughRadio_ms;
  fmt::print(
      "  {:<32} {:>5} {:>7.1f} {:>7.1f} {:>7.1f}   {:>7.1f} {:>7.1f} {:>7.1f}   {:>5} {:>6} {:>6}  {}\n",
      Text(source), o.whole.size(), o.whole.Percentile(50), o.whole.Percentile(99), o.whole.Largest(),
      o.onboard.Percentile(50), o.onboard.Percentile(99), o.onboard.Largest(), o.lost, o.moved_after,
      o.no_drive, held ? "held" : "BROKEN");
  return !held;
}

void PrintHead(const std::string& what) {
  fmt::print("\n{} [ms]\n  {:<32} {:>5} {:>7} {:>7} {:>7}   {:>7} {:>7} {:>7}   {:>5} {:>6} {:>6}\n", what,
             "until the wheel command is zero", "n", "p50", "p99", "most", "onboard", "p99", "most", "lost",
             "moved", "none");
}

}  // namespace

int StudyEstop(const RigOptions& options, int episodes, int saturated_episodes, const std::string& only) {
  int broken = 0;
  std::vector<Source> sources{Source::kMouse, Source::kKeyboard, Source::kCommand, Source::kBus};
  std::erase_if(sources, [&](Source s) { return std::string(Text(s)).find(only) == std::string::npos; });
  const auto run = [&](EstopStudy& study, int n, const std::string& what) {
    Outcome outcomes[4];
    for (int i = 0; i < n; ++i) {
      for (const Source s : sources) study.Episode(s, outcomes[static_cast<int>(s)]);
      if (i % 10 == 9) fmt::print(stderr, "{}: {} of {}\n", what, i + 1, n);
    }
    PrintHead(what);
    for (const Source s : sources) broken += Print(s, outcomes[static_cast<int>(s)]);
  };
  if (episodes > 0) {
    EstopStudy study(options);
    run(study, episodes, "E-stop at full speed");
  }
  if (saturated_episodes > 0) {
    RigOptions saturated = options;
    saturated.saturated = true;
    EstopStudy study(saturated);
    run(study, saturated_episodes, "E-stop at full speed through a saturated radio");
    fmt::print("  the line to the robot was used by {:.0f} % at the end\n", 100 * study.utilisation());
  }
  return broken;
}

}  // namespace priamos::bench
