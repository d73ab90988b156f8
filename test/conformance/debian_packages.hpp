#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace priamos {

/// What dpkg knows of the packages of this machine. Asks no network.
class DebianPackages {
 public:
  /// Reads dpkg's database; throws std::runtime_error where there is none.
  DebianPackages();
  /// For tests: `text` is one package a line, tab separated: name, "yes" when essential, provides, depends.
  explicit DebianPackages(const std::string& text);

  /// What is installed once apt has installed `names` without recommendations on a bare system. Of
  /// alternatives the first that is installed here counts.
  std::set<std::string> Closure(const std::vector<std::string>& names) const;

  /// The packages that each of `paths` belongs to; of a path that is in none, nothing.
  static std::map<std::string, std::set<std::string>> OwnersOf(const std::set<std::string>& paths);

 private:
  struct Package {
    bool essential = false;
    std::vector<std::vector<std::string>> depends;  ///< of each, one of the alternatives
  };
  std::vector<std::string> Resolve(const std::vector<std::string>& alternatives) const;

  std::map<std::string, Package> packages_;
  std::map<std::string, std::vector<std::string>> providers_;
};

}  // namespace priamos
