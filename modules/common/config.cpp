#include "common/config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "common/config_toml.hpp"
#include "common/input/quoted.hpp"
#include "common/input/section_place.hpp"
#include "common/text/nearest_word.hpp"

namespace priamos {
namespace {

constexpr std::size_t kMostKeys = 4;  ///< keys named in the answer to a wrong one

std::string Shown(const toml::node& node) {
  std::string text;
  node.visit([&](const auto& n) {
    if constexpr (toml::is_table<decltype(n)>) {
      text = "a table";
    } else if constexpr (toml::is_array<decltype(n)>) {
      text = fmt::format("an array of {}", n.size());
    } else if constexpr (toml::is_string<decltype(n)>) {
      text = Quoted(n.get());
    } else if constexpr (toml::is_number<decltype(n)>) {
      text = fmt::format("{}", n.get());
    } else if constexpr (toml::is_boolean<decltype(n)>) {
      text = n.get() ? "true" : "false";
    } else {
      text = "a date or time";
    }
  });
  return text;
}

}  // namespace

/// Walks a parsed table; remembers which nodes were asked for.
class ConfigFile::Reader : public Archive, public PlaceSource {
 public:
  Reader(std::string name, toml::table table) : name_(std::move(name)), table_(std::move(table)) {
    levels_.push_back({"", &table_});
  }

  void Number(std::string_view key, double& value, const ValueSpec& spec) override {
    if (const auto* node = Find(key)) value = NumberIn(*node, key, spec);
  }

  void Integer(std::string_view key, int& value, const ValueSpec& spec) override {
    const auto* node = Find(key);
    if (!node) return;
    const auto number = node->value_exact<std::int64_t>();
    const bool ok = number && *number >= spec.min && *number <= spec.max &&
                    *number >= std::numeric_limits<int>::min() && *number <= std::numeric_limits<int>::max();
    if (!ok) Fail(*node, key, fmt::format("a whole number, {} [{}]", RangeText(spec), spec.unit));
    value = static_cast<int>(*number);
  }

  void Flag(std::string_view key, bool& value, std::string_view) override {
    const auto* node = Find(key);
    if (!node) return;
    const auto flag = node->value_exact<bool>();
    if (!flag) Fail(*node, key, "true or false");
    value = *flag;
  }

  void Text(std::string_view key, std::string& value, std::string_view) override {
    const auto* node = Find(key);
    if (!node) return;
    const auto text = node->value_exact<std::string>();
    if (!text) Fail(*node, key, "a string");
    value = *text;
  }

  void Choice(std::string_view key, std::string& value, const std::vector<std::string>& choices,
              std::string_view) override {
    const auto* node = Find(key);
    if (!node) return;
    const auto text = node->value_exact<std::string>();
    if (!text || std::find(choices.begin(), choices.end(), *text) == choices.end())
      Fail(*node, key, fmt::format("one of {}", fmt::join(choices, ", ")),
           NearestText(text.value_or(""), choices));
    value = *text;
  }

  void Numbers(std::string_view key, std::vector<double>& values, const ValueSpec& spec) override {
    const auto* node = Find(key);
    if (!node) return;
    const auto* array = node->as_array();
    if (!array || (!values.empty() && array->size() != values.size()))
      Fail(*node, key, values.empty() ? "an array of numbers" : fmt::format("{} numbers", values.size()));
    values.clear();
    for (const auto& item : *array) values.push_back(NumberIn(item, key, spec));
  }

  void Refuse(std::string_view key, std::string_view expected) override {
    const auto* table = levels_.back().table;
    const auto* node = table ? table->get(key) : nullptr;
    if (node) Fail(*node, key, std::string(expected));
    const auto path = Prefix() + std::string(key);
    throw ConfigError(fmt::format("{}: expected {}, got none",
                                  table ? PlaceOf(*table, path) : fmt::format("{}: {}", name_, path),
                                  expected));
  }

  void Require(std::string_view key, std::string_view expected) override {
    const auto* table = levels_.back().table;
    if (table && !table->get(key)) Refuse(key, expected);
  }

  SectionPlace PlaceOfSection() const override {
    const auto* table = levels_.back().table;
    if (!table) return {fmt::format("{}: {}", name_, Prefix()), "", {}};
    SectionPlace::Keys keys;
    for (const auto& [key, node] : *table)
      keys.emplace(key.str(), PlaceOf(node, Prefix() + std::string(key.str())));
    return {PlaceOf(*table, Prefix()), BeginOf(*table), std::move(keys)};
  }

  void RefuseUnknownKeys() const { RefuseUnknown(table_, ""); }

 protected:
  bool Enter(std::string_view key, std::string_view) override {
    const auto* node = Find(key);
    sections_.push_back(known_.back());
    if (node && !node->is_table()) Fail(*node, key, "a table");
    levels_.push_back({Prefix() + std::string(key) + ".", node ? node->as_table() : nullptr});
    return true;
  }
  void Leave() override { levels_.pop_back(); }

  std::size_t BeginList(std::string_view key, std::size_t default_size, std::string_view) override {
    const auto* node = Find(key);
    sections_.push_back(known_.back());
    if (!node) return default_size;
    const auto* array = node->as_array();
    if (!array || !std::all_of(array->begin(), array->end(), [](const auto& n) { return n.is_table(); }))
      Fail(*node, key, fmt::format("tables, [[{}]]", key));
    return array->size();
  }
  void EnterItem(std::string_view key, std::size_t index) override {
    const auto* node = levels_.back().table ? levels_.back().table->get(key) : nullptr;
    const auto* array = node ? node->as_array() : nullptr;
    levels_.push_back({fmt::format("{}{}[{}].", Prefix(), key, index),
                       array ? array->get_as<toml::table>(index) : nullptr});
  }

 private:
  struct Level {
    std::string prefix;
    const toml::table* table;
  };

  const std::string& Prefix() const { return levels_.back().prefix; }

  const toml::node* Find(std::string_view key) {
    known_.push_back(Prefix() + std::string(key));
    const auto* table = levels_.back().table;
    const auto* node = table ? table->get(key) : nullptr;
    if (node) asked_.insert(node);
    return node;
  }

  /// `file:line: `; empty for what was set on the command line.
  std::string BeginOf(const toml::table& table) const {
    const std::string& source = table.source().path ? *table.source().path : name_;
    return source.starts_with(kSetName) ? "" : fmt::format("{}:{}: ", source, table.source().begin.line);
  }

  /// Place of a value, `file:line:key`, or `--set KEY=VALUE: key` for what came from there.
  std::string PlaceOf(const toml::node& node, std::string_view key) const {
    const std::string& source = node.source().path ? *node.source().path : name_;
    if (source.starts_with(kSetName))
      return fmt::format("{}: {}", Escaped(Shortened(source)), Escaped(Shortened(key)));
    return fmt::format("{}:{}:{}", Escaped(source), node.source().begin.line, Escaped(Shortened(key)));
  }

  double NumberIn(const toml::node& node, std::string_view key, const ValueSpec& spec) const {
    const auto number = node.is_number() ? node.value<double>() : std::nullopt;
    // Written so that NaN fails.
    if (!number || !(*number >= spec.min && *number <= spec.max))
      Fail(node, key, fmt::format("a number, {} [{}]", RangeText(spec), spec.unit));
    return *number;
  }

  [[noreturn]] void Fail(const toml::node& node, std::string_view key, const std::string& expected,
                         const std::string& hint = "") const {
    throw ConfigError(fmt::format("{}: expected {}, got {}{}", PlaceOf(node, Prefix() + std::string(key)),
                                  expected, Shown(node), hint));
  }

  /// A key called the same in another section, else one that resembles `path`, else one elsewhere that is
  /// called nearly the same.
  std::string NearestKeys(const std::string& path) const {
    const auto name_of = [](const std::string& key) { return key.substr(key.rfind('.') + 1); };
    std::vector<std::string> names, keys;
    for (const std::string& key : known_) names.push_back(name_of(key));
    const auto near = NearestWords(name_of(path), names);
    for (const std::string& key : known_)
      if (std::find(near.begin(), near.end(), name_of(key)) != near.end()) keys.push_back(key);
    const bool same_name = near == std::vector{name_of(path)};
    const auto alike = same_name ? std::vector<std::string>{} : NearestWords(path, known_);
    if (!alike.empty()) keys = alike;
    if (keys.size() > kMostKeys) keys.resize(kMostKeys);
    return keys.empty() ? "" : fmt::format("; nearest: \"{}\"", fmt::join(keys, "\" or \""));
  }

  /// A section that resembles none is answered for its first key, which may be right elsewhere.
  [[noreturn]] void FailUnknown(const toml::node& node, const std::string& path) const {
    const auto* table = node.as_table();
    std::string hint = table ? NearestText(path, sections_) : NearestKeys(path);
    if (table && hint.empty() && !table->empty()) {
      const auto first = *table->begin();
      FailUnknown(first.second, fmt::format("{}.{}", path, first.first.str()));
    }
    throw ConfigError(fmt::format("{}: expected a known key (--print-config lists them), got this one{}",
                                  PlaceOf(node, path), hint));
  }

  void RefuseUnknown(const toml::table& table, const std::string& prefix) const {
    for (const auto& [key, node] : table) {
      if (!asked_.contains(&node)) FailUnknown(node, prefix + std::string(key.str()));
      if (const auto* inner = node.as_table()) RefuseUnknown(*inner, fmt::format("{}{}.", prefix, key.str()));
      if (const auto* array = node.as_array()) {
        for (std::size_t i = 0; i < array->size(); ++i)
          if (const auto* item = array->get_as<toml::table>(i))
            RefuseUnknown(*item, fmt::format("{}{}[{}].", prefix, key.str(), i));
      }
    }
  }

  std::string name_;
  toml::table table_;
  std::vector<Level> levels_;
  std::set<const toml::node*> asked_;
  std::vector<std::string> known_;     ///< dotted, of every key that was asked for
  std::vector<std::string> sections_;  ///< those of them that are tables
};

std::string ConfigSource::Folder() const {
  return path.empty() ? "." : std::filesystem::absolute(path).parent_path().string();
}

ConfigFile::ConfigFile(const ConfigSource& source)
    : reader_(std::make_unique<Reader>(source.path.empty() ? "command line" : source.path,
                                       ParseToml(source.path, source.overrides))) {}
ConfigFile::ConfigFile(const std::string& name, std::string_view text)
    : reader_(std::make_unique<Reader>(name, ParseToml(name, text))) {}
ConfigFile::~ConfigFile() = default;
Archive& ConfigFile::archive() {
  return *reader_;
}
void ConfigFile::RefuseUnknownKeys() const {
  reader_->RefuseUnknownKeys();
}

}  // namespace priamos
