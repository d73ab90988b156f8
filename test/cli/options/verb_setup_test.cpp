#include "cli/options/verb_setup.hpp"

#include <gtest/gtest.h>

namespace priamos::cli {
namespace {

struct Options {
  int size = 3;
  bool json = false;
};

int SizeOf(const Options& options) {
  return options.json ? -options.size : options.size;
}

class CompleteVerbTest : public testing::Test {
 protected:
  CompleteVerbTest() {
    auto options = std::make_shared<Options>();
    auto* verb = cli_.add_subcommand("measure", "to try");
    verb->add_option("--size", options->size);
    CompleteVerb(*verb, options, SizeOf, exit_code_, "as JSON");
    cli_.add_subcommand("other", "to try");
  }
  CLI::App cli_;
  int exit_code_ = 99;
};

TEST_F(CompleteVerbTest, TheChosenVerbLeavesItsExitCode) {
  cli_.parse("measure --size 7", false);
  EXPECT_EQ(exit_code_, 7);
}

TEST_F(CompleteVerbTest, JsonIsAFlagOfTheOptions) {
  cli_.parse("measure --json", false);
  EXPECT_EQ(exit_code_, -3);
  EXPECT_EQ(cli_.get_subcommand("measure")->get_option("--json")->get_description(), "as JSON");
}

TEST_F(CompleteVerbTest, AVerbThatWasNotChosenDoesNothing) {
  cli_.parse("other", false);
  EXPECT_EQ(exit_code_, 99);
}

}  // namespace
}  // namespace priamos::cli
