#include "cli/verbs/help/completion.hpp"

#include <CLI/App.hpp>
#include <algorithm>
#include <iostream>
#include <tuple>

#include "bus/own_types.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/verbs/help/commands.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {
namespace {

const CLI::App* Subcommand(const CLI::App& app, const std::string& name) {
  for (const auto* sub : app.get_subcommands([](const CLI::App*) { return true; }))
    if (sub->get_name() == name) return sub;
  return nullptr;
}

const CLI::Option* OptionNamed(const CLI::App& app, const std::string& name) {
  return name.starts_with("-") ? app.get_option_no_throw(name) : nullptr;
}

bool TakesValue(const CLI::Option& option) {
  return option.get_expected_max() > 0 && option.get_type_size() > 0;
}

std::vector<std::string> ChannelNames() {
  std::vector<std::string> names;
  std::apply([&](const auto&... channel) { (names.emplace_back(channel.name), ...); }, channels::kAll);
  return names;
}

std::vector<std::string> TypeNames() {
  std::vector<std::string> names;
  const auto schema = bus::OwnTypes();
  for (const auto* type : schema.All()) names.push_back(type->name);
  return names;
}

/// The values a CLI::IsMember names: its description is "{a,b,c}".
std::vector<std::string> Members(const CLI::Option& option) {
  const std::string text = option.get_type_name();
  const auto begin = text.find('{'), end = text.find('}');
  std::vector<std::string> members;
  if (begin == std::string::npos || end == std::string::npos) return members;
  std::istringstream list(text.substr(begin + 1, end - begin - 1));
  for (std::string word; std::getline(list, word, ',');) members.push_back(word);
  return members;
}

std::vector<std::string> ValuesOf(const CLI::Option& option) {
  const std::string& name = option.get_single_name();
  if (name == "channel" || name == "channels" || name == "without") return ChannelNames();
  if (name == "type") return TypeNames();
  return Members(option);
}

std::vector<std::string> Names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const auto* sub : app.get_subcommands([](const CLI::App*) { return true; }))
    if (!sub->get_group().empty()) names.push_back(sub->get_name());
  for (const auto* option : app.get_options())
    for (const auto& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// The n-th argument without a dash; the last one again when it takes many.
const CLI::Option* Positional(const CLI::App& app, std::size_t n) {
  std::vector<const CLI::Option*> all;
  for (const auto* option : app.get_options())
    if (option->get_positional()) all.push_back(option);
  if (all.empty()) return nullptr;
  if (n < all.size()) return all[n];
  return all.back()->get_expected_max() > 1 ? all.back() : nullptr;
}

}  // namespace

std::vector<std::string> Completions(const CLI::App& cli, const std::vector<std::string>& words) {
  const CLI::App* app = &cli;
  const CLI::Option* waiting = nullptr;  ///< its value comes next
  std::size_t positionals = 0;
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    if (waiting != nullptr) {
      waiting = nullptr;
    } else if (const auto* option = OptionNamed(*app, words[i])) {
      waiting = TakesValue(*option) ? option : nullptr;
    } else if (const auto* sub = Subcommand(*app, words[i])) {
      app = sub;
      positionals = 0;
    } else if (!words[i].starts_with("-")) {  // an option with its value in the same word is no argument
      ++positionals;
    }
  }
  const std::string last = words.empty() ? "" : words.back();
  std::vector<std::string> all;
  if (waiting != nullptr) {
    all = ValuesOf(*waiting);
  } else {
    if (const auto* argument = Positional(*app, positionals); argument && !last.starts_with("-"))
      all = ValuesOf(*argument);
    // Options are offered for a dash, or where nothing else could stand.
    if (last.starts_with("-") || (all.empty() && Positional(*app, positionals) == nullptr)) all = Names(*app);
  }
  std::sort(all.begin(), all.end());
  std::erase_if(all, [&](const std::string& name) { return !name.starts_with(last); });
  return all;
}

std::string BashCompletion() {
  return R"shell(_priamos() {
  local IFS=$'\n'
  COMPREPLY=($("${COMP_WORDS[0]}" completion words -- "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null))
}
complete -o default -F _priamos priamos
)shell";
}

/// Script for zsh; calls `_files` when there is no word of ours, as bash does it by `-o default`.
std::string ZshCompletion() {
  return R"shell(#compdef priamos
_priamos() {
  local -a candidates
  candidates=("${(@f)$("${(Q)words[1]}" completion words -- "${(@Q)words[2,CURRENT]}" 2>/dev/null)}")
  if [[ -n "${candidates[1]}" ]]; then
    compadd -a candidates
  else
    _files
  fi
}
if [[ "${funcstack[1]}" = _priamos ]]; then
  _priamos "$@"
else
  compdef _priamos priamos
fi
)shell";
}

std::string FishCompletion() {
  return R"shell(function __priamos_words
  set -l words (commandline -opc) (commandline -ct)
  $words[1] completion words -- $words[2..-1] 2>/dev/null
end
function __priamos_has_words
  test -n "$(__priamos_words)"
end
complete -c priamos -n __priamos_has_words -f -a '(__priamos_words)'
)shell";
}

namespace {

void AddShell(CLI::App& verb, const std::string& shell, std::string (*script)(), const std::string& example,
              int& exit_code) {
  auto* sub =
      AddVerb(verb, shell, "Print what makes " + shell + " complete verbs, options, channels and types.");
  sub->footer("Example: " + example);
  sub->callback([script, &exit_code] {
    std::cout << script();
    exit_code = 0;
  });
}

}  // namespace

void AddCompletionCommand(CLI::App& cli, int& exit_code) {
  auto* verb = AddVerb(cli, "completion", "Completion for a shell.");
  verb->require_subcommand(1);
  AddShell(*verb, "bash", BashCompletion, "priamos completion bash >> ~/.bashrc", exit_code);
  AddShell(*verb, "zsh", ZshCompletion, "priamos completion zsh >> ~/.zshrc, below compinit", exit_code);
  AddShell(*verb, "fish", FishCompletion, "priamos completion fish > ~/.config/fish/completions/priamos.fish",
           exit_code);
  auto words = std::make_shared<std::vector<std::string>>();
  auto* ask = AddVerb(*verb, "words", "What the shells ask.");
  ask->group("");
  ask->add_option("words", *words, "the command line so far");
  ask->callback([&cli, words, &exit_code] {
    for (const auto& name : Completions(cli, *words)) std::cout << name << "\n";
    exit_code = 0;
  });
}

}  // namespace priamos::cli
