#include "planner/core/missions/model_queue.hpp"

#include <algorithm>
#include <utility>

namespace priamos::planner {
namespace {

/// Periods after which a wish is dropped: the robot has driven on.
constexpr int kWaits = 3;
/// Periods within which a model that was sent has arrived, also when the radio repeats it.
constexpr int kArrives = 2;

}  // namespace

void ModelQueue::Want(Landmark model, Time now) {
  std::erase_if(newest_first_, [&](const Wish& wish) { return wish.model.id == model.id; });
  newest_first_.push_front({std::move(model), now});
}

std::optional<Landmark> ModelQueue::Next(Time now) {
  if (last_ && now - *last_ < period_) return std::nullopt;
  std::erase_if(newest_first_, [&](const Wish& wish) {
    return now - wish.since > kWaits * period_ || IsOnItsWay(wish.model.id, now);
  });
  if (newest_first_.empty()) return std::nullopt;
  Landmark model = std::move(newest_first_.front().model);
  newest_first_.pop_front();
  sent_[model.id] = now;
  last_ = now;
  return model;
}

bool ModelQueue::IsOnItsWay(int id, Time now) const {
  const auto sent = sent_.find(id);
  return sent != sent_.end() && now - sent->second < kArrives * period_;
}

}  // namespace priamos::planner
