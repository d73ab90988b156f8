#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "common/archive.hpp"

namespace priamos {

/// Visits a configuration and hands every number with its dotted name to OnNumber; values in lists have none.
class DescribedNumbers : public Archive {
 public:
  void Number(std::string_view key, double& value, const ValueSpec& spec) override {
    if (in_lists_ == 0) OnNumber(prefixes_.back() + std::string(key), value, spec);
  }
  void Integer(std::string_view, int&, const ValueSpec&) override {}
  void Flag(std::string_view, bool&, std::string_view) override {}
  void Text(std::string_view, std::string&, std::string_view) override {}
  void Choice(std::string_view, std::string&, const std::vector<std::string>&, std::string_view) override {}
  void Numbers(std::string_view, std::vector<double>&, const ValueSpec&) override {}
  void Refuse(std::string_view, std::string_view) override {}
  void Require(std::string_view, std::string_view) override {}

 protected:
  virtual void OnNumber(const std::string& name, double& value, const ValueSpec& spec) = 0;

  bool Enter(std::string_view key, std::string_view) override {
    prefixes_.push_back(fmt::format("{}{}.", prefixes_.back(), key));
    items_.push_back(false);
    return true;
  }
  void Leave() override {
    prefixes_.pop_back();
    in_lists_ -= items_.back() ? 1 : 0;
    items_.pop_back();
  }
  std::size_t BeginList(std::string_view, std::size_t size, std::string_view) override { return size; }
  void EnterItem(std::string_view key, std::size_t) override {
    prefixes_.push_back(fmt::format("{}{}[].", prefixes_.back(), key));
    items_.push_back(true);
    ++in_lists_;
  }

 private:
  std::vector<std::string> prefixes_{""};
  std::vector<bool> items_;
  int in_lists_ = 0;
};

}  // namespace priamos
