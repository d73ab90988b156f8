#pragma once

// What holds for every parameter that may be changed while its process runs, whichever process it is.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "common/parameters/parameter_store.hpp"

namespace priamos {

/// Each live parameter of a `Config` has a story in `stories`, by its name, and each story such a parameter.
template <class Config, class Story>
void ExpectAStoryForEach(const std::map<std::string, Story>& stories) {
  const ParameterTable table([](Archive& a) { Config().Describe(a); });
  for (const Parameter& parameter : table.all())
    EXPECT_TRUE(stories.contains(parameter.name)) << parameter.name;
  EXPECT_EQ(stories.size(), table.all().size());
}

/// A process that was started with a configuration and then given another, `measure(started, given)`, behaves
/// as if it had been started with the second, and unlike one that was not given it: `name` set to `value`,
/// and back.
template <class Config, class Measure>
void ExpectObeyedAtOnce(const std::string& name, double value, const Measure& measure) {
  const Config standard;
  Config changed;
  ParameterStore store([&](Archive& a) { changed.Describe(a); });
  ASSERT_EQ(store.Set(store.table().NumberOf(name), value), ChangeVerdict::kDone);

  const double before = measure(standard, standard);
  const double after = measure(standard, changed);
  EXPECT_EQ(after, measure(changed, changed));
  EXPECT_NE(after, before);
  EXPECT_EQ(measure(changed, standard), before) << "and back";
}

template <class Story>
std::vector<std::string> NamesOf(const std::map<std::string, Story>& stories) {
  std::vector<std::string> names;
  for (const auto& [name, story] : stories) names.push_back(name);
  return names;
}

/// The name of a test for the parameter that it is given.
inline std::string ParameterTestName(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

}  // namespace priamos
