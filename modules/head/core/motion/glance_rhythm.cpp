#include "head/core/motion/glance_rhythm.hpp"

namespace priamos::head {

bool GlanceRhythm::Step(bool needed, bool glancing, bool wanted, Time now) {
  if (needed) needed_ = now;
  if (glancing) ended_ = now;
  if (needed || glancing || !wanted) return false;
  if (needed_ && Seconds(now - *needed_) < idle_s_) return false;
  return !ended_ || Seconds(now - *ended_) >= every_s_;
}

}  // namespace priamos::head
