#include "bus/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>

#include "bus/version.hpp"
#include "common/text/nearest_file.hpp"
#include "common/text/nearest_word.hpp"
#include "common/text/number_text.hpp"

namespace priamos::bus {
namespace {

std::vector<std::string> VerbNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const auto* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    if (!verb->get_group().empty()) names.push_back(verb->get_name());
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> OptionNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const auto* option : app.get_options()) {
    for (const auto& name : option->get_lnames()) names.push_back("--" + name);
    for (const auto& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

bool HasPositional(const CLI::App& app) {
  const auto options = app.get_options();
  return std::any_of(options.begin(), options.end(), [](const auto* o) { return o->get_positional(); });
}

/// The program, its verb, the verb of that, as far as they were understood.
std::vector<const CLI::App*> Chain(const CLI::App& cli) {
  std::vector<const CLI::App*> chain{&cli};
  while (!chain.back()->get_subcommands().empty()) chain.push_back(chain.back()->get_subcommands().front());
  return chain;
}

std::string Hint(const CLI::App& app) {
  return fmt::format(" ({} --help lists all)", FullName(app));
}

/// Verbs of verbs that have the name `word`: for `priamos list` it is `topic list`.
std::vector<std::string> DeeperVerbs(const CLI::App& app, const std::string& word) {
  std::vector<std::string> found;
  for (const auto* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    for (const std::string& name : VerbNames(*verb))
      if (name == word) found.push_back(verb->get_name() + " " + name);
  return found;
}

std::string UnknownVerb(const CLI::App& app, const std::string& word) {
  std::string nearest = NearestText(word, VerbNames(app));
  if (const auto deeper = DeeperVerbs(app, word); nearest.empty() && !deeper.empty())
    nearest = fmt::format("; nearest: \"{}\"", fmt::join(deeper, "\" or \""));
  return fmt::format("{}: unknown verb \"{}\"{}{}", FullName(app), word, nearest, Hint(app));
}

std::string UnknownOption(const CLI::App& app, const std::string& word, const CLI::App& deepest) {
  const std::string name = word.substr(0, word.find('='));
  if (&deepest != &app && deepest.get_option_no_throw(name) != nullptr)
    return fmt::format("{}: unknown option \"{}\"; it belongs behind the verb: {} {}", FullName(app), name,
                       FullName(deepest), name);
  return fmt::format("{}: unknown option \"{}\"{}{}", FullName(app), name,
                     NearestText(name, OptionNames(app)), Hint(app));
}

/// A word that nothing took.
std::string Unknown(const CLI::App& app, const std::string& word, const CLI::App& deepest) {
  if (word.size() > 1 && word.front() == '-') return UnknownOption(app, word, deepest);
  if (!VerbNames(app).empty()) return UnknownVerb(app, word);
  return fmt::format("{}: expected {}, got \"{}\"{}", FullName(app),
                     HasPositional(app) ? "no further argument" : "no argument", word, Hint(app));
}

/// The option that an error of CLI11 names; the longest name wins.
const CLI::Option* OptionIn(const CLI::App& app, const std::string& text) {
  const CLI::Option* found = nullptr;
  for (const auto* option : app.get_options()) {
    const std::string name = option->get_name();
    if (text.find(name) == std::string::npos) continue;
    if (found == nullptr || name.size() > found->get_name().size()) found = option;
  }
  return found;
}

/// Between `open` and `close` of CLI11's description of a type, e.g. of "FLOAT in [0 - 1]".
std::optional<std::string> Between(const std::string& text, const std::string& open,
                                   const std::string& close) {
  const auto begin = text.find(open);
  if (begin == std::string::npos) return std::nullopt;
  const auto end = text.find(close, begin + open.size());
  return end == std::string::npos
             ? std::nullopt
             : std::optional(text.substr(begin + open.size(), end - begin - open.size()));
}

std::vector<std::string> Members(const CLI::Option& option) {
  std::vector<std::string> members;
  std::istringstream list(Between(option.get_type_name(), "{", "}").value_or(""));
  for (std::string word; std::getline(list, word, ',');) members.push_back(word);
  return members;
}

/// What an option of whole numbers takes; CLI11 calls an int INT, and a std::uint64_t UINT.
std::string WholeNumber(bool is_unsigned, bool is_positive, bool is_negative_refused) {
  const int lowest = is_positive                          ? 1
                     : is_unsigned || is_negative_refused ? 0
                                                          : std::numeric_limits<int>::min();
  const std::uint64_t highest = is_unsigned ? std::numeric_limits<std::uint64_t>::max()
                                            : std::uint64_t{std::numeric_limits<int>::max()};
  return fmt::format("a whole number, {} to {}", lowest, highest);
}

std::string Expected(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const auto has = [&](const char* word) { return type.find(word) != std::string::npos; };
  std::string number = has("INT") ? "a whole number" : "a number";
  if (const auto members = Members(option); !members.empty())
    return fmt::format("one of {}", fmt::join(members, ", "));
  if (auto range = Between(type, " in [", "]")) {
    const auto dash = range->find(" - ");
    return fmt::format("{}, {} to {}", number, range->substr(0, dash), range->substr(dash + 3));
  }
  if (has("INT")) return WholeNumber(has("UINT"), has("POSITIVE"), has("NONNEGATIVE"));
  if (has("POSITIVE")) return number + " above 0";
  if (has("NONNEGATIVE")) return number + ", at least 0";
  if (has("FLOAT")) return number;
  if (has("FILE")) return "an existing file";
  if (has("DIR")) return "an existing folder";
  if (has("PATH")) return "an existing file or folder";
  return "a value";
}

std::string BadValue(const CLI::App& app, const CLI::Option& option) {
  const std::string got = fmt::format("{}", fmt::join(option.results(), " "));
  if (got.empty() && option.get_positional())
    return fmt::format("{}: expected {} ({}), got \"\"{}", FullName(app), option.get_name(),
                       option.get_description(), Hint(app));
  const std::string type = option.get_type_name();
  const auto is = [&](const char* kind) { return type.find(kind) != std::string::npos; };
  const bool is_path = is("FILE") || is("DIR") || is("PATH");
  std::error_code none;  // a file where a folder is expected is there, and no other name is meant
  const bool is_there = is_path && std::filesystem::exists(got, none);
  return fmt::format("{}: {}: expected {}, got \"{}\"{}", FullName(app), option.get_name(), Expected(option),
                     got,
                     is_there  ? ""
                     : is_path ? NearestFileText(got, ".lcmlog")
                               : NearestText(got, Members(option)));
}

std::string WrongCount(const CLI::App& app, const CLI::Option& option) {
  const int wanted = option.get_items_expected_min();
  const int most = std::max(1, option.get_items_expected_max());
  if (const int given = static_cast<int>(option.results().size()); given > most)
    return fmt::format("{}: {} is given {}; next: leave one", FullName(app), option.get_name(),
                       given == 2 * most ? "twice" : "more than once");
  const std::string what = wanted == 1 ? Expected(option) : fmt::format("{} values", wanted);
  const std::string got = option.results().empty() ? "none" : std::to_string(option.results().size());
  return fmt::format("{}: {}: expected {}, got {}{}", FullName(app), option.get_name(), what, got, Hint(app));
}

std::string Missing(const CLI::App& app) {
  for (const auto* option : app.get_options())
    if (option->get_required() && option->count() == 0)
      return fmt::format("{}: expected {} ({}), got none{}", FullName(app), option->get_name(),
                         option->get_description(), Hint(app));
  return fmt::format("{}: expected a verb, got none; one of {}{}", FullName(app),
                     fmt::join(VerbNames(app), ", "), Hint(app));
}

/// CLI11 takes -1 for the largest number, 010 for eight, and 0x for nothing.
template <class T>
std::string CheckWhole(std::string& text) {
  const auto number = NumberOf<T>(text);
  if (!number) return "not a whole number";
  text = std::to_string(*number);
  return "";
}

std::string CheckFinite(std::string& text) {
  const auto number = NumberOf<double>(text);
  return number && std::isfinite(*number) ? "" : "not a number";
}

std::string CheckNotEmpty(const std::string& text) {
  return text.empty() ? "nothing" : "";
}

/// Adds the checks of values to all options of a program, in one place, so that no verb can forget them.
void GuardValues(CLI::App& app) {
  for (auto* option : app.get_options()) {
    const std::string type = option->get_type_name();
    if (option->get_items_expected_max() == 0) continue;  // a flag
    if (type.starts_with("UINT")) option->transform(CLI::Validator(CheckWhole<std::uint64_t>, ""));
    if (type.starts_with("INT")) option->transform(CLI::Validator(CheckWhole<std::int64_t>, ""));
    if (type.starts_with("FLOAT")) option->transform(CLI::Validator(CheckFinite, ""));
    if (type.starts_with("TEXT")) option->check(CheckNotEmpty);
  }
  for (auto* verb : app.get_subcommands([](CLI::App*) { return true; })) GuardValues(*verb);
}

}  // namespace

const CLI::App& ChosenVerb(const CLI::App& cli) {
  return *Chain(cli).back();
}

std::string FullName(const CLI::App& verb) {
  return verb.get_parent() == nullptr ? verb.get_name()
                                      : FullName(*verb.get_parent()) + " " + verb.get_name();
}

std::string HelpOf(const CLI::App& verb) {
  return verb.get_formatter()->make_help(&verb, FullName(verb), CLI::AppFormatMode::Normal);
}

std::string Explain(const CLI::App& cli, const CLI::Error& error) {
  const auto chain = Chain(cli);
  const CLI::App& deepest = *chain.back();
  for (const auto* app : chain)
    if (const auto left = app->remaining(); !left.empty()) return Unknown(*app, left.front(), deepest);
  const std::string kind = error.get_name(), text = error.what();
  if (kind == "RequiredError") return Missing(deepest);
  const CLI::Option* option = OptionIn(deepest, text);
  if (option != nullptr && (kind == "ValidationError" || kind == "ConversionError"))
    return BadValue(deepest, *option);
  if (option != nullptr && kind == "ArgumentMismatch") return WrongCount(deepest, *option);
  return fmt::format("{}: {}", FullName(deepest), text);
}

std::optional<int> ParseCommandLine(CLI::App& cli, int argc, char** argv) {
  cli.set_version_flag("--version", fmt::format("{} {}", cli.get_name(), Version()),
                       "print the version and exit");
  GuardValues(cli);
  try {
    cli.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::Success& answered) {
    return cli.exit(answered);
  } catch (const CLI::Error& error) {
    std::cerr << Explain(cli, error) << "\n";
  }
  return kCannotStart;
}

}  // namespace priamos::bus
