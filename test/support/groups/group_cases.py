"""Writes a script for CTest: the cases of a GoogleTest program in groups, of which each is one run of run_cases.py.

usage: group_cases.py PROGRAM FILTER NAME REPORTS LIMIT SCRIPT
FILTER: which cases, as for --gtest_filter. NAME_01, NAME_02 ... are the groups; each reports to a file of its name in the
folder REPORTS. LIMIT: seconds for a case.
"""
import os
import pathlib
import subprocess
import sys

# A start takes 0.1 s or more, so a group is many cases; a suite stays whole, because it may set up something once.
ENOUGH = 30


def suites_of(listing):
    """[[case, ...], ...] in the order of --gtest_list_tests: suites at the margin, their cases indented."""
    suites = []
    for line in listing.splitlines():
        name = line.split("#")[0].rstrip()  # behind it the type or value of a parameter
        if line.startswith("  ") and suites:
            suites[-1].append(suites[-1][0] + name.strip())
        elif name.endswith(".") and " " not in name:  # not a line that gtest_main says first
            suites.append([name])
    return [suite[1:] for suite in suites]


def groups_of(suites):
    groups = [[]]
    for suite in suites:
        if len(groups[-1]) >= ENOUGH or len(groups[-1]) + len(suite) > 2 * ENOUGH:
            groups.append([])
        groups[-1] += suite
    return [group for group in groups if group]


def entries(program, wanted, name, reports, limit):
    listed = subprocess.run([program, "--gtest_list_tests", f"--gtest_filter={wanted}"], stdout=subprocess.PIPE, text=True,
                            timeout=60, check=True)
    runner = pathlib.Path(__file__).resolve().parent / "run_cases.py"
    for number, group in enumerate(groups_of(suites_of(listed.stdout)), 1):
        title = f"{name}_{number:02}"
        command = ["/usr/bin/python3", "-B", runner, program, f"{reports}/{title}.xml", limit, *group]
        yield f"add_test({title} " + " ".join(f"[==[{word}]==]" for word in command) + ")\n"
        # Every case has its limit of time; this one is for a runner that hangs.
        yield f"set_tests_properties({title} PROPERTIES TIMEOUT 3600 ${{properties}})\n"


def main(*words):
    *what, script = words
    pathlib.Path(script + ".new").write_text("".join(entries(*what)))
    os.replace(script + ".new", script)


if __name__ == "__main__":
    main(*sys.argv[1:])
