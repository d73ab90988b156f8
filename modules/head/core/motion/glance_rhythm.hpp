#pragma once

#include <optional>

#include "common/time.hpp"

namespace priamos::head {

/// When a glance may begin: not while anybody needs the head, nor too soon after that or after the last one.
class GlanceRhythm {
 public:
  /// `every_s` from the end of a glance to the beginning of the next one, `idle_s` after the head was needed.
  GlanceRhythm(double every_s, double idle_s) : every_s_(every_s), idle_s_(idle_s) {}

  /// One time step; true: begin one now. `needed`: a look or an operator moves the head; `glancing`: a glance
  /// is under way; `wanted`: there is a reason for one.
  bool Step(bool needed, bool glancing, bool wanted, Time now);
  /// The head is needed now, though no glance could begin in any case.
  void Defer(Time now) { needed_ = now; }

 private:
  double every_s_, idle_s_;
  std::optional<Time> needed_, ended_;
};

}  // namespace priamos::head
