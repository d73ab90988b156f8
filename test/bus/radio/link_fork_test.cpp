#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "link_pair.hpp"

// An end that was forked goes on as the original would, and neither changes the other: what an explorer of
// possible futures needs.

namespace priamos::bus::radio {
namespace {

/// What an end says in half a second, when this comes from the line and that is offered.
std::vector<std::byte> Future(LinkEndpoint& end, Time now, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<std::byte> said;
  for (int i = 0; i < 500; ++i) {
    now += Duration(1000);
    if (rng.Chance(0.02)) end.Offer(kPoseUp, Text(std::to_string(1'000'000'000 + rng.Below(100))), now);
    if (rng.Chance(0.02)) end.Offer(kEventUp, Text(std::to_string(1'000'000'000 + rng.Below(100))), now);
    std::vector<std::byte> noise(rng.Below(3));
    for (std::byte& b : noise) b = static_cast<std::byte>(rng.Below(256));
    end.Receive(noise, now);
    const auto bytes = end.Step(now);
    said.insert(said.end(), bytes.begin(), bytes.end());
  }
  return said;
}

RC_GTEST_PROP(LinkFork, AForkGoesItsOwnWayAndTheSameWay, ()) {
  const auto seed = *rc::gen::inRange<std::uint64_t>(1, 1'000'000);
  LinkPair pair({}, seed);
  pair.onboard.link->Offer(kEventUp, Text(std::string(300, 'x')), pair.now);
  pair.Run(0.2 + 0.001 * static_cast<double>(seed % 700));
  MemoryStore first_store = pair.onboard.store, second_store = pair.onboard.store;
  LinkEndpoint first = pair.onboard.link->Fork(first_store);
  LinkEndpoint second = pair.onboard.link->Fork(second_store);
  const auto another = Future(first, pair.now, seed + 1);
  first.Close();
  RC_ASSERT(pair.onboard.store.Load() == second_store.Load());
  const auto forked = Future(second, pair.now, seed);
  RC_ASSERT(Future(*pair.onboard.link, pair.now, seed) == forked);
  RC_ASSERT(pair.onboard.store.Load() == second_store.Load());
  RC_ASSERT(!forked.empty());
  RC_ASSERT(another != forked);
}

}  // namespace
}  // namespace priamos::bus::radio
