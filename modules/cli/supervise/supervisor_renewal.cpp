// Processes that are started again by order, alone or all together.

#include <unistd.h>

#include <algorithm>

#include "cli/supervise/supervisor.hpp"

namespace priamos::cli {

bool Supervisor::Restart(const std::string& name) {
  const auto child =
      std::find_if(children_.begin(), children_.end(), [&](const Child& c) { return c.spec.name == name; });
  if (child == children_.end()) return false;
  announce_(name + " is started again by order");
  child->watch.Restart();
  return true;
}

void Supervisor::Renew(std::vector<ProcessSpec> specs, std::vector<std::string> forget) {
  for (const ProcessSpec& spec : specs) Find(spec.name);
  for (ProcessSpec& spec : specs)
    for (Child& child : children_)
      if (child.spec.name == spec.name) {
        child.next = std::move(spec);
        child.watch.Restart();
        break;
      }
  forget_ = std::move(forget);
}

/// What the old ones had in hand must not reach a new one: so none begins while one of them runs.
void Supervisor::EndRenewal() {
  const auto waits = [](const Child& c) { return c.next.has_value(); };
  if (std::none_of(children_.begin(), children_.end(), waits)) return;
  if (std::any_of(children_.begin(), children_.end(), [](const Child& c) { return c.next && c.pid != 0; }))
    return;
  for (const std::string& file : forget_) unlink(file.c_str());
  for (Child& child : children_) {
    if (!child.next) continue;
    child.spec = std::move(*child.next);
    child.next.reset();
  }
}

}  // namespace priamos::cli
