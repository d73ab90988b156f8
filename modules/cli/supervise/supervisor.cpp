#include "cli/supervise/supervisor.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "bus/clocks/host_clock.hpp"
#include "cli/supervise/process_stat.hpp"
#include "common/text/nearest_word.hpp"

namespace priamos::cli {
namespace {

constexpr int kCannotExec = 127;
/// So many messages fit into the socket on most machines. When it was full, datagrams were lost: on a busy
/// machine always those of the process that sends least often.
constexpr std::size_t kFull = 10;
constexpr Duration kOwnSilence = std::chrono::milliseconds(300), kLookPeriod = std::chrono::milliseconds(50);

/// Everything that a child needs between fork and exec, where only async-signal-safe calls are allowed.
struct Launch {
  std::vector<char*> argv, environment;
  const char* folder = nullptr;
  int output = -1;
  pid_t parent = 0;
};

[[noreturn]] void Exec(const Launch& launch) {
  // SIGKILL: a child that is stopped, or deaf, must not survive either.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != launch.parent) _exit(kCannotExec);  // the parent died before prctl
  setpgid(0, 0);  // Ctrl-C is for the supervisor, which ends its children in order
  if (launch.folder && chdir(launch.folder) != 0) _exit(kCannotExec);
  const int nothing = open("/dev/null", O_RDONLY);
  if (nothing >= 0) dup2(nothing, STDIN_FILENO);
  dup2(launch.output, STDOUT_FILENO);
  dup2(launch.output, STDERR_FILENO);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  execve(launch.argv[0], launch.argv.data(), launch.environment.data());
  _exit(kCannotExec);
}

std::vector<char*> Pointers(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string& t : texts) pointers.push_back(t.data());
  pointers.push_back(nullptr);
  return pointers;
}

std::vector<std::string> EnvironmentWith(const std::string& notify_socket, Duration watchdog) {
  std::vector<std::string> environment;
  for (char** e = environ; *e; ++e)
    if (std::strncmp(*e, "NOTIFY_SOCKET=", 14) != 0 && std::strncmp(*e, "WATCHDOG_", 9) != 0)
      environment.emplace_back(*e);
  environment.push_back("NOTIFY_SOCKET=" + notify_socket);
  if (watchdog > Duration::zero()) environment.push_back(fmt::format("WATCHDOG_USEC={}", watchdog.count()));
  return environment;
}

std::string LastLine(const std::string& file) {
  std::ifstream in(file);
  std::string line, last;
  while (std::getline(in, line))
    if (!line.empty() && line.rfind("--- ", 0) != 0) last = line;
  return last;
}

std::string HowEnded(int status, const std::string& output_file) {
  if (WIFSIGNALED(status))
    return fmt::format("killed by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  if (WEXITSTATUS(status) == kCannotExec) return "the program cannot be started";
  return fmt::format("exit code {}: {}", WEXITSTATUS(status), LastLine(output_file));
}

}  // namespace

Supervisor::Supervisor(std::vector<ProcessSpec> specs, std::string output_folder, Announce announce)
    : output_folder_(std::move(output_folder)), announce_(std::move(announce)) {
  for (ProcessSpec& spec : specs) {
    WatchPolicy policy = spec.policy;
    if (!spec.notifies) policy.watchdog = Duration::zero();
    children_.push_back({std::move(spec), ProcessWatch(policy), 0});
  }
  CheckOrder();
}

/// Takes away, again and again, what depends on nothing that is left.
void Supervisor::CheckOrder() const {
  std::vector<const Child*> left;
  for (const Child& c : children_) left.push_back(&c);
  const auto is_left = [&](const std::string& name) {
    Find(name);
    return std::any_of(left.begin(), left.end(), [&](const Child* c) { return c->spec.name == name; });
  };
  for (std::size_t before = left.size() + 1; !left.empty() && left.size() < before;) {
    before = left.size();
    std::erase_if(left, [&](const Child* c) {
      return std::none_of(c->spec.after.begin(), c->spec.after.end(), is_left);
    });
  }
  if (!left.empty())
    throw std::invalid_argument(
        fmt::format("process {}: after: expected no circle, got one", left.front()->spec.name));
}

Supervisor::~Supervisor() {
  const bus::HostClock clock;
  StopAll();
  while (!AllStopped()) {
    try {
      Step(clock.Now());
    } catch (const std::exception&) {  // what cannot be written now; the processes end all the same
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

const Supervisor::Child& Supervisor::Find(const std::string& name) const {
  std::vector<std::string> known;
  for (const Child& c : children_) {
    if (c.spec.name == name) return c;
    known.push_back(c.spec.name);
  }
  throw std::invalid_argument(
      fmt::format("after: expected the name of a process, got \"{}\"{}", name, NearestText(name, known)));
}

void Supervisor::Step(Time now) {
  Listen(now);
  ForgiveOwnSilence(now);
  LookAtChildren(now);
  Reap(now);
  EndRenewal();
  for (Child& child : children_) Act(child, now);
}

void Supervisor::Listen(Time now) {
  const auto messages = notify_.Read();
  if (messages.size() >= kFull) ForgiveSilence(now);
  for (const NotifySocket::Message& message : messages) {
    for (Child& child : children_) {
      if (child.pid == 0 || child.pid != message.pid) continue;
      if (message.alive) child.watch.SaidAlive(now);
      if (!message.status.empty()) announce_(fmt::format("{}: {}", child.spec.name, message.status));
      if (!message.ready || child.watch.state() != ProcessState::kStarting) continue;
      child.watch.SaidReady(now);
      announce_(fmt::format("{} is ready", child.spec.name));
    }
  }
}

/// While this process did not run nothing was received: what children sent then may not have fit into the
/// socket.
void Supervisor::ForgiveOwnSilence(Time now) {
  if (last_step_ != Time{} && now - last_step_ > kOwnSilence) ForgiveSilence(now);
  last_step_ = now;
}

void Supervisor::ForgiveSilence(Time now) {
  for (Child& child : children_) child.watch.SaidAlive(now);
}

/// Finds children that a signal has stopped, also those that send no WATCHDOG, without a timeout; and those
/// that are silent because the machine is busy with others.
void Supervisor::LookAtChildren(Time now) {
  if (now < next_look_) return;
  next_look_ = now + kLookPeriod;
  for (Child& child : children_) {
    if (child.pid == 0) continue;
    child.watch.SeenStopped(IsStopped(child.pid), now);
    child.watch.SeenWaiting(WaitedForProcessor(child.pid));
  }
}

void Supervisor::Reap(Time now) {
  for (Child& child : children_) {
    int status = 0;
    if (child.pid == 0 || waitpid(child.pid, &status, WNOHANG) != child.pid) continue;
    child.pid = 0;
    for (const std::string& file : child.spec.leftovers) unlink(file.c_str());
    const bool asked = child.watch.state() == ProcessState::kStopping;
    child.watch.Exited(HowEnded(status, ConsoleFile(child.spec.name)), now);
    if (!asked)
      announce_(fmt::format(
          "{} ended: {}{}", child.spec.name, child.watch.reason(),
          child.watch.alarm() ? fmt::format("  ALARM: {} times in a row", child.watch.failures()) : ""));
  }
}

void Supervisor::Act(Child& child, Time now) {
  switch (child.watch.Step(MayStart(child), MayStop(child), now)) {
    case ProcessWatch::Action::kNone:
      return;
    case ProcessWatch::Action::kStart:
      return Start(child, now);
    case ProcessWatch::Action::kTerminate:
      kill(child.pid, SIGTERM);
      return;
    case ProcessWatch::Action::kKill:
      kill(child.pid, SIGKILL);
  }
}

void Supervisor::Start(Child& child, Time now) {
  const std::string file = ConsoleFile(child.spec.name);
  Launch launch;
  launch.output = open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (launch.output < 0) throw std::system_error(errno, std::generic_category(), file);
  dprintf(launch.output, "--- start %d\n", child.watch.starts() + 1);
  auto environment =
      EnvironmentWith(notify_.name(), child.spec.notifies ? child.spec.policy.watchdog : Duration::zero());
  launch.argv = Pointers(child.spec.arguments);
  launch.environment = Pointers(environment);
  if (!child.spec.folder.empty()) launch.folder = child.spec.folder.c_str();
  launch.parent = getpid();
  const pid_t pid = fork();
  if (pid == 0) Exec(launch);
  const int error = errno;
  close(launch.output);
  child.watch.Started(now);
  if (pid < 0) return child.watch.Exited(std::string("fork: ") + std::strerror(error), now);
  child.pid = pid;
  if (!child.spec.notifies) child.watch.SaidReady(now);
}

bool Supervisor::MayStart(const Child& child) const {
  if (child.next) return false;
  return std::all_of(child.spec.after.begin(), child.spec.after.end(), [this](const std::string& name) {
    return Find(name).watch.state() == ProcessState::kReady;
  });
}

bool Supervisor::MayStop(const Child& child) const {
  return std::none_of(children_.begin(), children_.end(), [&](const Child& other) {
    const auto& after = other.spec.after;
    return other.pid != 0 && std::find(after.begin(), after.end(), child.spec.name) != after.end();
  });
}

bool Supervisor::AllReady() const {
  return std::all_of(children_.begin(), children_.end(),
                     [](const Child& c) { return c.watch.state() == ProcessState::kReady && !c.next; });
}

std::vector<ProcessReport> Supervisor::Report() const {
  std::vector<ProcessReport> all;
  for (const Child& c : children_) {
    all.push_back({.name = c.spec.name,
                   .group = c.spec.group,
                   .state = c.watch.state(),
                   .pid = c.pid,
                   .since = c.watch.since(),
                   .starts = c.watch.starts(),
                   .alarm = c.watch.alarm(),
                   .drives = c.spec.drives,
                   .reason = c.watch.reason()});
  }
  return all;
}

bool Supervisor::AllStopped() const {
  return std::none_of(children_.begin(), children_.end(), [](const Child& c) { return c.pid != 0; });
}

void Supervisor::StopAll() {
  for (Child& child : children_) child.watch.Stop();
}

}  // namespace priamos::cli
