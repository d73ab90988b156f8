#include "debian_packages.hpp"

#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "test/support/shell.hpp"

namespace priamos {
namespace {

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
  return parts;
}

/// "libc6:any (>= 2.36)" is about libc6.
std::string NameOf(const std::string& relation) {
  std::istringstream in(relation);
  std::string name;
  in >> name;
  return name.substr(0, name.find(':'));
}

std::string Database() {
  const ShellAnswer answer =
      RunShell(R"(dpkg-query -W -f '${Package}\t${Essential}\t${Provides}\t${Pre-Depends}, ${Depends}\n')");
  if (answer.exit_code != 0) throw std::runtime_error("dpkg-query: " + answer.text);
  return answer.text;
}

/// Names by which dpkg may know a file: Debian moved /lib into /usr/lib, and dpkg still knows it by its old
/// name.
std::set<std::string> NamesOf(const std::string& path) {
  std::error_code none;
  std::set<std::string> names{path, std::filesystem::canonical(path, none)};
  for (const std::string& name : std::set(names))
    if (name.starts_with("/usr/")) names.insert(name.substr(4));
  return names;
}

}  // namespace

DebianPackages::DebianPackages() : DebianPackages(Database()) {}

DebianPackages::DebianPackages(const std::string& text) {
  for (const std::string& line : Split(text, '\n')) {
    auto fields = Split(line, '\t');
    fields.resize(4);
    Package& package = packages_[fields[0]];
    package.essential = fields[1] == "yes";
    for (const std::string& name : Split(fields[2], ',')) providers_[NameOf(name)].push_back(fields[0]);
    for (const std::string& clause : Split(fields[3], ',')) {
      std::vector<std::string> alternatives;
      for (const std::string& one : Split(clause, '|'))
        if (const std::string name = NameOf(one); !name.empty()) alternatives.push_back(name);
      package.depends.push_back(alternatives);
    }
  }
}

std::vector<std::string> DebianPackages::Resolve(const std::vector<std::string>& alternatives) const {
  for (const std::string& name : alternatives) {
    if (packages_.contains(name)) return {name};
    if (const auto at = providers_.find(name); at != providers_.end()) return at->second;
  }
  return {};
}

std::set<std::string> DebianPackages::Closure(const std::vector<std::string>& names) const {
  std::vector<std::string> open = names;
  open.emplace_back("apt");
  for (const auto& [name, package] : packages_)
    if (package.essential) open.push_back(name);
  std::set<std::string> closure;
  while (!open.empty()) {
    const std::string name = open.back();
    open.pop_back();
    const auto at = packages_.find(name);
    if (at == packages_.end() || !closure.insert(name).second) continue;
    for (const auto& alternatives : at->second.depends)
      for (const std::string& next : Resolve(alternatives)) open.push_back(next);
  }
  return closure;
}

std::map<std::string, std::set<std::string>> DebianPackages::OwnersOf(const std::set<std::string>& paths) {
  std::map<std::string, std::set<std::string>> asked, owners;
  std::string command = "dpkg-query -S";
  for (const std::string& path : paths) {
    owners[path];
    for (const std::string& name : NamesOf(path)) {
      asked[name].insert(path);
      command += " '" + name + "'";
    }
  }
  for (const std::string& line : Split(RunShell(command).text, '\n')) {
    const auto colon = line.rfind(": ");
    if (colon == std::string::npos) continue;
    for (const std::string& path : asked[line.substr(colon + 2)])
      for (const std::string& owner : Split(line.substr(0, colon), ',')) owners[path].insert(NameOf(owner));
  }
  return owners;
}

}  // namespace priamos
