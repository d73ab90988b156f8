#pragma once

#include <gtest/gtest.h>

#include "test/system/installation.hpp"

namespace priamos {

/// Tests of what this build installs.
class InstalledTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto answer = installed_.Install();
    ASSERT_EQ(answer.exit_code, 0) << answer.text;
  }
  const Installation installed_;
};

}  // namespace priamos
