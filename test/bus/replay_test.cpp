#include "bus/replay.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "bus/lockstep.hpp"
#include "bus/log/log_writer.hpp"
#include "bus/output_comparison.hpp"
#include "bus/own_types.hpp"
#include "common/config.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::bus {
namespace {

struct NoConfig {
  double gain = 2;
  void Describe(Archive& a) { a.Number("gain", gain, {"-", 0, 10, "what the answer is multiplied by"}); }
};

/// Sends a pose every 10 ms.
class Source {
 public:
  using Config = NoConfig;
  static constexpr std::string_view kName = "source", kSummary = "";
  Source(const NoConfig&, Context& context) : pose_(context.node().Advertise(channels::kPose)) {}
  Duration TickPeriod() const { return std::chrono::milliseconds(10); }
  void Tick(Time now) {
    pose_t pose{};
    pose.utime = ToUtime(now);
    pose.x_m = ++n_;
    pose_.Publish(pose);
  }

 private:
  Publisher<pose_t> pose_;
  int n_ = 0;
};

/// Answers the newest pose every 20 ms, and tells how old it was.
class Answerer {
 public:
  using Config = NoConfig;
  static constexpr std::string_view kName = "answerer", kSummary = "";
  Answerer(const NoConfig& config, Context& context)
      : config_(config),
        pose_(context.node().Subscribe(channels::kPose)),
        odometry_(context.node().Advertise(channels::kOdometry)) {}
  Duration TickPeriod() const { return std::chrono::milliseconds(20); }
  void Tick(Time now) {
    const auto age = pose_.Age(now);
    const auto pose = pose_.Take();
    if (!pose) return;
    odometry_t answer{};
    answer.utime = ToUtime(now);
    answer.x_m = config_.gain * pose->x_m;
    answer.y_m = Seconds(age);
    odometry_.Publish(answer);
  }

 private:
  NoConfig config_;
  Latest<pose_t> pose_;
  Publisher<odometry_t> odometry_;
};

class ReplayTest : public testing::Test {
 protected:
  /// One second of both in lockstep, as a log.
  void RecordRun() {
    LogWriter writer(log_);
    Lockstep lockstep(schema_, {});
    lockstep.AddBus("bus");
    lockstep.SetTap([&](std::string_view, Time now, std::string_view channel,
                        std::span<const std::byte> bytes) { writer.Write(ToUtime(now), channel, bytes); });
    lockstep.AddApp(FactoryOf<Source>(), "bus", {});
    lockstep.AddApp(FactoryOf<Answerer>(), "bus", {});
    lockstep.RunUntil(FromUtime(1'001'000'000));
  }
  OutputComparison Verify(const ConfigSource& source = {}) {
    Replay dut(FactoryOf<Answerer>(), source, schema_, log_, {});
    std::vector<Output> replayed;
    dut.Run([&](const Output& output) { replayed.push_back(output); });
    fed_ = dut.fed();
    return CompareOutputs(dut.recorded(), replayed, schema_);
  }
  Schema schema_ = OwnTypes();
  TemporaryFolder folder_;
  std::string log_ = folder_ / "run.lcmlog";
  std::uint64_t fed_ = 0;
};

TEST_F(ReplayTest, ALockstepRunIsReplayedToTheByte) {
  RecordRun();
  const auto comparison = Verify();
  EXPECT_TRUE(comparison.equal) << (comparison.differences.empty() ? "" : comparison.differences.front());
  EXPECT_EQ(comparison.channels.at("ODOMETRY").equal, 51u);
  EXPECT_EQ(comparison.channels.at("HEALTH").equal, 2u);
  EXPECT_GE(fed_, 101u);
}

TEST_F(ReplayTest, AnotherConfigurationIsShownFieldByField) {
  RecordRun();
  const auto comparison = Verify({"", {"gain = 3"}});
  EXPECT_FALSE(comparison.equal);
  EXPECT_EQ(comparison.channels.at("ODOMETRY").equal, 0u);
  ASSERT_FALSE(comparison.differences.empty());
  EXPECT_EQ(comparison.differences.front(), "ODOMETRY 0 at 0.000 s: x_m: recorded 2.0, replayed 3.0");
}

TEST_F(ReplayTest, ALogWithoutTheModuleHasNothingRecorded) {
  {
    LogWriter writer(log_);
    writer.Write(5'000'000, "POSE", Encode(pose_t{}));
    writer.Write(5'100'000, "POSE", Encode(pose_t{}));
  }
  const auto comparison = Verify();
  EXPECT_EQ(comparison.channels.at("ODOMETRY").recorded, 0u);
  EXPECT_GT(comparison.channels.at("ODOMETRY").replayed, 0u);
  EXPECT_FALSE(comparison.equal);
}

TEST_F(ReplayTest, ATimeThatCannotBeIsLeftOut) {
  {
    LogWriter writer(log_);
    writer.Write(5'000'000, "POSE", Encode(pose_t{}));
    writer.Write(std::int64_t{1} << 52, "POSE", Encode(pose_t{}));
    writer.Write(5'100'000, "POSE", Encode(pose_t{}));
  }
  Replay dut(FactoryOf<Answerer>(), {}, schema_, log_, {});
  dut.Run([](const Output&) {});
  EXPECT_EQ(dut.implausible(), 1u);
  EXPECT_EQ(dut.fed(), 2u);
  EXPECT_EQ(dut.Summary(7), "2 messages heard, 7 sent, 1 of an impossible time left out");
}

TEST_F(ReplayTest, AnEmptyLogIsASentence) {
  std::ofstream(log_).close();
  EXPECT_THROW(Replay(FactoryOf<Answerer>(), {}, schema_, log_, {}), std::runtime_error);
}

TEST(FieldDifferences, NamesNestedFieldsAndElements) {
  const Schema schema = OwnTypes();
  sonar_ranges_t a{}, b{};
  b.range_m[3] = 1.5;
  const auto dut = FieldDifferences(Encode(a), Encode(b), schema);
  ASSERT_EQ(dut.size(), 1u);
  EXPECT_EQ(dut[0], "range_m[3]: recorded 0.0, replayed 1.5");
}

TEST(FieldDifferences, BytesThatAreNoMessageAreCompared) {
  const Schema schema = OwnTypes();
  const std::vector<std::byte> a(3), b(5);
  EXPECT_EQ(FieldDifferences(a, a, schema).size(), 0u);
  EXPECT_EQ(FieldDifferences(a, b, schema).front(), "recorded 3 bytes, replayed 5 other ones");
}

}  // namespace
}  // namespace priamos::bus
