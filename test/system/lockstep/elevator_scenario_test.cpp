#include "shipped_scenario.hpp"

// Into the cabin of an elevator, 1.10 m wide, and out of it backwards.

namespace priamos::cli {
namespace {

TEST(ElevatorScenario, InAndOut) {
  ExpectPasses("elevator", {1});
}

}  // namespace
}  // namespace priamos::cli
