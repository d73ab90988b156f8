#include "cli/terminal/silence_watch.hpp"

#include <gmock/gmock.h>

#include "lcmtypes/channels.hpp"

namespace priamos::cli {
namespace {

using testing::Contains;
using testing::IsSupersetOf;
using testing::Not;
using testing::StartsWith;

const Time kStart = FromUtime(1'000'000'000);

BusOptions On(const std::string& url) {
  BusOptions options;
  options.bus.bus = url;
  return options;
}

/// What `act` writes to standard error.
template <class Act>
std::string Told(const Act& act) {
  testing::internal::CaptureStderr();
  act();
  return testing::internal::GetCapturedStderr();
}

TEST(ChannelNames, EventsAreThoseWithoutARate) {
  EXPECT_EQ(ChannelNames(false).size(), std::tuple_size_v<decltype(channels::kAll)>);
  EXPECT_THAT(ChannelNames(true), IsSupersetOf({"ESTOP", "PATH"}));
  EXPECT_THAT(ChannelNames(true), Not(Contains("POSE")));
}

TEST(SilenceWatch, TellsOnceWhenItsPatienceIsOver) {
  SilenceWatch dut("priamos try", On("memq://"), "POSE", kStart, std::chrono::seconds(1));
  EXPECT_EQ(Told([&] { dut.Step(kStart + std::chrono::milliseconds(999)); }), "");
  EXPECT_THAT(Told([&] { dut.Step(kStart + std::chrono::seconds(1)); }),
              StartsWith("priamos try: nothing is heard on memq://; is anything up"));
  EXPECT_EQ(Told([&] {
              dut.Step(kStart + std::chrono::seconds(9));
              dut.Explain(kStart + std::chrono::seconds(9));
            }),
            "");
}

TEST(SilenceWatch, WhatWasHeardNeedsNoExplanation) {
  SilenceWatch dut("priamos try", On("memq://"), "POSE", kStart);
  dut.Heard();
  EXPECT_EQ(Told([&] {
              dut.Step(kStart + std::chrono::seconds(9));
              dut.Explain(kStart + std::chrono::seconds(9));
            }),
            "");
}

}  // namespace
}  // namespace priamos::cli
