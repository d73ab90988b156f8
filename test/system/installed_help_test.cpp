// What was installed beside the programs: completion in the three shells, and the manual.

#include <gmock/gmock.h>

#include "test/system/installed_test.hpp"

namespace priamos {
namespace {

using testing::HasSubstr;

class InstalledHelpTest : public InstalledTest {};

TEST_F(InstalledHelpTest, BashCompletes) {
  const auto answer = installed_.Run(R"(
    . "$PREFIX/share/bash-completion/completions/priamos"
    ask() { COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); COMPREPLY=(); _priamos; echo "${COMPREPLY[*]}"; }
    complete -p priamos
    ask priamos topic ec; ask priamos topic echo POSE_C; ask priamos run --sc)",
                                     20);
  EXPECT_EQ(answer.text, "complete -o default -F _priamos priamos\necho\nPOSE_CORRECTION\n--scenario\n");
}

/// Found by fish itself, in the folder for it.
TEST_F(InstalledHelpTest, FishCompletes) {
  const auto answer = installed_.Run(R"(
    export XDG_DATA_DIRS="$PREFIX/share:/usr/share"
    fish -c 'complete -C "priamos topic ec"; complete -C "priamos topic echo POSE_C"; complete -C "priamos run --sc"'
    : > a.lcmlog; fish -c 'complete -C "priamos log info a.l"')",
                                     20);
  EXPECT_EQ(answer.text, "echo\nPOSE_CORRECTION\n--scenario\na.lcmlog\n");
}

/// A zsh at a terminal, and the tab key.
TEST_F(InstalledHelpTest, ZshCompletes) {
  const auto answer = installed_.Run(R"zsh(
    cat > ask.zsh <<'END'
    zmodload zsh/zpty
    zpty shell zsh -f -i
    zpty -w shell "PS1='ready>'; fpath=('$PREFIX/share/zsh/site-functions' \$fpath); autoload -Uz compinit; compinit -u -D; echo be''gin"
    zpty -r -m shell text '*begin*ready>*' || exit 1
    zpty -w -n shell $'priamos topic echo POSE_C\t'
    zpty -r -m shell text '*POSE_CORRECTION*' && echo "completed"
    zpty -d shell
END
    PREFIX=$PREFIX timeout 20 zsh -f ask.zsh)zsh",
                                     30);
  EXPECT_THAT(answer.text, HasSubstr("completed"));
}

TEST_F(InstalledHelpTest, EveryPageOfTheManualIsSound) {
  const auto answer = installed_.Run(R"(
    export MANWIDTH=80 MANPATH=$PREFIX/share/man
    cd "$PREFIX/share/man"; pages=0
    for page in man?/*; do
      pages=$((pages + 1))
      mandoc -T lint -W warning "$page"
      man --warnings -l "$page" 2>&1 >/dev/null
      man -l "$page" 2>/dev/null | grep -q . || echo "$page is empty"
    done
    echo "$pages pages"
    for name in priamos-topic priamos-robot priamos-deployment priamos-verbs; do man -w "$name" > /dev/null || echo "no $name"; done
    man priamos-robot | grep -A 2 'max_speed_m_s' | head -n 3
    man priamos | grep -c PRIAMOS_DATA)",
                                     120);
  EXPECT_THAT(answer.text, testing::MatchesRegex("[3-9][0-9] pages\n.*max_speed_m_s = .*\\[m/s\\].*\n1\n"))
      << answer.text;
}

/// What the command line offers is what the manual says.
TEST_F(InstalledHelpTest, EveryVerbHasAPage) {
  const auto answer = installed_.Run(R"(
    priamos --help | sed -n '/^Subcommands:/,$s/^  \([a-z]*\) .*/\1/p' | while read -r verb; do
      [ -e "$PREFIX/share/man/man1/priamos-$verb.1" ] && echo found || echo "no page of $verb"
    done | sort | uniq -c)",
                                     20);
  EXPECT_THAT(answer.text, testing::MatchesRegex(" *[12][0-9] found\n"));
}

}  // namespace
}  // namespace priamos
