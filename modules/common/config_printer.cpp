#include "common/config_printer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ostream>
#include <utility>

namespace priamos {
namespace {

class Printer : public Archive {
 public:
  explicit Printer(std::ostream& out) : out_(out) {}

  void Number(std::string_view key, double& value, const ValueSpec& spec) override {
    Line(key, fmt::format("{}", value), fmt::format("[{}] {}; {}", spec.unit, spec.doc, RangeText(spec)));
  }
  void Integer(std::string_view key, int& value, const ValueSpec& spec) override {
    Line(key, fmt::format("{}", value), fmt::format("[{}] {}; {}", spec.unit, spec.doc, RangeText(spec)));
  }
  void Flag(std::string_view key, bool& value, std::string_view doc) override {
    Line(key, value ? "true" : "false", doc);
  }
  void Text(std::string_view key, std::string& value, std::string_view doc) override {
    Line(key, fmt::format("\"{}\"", value), doc);
  }
  void Choice(std::string_view key, std::string& value, const std::vector<std::string>& choices,
              std::string_view doc) override {
    Line(key, fmt::format("\"{}\"", value), fmt::format("{}; one of {}", doc, fmt::join(choices, ", ")));
  }
  void Numbers(std::string_view key, std::vector<double>& values, const ValueSpec& spec) override {
    Line(key, fmt::format("[{}]", fmt::join(values, ", ")),
         fmt::format("[{}] {}; {}", spec.unit, spec.doc, RangeText(spec)));
  }
  void Refuse(std::string_view, std::string_view) override {}
  void Require(std::string_view, std::string_view) override {}
  void Live(std::string_view key, LiveChange change) override {
    if (!std::exchange(any_live_, true))
      out_ << "\n# What may be changed while the process runs, by `priamos param`:\n";
    out_ << fmt::format("# {}: {}\n", key, LiveText(change));
  }

 protected:
  bool Enter(std::string_view key, std::string_view doc) override {
    prefixes_.push_back(prefixes_.back() + std::string(key));
    out_ << "\n# " << doc << "\n[" << prefixes_.back() << "]\n";
    prefixes_.back() += ".";
    return true;
  }
  void Leave() override { prefixes_.pop_back(); }
  std::size_t BeginList(std::string_view key, std::size_t default_size, std::string_view doc) override {
    out_ << "\n# [[" << prefixes_.back() << key << "]]: " << doc << "\n";
    return default_size;
  }
  void EnterItem(std::string_view key, std::size_t) override {
    prefixes_.push_back(prefixes_.back() + std::string(key));
    out_ << "[[" << prefixes_.back() << "]]\n";
    prefixes_.back() += ".";
  }

 private:
  void Line(std::string_view key, const std::string& value, std::string_view comment) {
    out_ << fmt::format("{:<40} # {}\n", fmt::format("{} = {}", key, value), comment);
  }

  std::ostream& out_;
  std::vector<std::string> prefixes_{""};
  bool any_live_ = false;
};

}  // namespace

std::unique_ptr<Archive> MakeConfigPrinter(std::ostream& out) {
  return std::make_unique<Printer>(out);
}

}  // namespace priamos
