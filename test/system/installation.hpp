#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "test/support/temporary_folder.hpp"
#include "test/system/private_network.hpp"

namespace priamos {

/// This build, installed below a prefix with a blank in a folder of its own, and stripped.
class Installation {
 public:
  explicit Installation(const std::string& prefix = "a prefix") : prefix_(prefix) {}
  std::filesystem::path folder() const { return folder_.path(); }
  std::filesystem::path prefix() const { return folder_ / prefix_; }
  std::filesystem::path package() const { return folder_ / "package"; }

  /// What `cmake --install` says, with a umask that lets nobody else read. Meanwhile /usr, /etc and the clone
  /// cannot be written, and the build's own note of what a person installed from it is another file.
  ShellAnswer Install() const {
    return Build(R"(umask 077; cmake --install "$BUILD" --strip --prefix "$PREFIX")");
  }
  /// Installs while an editor has files of config/ and of the manual open.
  ShellAnswer InstallWhileEditing() const {
    return Build(R"(
      for folder in config modules/cli/spy; do
        mkdir -p "$FOLDER/edited/$folder"; cp -r "$SOURCE/$folder/." "$FOLDER/edited/$folder"
        mount --bind "$FOLDER/edited/$folder" "$SOURCE/$folder"
      done
      for file in config/sim/world.toml config/robot/robot.toml config/sim/scenarios/door.toml modules/cli/spy/man1/priamos-spy.1; do
        here=$SOURCE/${file%/*} name=${file##*/}
        ln -s nobody@nowhere "$here/.#$name"; touch "$here/$name~" "$here/.$name.swp" "$here/#$name#" "$here/.auto.toml"
      done
      cmake --install "$BUILD" --prefix "$PREFIX")");
  }
  /// For /usr, as a package is made: into package() instead of the root of the file system.
  ShellAnswer InstallForAPackage() const {
    return Build(R"(DESTDIR="$FOLDER/package" cmake --install "$BUILD" --prefix /usr)");
  }
  ShellAnswer Uninstall() const { return Build(R"(cmake --build "$BUILD" --target uninstall)"); }
  /// By somebody who may not write below the prefix.
  ShellAnswer UninstallWithoutRights() const {
    return Build(R"(guard "$PREFIX"; cmake --build "$BUILD" --target uninstall)");
  }

  /// `script` as it runs on a machine that has the programs and nothing else of ours: in another folder, with
  /// an empty home and a network of its own; no clone, no header, no lcm-gen, no pkg-config; only the test's
  /// folder can be written. `$PREFIX/bin` is in the PATH.
  ShellAnswer Run(const std::string& script, int seconds) const {
    std::filesystem::create_directories(folder_ / "home");
    std::filesystem::create_directories(folder_ / "elsewhere");
    std::ofstream(folder_ / "inner.sh") << "set -u\nPREFIX='" << prefix().string() << "'\n" << script;
    return Script(R"sh(
      guard /usr; guard /etc
      for hidden in "$SOURCE" /usr/include; do mount -t tmpfs none "$hidden"; done
      for hidden in /usr/bin/lcm-gen /usr/bin/pkg-config; do
        [ ! -e $hidden ] || mount --bind /dev/null "$(readlink -f $hidden)"
      done
      cd "$FOLDER/elsewhere"
      exec env -i HOME="$FOLDER/home" PATH="$PREFIX/bin:/usr/bin:/bin:/usr/sbin:/sbin" LANG=C.UTF-8 bash "$FOLDER/inner.sh")sh",
                  seconds);
  }

  static std::string TextOf(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }

 private:
  ShellAnswer Build(const std::string& command) const {
    return Script(R"(
      for file in install_manifest.txt install_folders.txt; do
        touch "$FOLDER/$file" "$BUILD/$file"
        mount --bind "$FOLDER/$file" "$BUILD/$file"
      done
      for folder in "$SOURCE"/*; do [[ $BUILD/ = "$folder"/* ]] || guard "$folder"; done
      guard /usr; guard /etc
      )" + command,
                  120);
  }
  ShellAnswer Script(const std::string& script, int seconds) const {
    return RunInPrivateNetwork(
        "FOLDER='" + folder_.path().string() + "'\nPREFIX='" + prefix().string() +
            "'\nBUILD='" PRIAMOS_BINARY_DIR
            "'\n"
            "guard() { mount --bind \"$1\" \"$1\" && mount -o remount,bind,ro \"$1\"; }\n" +
            script,
        (folder_ / "outer.sh").string(), seconds, "unshare -rmn");
  }

  const TemporaryFolder folder_;
  const std::string prefix_;
};

}  // namespace priamos
