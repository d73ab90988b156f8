// What stands before every decode, and before every radio message: walk, pack, unpack, JSON.
#include <benchmark/benchmark.h>

#include <nlohmann/json.hpp>

#include "bus/schema/json.hpp"
#include "bus/schema/packing.hpp"
#include "bus/schema/schema.hpp"
#include "bus/schema/walk.hpp"
#include "lcmtypes/embedded_types.hpp"
#include "priamos/health_t.hpp"
#include "priamos/landmark_model_t.hpp"
#include "priamos/pose_t.hpp"
#include "priamos/sonar_ranges_t.hpp"

namespace priamos::bus {
namespace {

const Schema& Own() {
  static const Schema schema = Schema::FromTexts(EmbeddedTypes());
  return schema;
}

pose_t Sample(const pose_t&) {
  pose_t pose{};
  pose.x_m = 12.34;
  pose.yaw_rad = -1.5;
  return pose;
}
sonar_ranges_t Sample(const sonar_ranges_t&) {
  sonar_ranges_t ranges{};
  for (int i = 0; i < 24; ++i) ranges.range_m[i] = 0.2 * i;
  return ranges;
}
health_t Sample(const health_t&) {
  health_t health{};
  health.process = "robot";
  health.text = "sonar silent";
  return health;
}
landmark_model_t Sample(const landmark_model_t&) {
  landmark_model_t model{};
  model.n_edges = 20;
  model.edges.resize(20);
  return model;
}

template <class T>
std::vector<std::byte> SampleBytes() {
  const T message = Sample(T{});
  std::vector<std::byte> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

template <class T>
const Struct& TypeOf() {
  return *Own().Find(static_cast<std::uint64_t>(T::getHash()));
}

template <class T>
void BM_Walk(benchmark::State& state) {
  const auto bytes = SampleBytes<T>();
  const Struct& type = TypeOf<T>();
  for (auto _ : state) benchmark::DoNotOptimize(static_cast<bool>(Walk(type, bytes)));
  state.counters["bytes"] = static_cast<double>(bytes.size());
}

template <class T>
void BM_Pack(benchmark::State& state) {
  const auto bytes = SampleBytes<T>();
  const Packer packer(TypeOf<T>());
  for (auto _ : state) benchmark::DoNotOptimize(packer.Pack(bytes, 0));
  state.counters["bytes"] = static_cast<double>(packer.Pack(bytes, 0)->bytes.size());
}

template <class T>
void BM_Unpack(benchmark::State& state) {
  const Packer packer(TypeOf<T>());
  const auto packed = packer.Pack(SampleBytes<T>(), 0)->bytes;
  for (auto _ : state) benchmark::DoNotOptimize(packer.Unpack(packed, 0));
}

template <class T>
void BM_ToJson(benchmark::State& state) {
  const auto bytes = SampleBytes<T>();
  for (auto _ : state) benchmark::DoNotOptimize(ToJson(TypeOf<T>(), bytes));
}

void BM_ParseAllTypes(benchmark::State& state) {
  const auto texts = EmbeddedTypes();
  for (auto _ : state) benchmark::DoNotOptimize(Schema::FromTexts(texts));
}

BENCHMARK(BM_Walk<pose_t>);
BENCHMARK(BM_Walk<health_t>);
BENCHMARK(BM_Walk<landmark_model_t>);
BENCHMARK(BM_Pack<pose_t>);
BENCHMARK(BM_Pack<sonar_ranges_t>);
BENCHMARK(BM_Pack<landmark_model_t>);
BENCHMARK(BM_Unpack<pose_t>);
BENCHMARK(BM_Unpack<sonar_ranges_t>);
BENCHMARK(BM_ToJson<pose_t>);
BENCHMARK(BM_ParseAllTypes)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace priamos::bus

BENCHMARK_MAIN();
