#include <gmock/gmock.h>

#include <fstream>

#include "test/cli/priamos_answer.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using testing::HasSubstr;

TEST(UpCommand, WhatCannotBeginInTheBackgroundEndsAsInTheForeground) {
  const TemporaryFolder folder;
  std::ofstream(folder / "deployment.toml") << "title = 3\n";
  for (const bool detached : {false, true}) {
    std::vector<std::string> words{"up", folder.path().string() + "/", "--logs", folder / "logs"};
    if (detached) words.push_back("--detach");
    const auto answer = Priamos(words);
    EXPECT_EQ(answer.exit_code, 2) << detached;
    EXPECT_THAT(answer.err, HasSubstr("deployment.toml:1:title: expected a string, got 3")) << detached;
  }
}

}  // namespace
}  // namespace priamos::cli
