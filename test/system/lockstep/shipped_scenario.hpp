#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

#include "bus/own_types.hpp"
#include "cli/lockstep/lockstep_run.hpp"

namespace priamos::cli {

/// Runs a shipped scenario with each seed: every run passes, and the base touches nothing.
inline void ExpectPasses(const std::string& scenario, std::initializer_list<std::uint64_t> seeds) {
  const bus::Schema schema = bus::OwnTypes();
  for (const std::uint64_t seed : seeds) {
    LockstepRequest request;
    request.deployment = PRIAMOS_SOURCE_DIR "/config/sim";
    request.scenario = scenario;
    request.seed = seed;
    const Summary dut = RunLockstep(schema, request).summary;
    EXPECT_TRUE(dut.passed) << "seed " << seed << ": " << dut.reason;
    EXPECT_EQ(dut.contacts, 0) << "seed " << seed;
  }
}

}  // namespace priamos::cli
