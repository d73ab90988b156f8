#include "common/config_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace priamos {
namespace {

std::string Meaning(const ValueSpec& spec) {
  const std::string unit = spec.unit.empty() ? "" : fmt::format("[{}] ", spec.unit);
  return fmt::format("{}{}; {}", unit, spec.doc, RangeText(spec));
}

class KeyList : public Archive {
 public:
  explicit KeyList(std::vector<ConfigKey>& keys) : keys_(keys) {}

  void Number(std::string_view key, double& value, const ValueSpec& spec) override {
    Add(key, fmt::format("{}", value), Meaning(spec));
  }
  void Integer(std::string_view key, int& value, const ValueSpec& spec) override {
    Add(key, fmt::format("{}", value), Meaning(spec));
  }
  void Flag(std::string_view key, bool& value, std::string_view doc) override {
    Add(key, value ? "true" : "false", std::string(doc));
  }
  void Text(std::string_view key, std::string& value, std::string_view doc) override {
    Add(key, fmt::format("\"{}\"", value), std::string(doc));
  }
  void Choice(std::string_view key, std::string& value, const std::vector<std::string>& choices,
              std::string_view doc) override {
    Add(key, fmt::format("\"{}\"", value), fmt::format("{}; one of {}", doc, fmt::join(choices, ", ")));
  }
  void Numbers(std::string_view key, std::vector<double>& values, const ValueSpec& spec) override {
    Add(key, fmt::format("[{}]", fmt::join(values, ", ")), Meaning(spec));
  }
  void Refuse(std::string_view, std::string_view) override {}
  void Require(std::string_view, std::string_view) override {}
  void Live(std::string_view name, LiveChange change) override {
    for (ConfigKey& key : keys_)
      if (key.name == name) key.meaning += fmt::format("; {}", LiveText(change));
  }

 protected:
  bool Enter(std::string_view key, std::string_view doc) override {
    Add(key, "", std::string(doc));
    prefixes_.push_back(fmt::format("{}{}.", prefixes_.back(), key));
    return true;
  }
  void Leave() override { prefixes_.pop_back(); }
  std::size_t BeginList(std::string_view key, std::size_t, std::string_view doc) override {
    Add(fmt::format("{}[]", key), "", std::string(doc));
    return 1;
  }
  void EnterItem(std::string_view key, std::size_t) override {
    prefixes_.push_back(fmt::format("{}{}[].", prefixes_.back(), key));
  }

 private:
  void Add(std::string_view key, const std::string& value, const std::string& meaning) {
    keys_.push_back({prefixes_.back() + std::string(key), value, meaning});
  }

  std::vector<ConfigKey>& keys_;
  std::vector<std::string> prefixes_{""};
};

}  // namespace

std::unique_ptr<Archive> MakeKeyList(std::vector<ConfigKey>& keys) {
  return std::make_unique<KeyList>(keys);
}

}  // namespace priamos
