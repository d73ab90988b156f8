"""Runs cases of a GoogleTest program in one process, and reports each as if it had run by itself.

A case that ends the process or takes too long has failed, and the cases after it run in another process.
usage: run_cases.py PROGRAM REPORT LIMIT CASE...
REPORT: an XML file, whose head counts the cases as CTest's report counts its tests. LIMIT: seconds for each case.
With PRIAMOS_FAILED_ALONE in the environment only what failed in REPORT runs, each case in a process of its own; the
report of that is REPORT.again.
"""
import os
import pathlib
import signal
import sys
import xml.etree.ElementTree
from xml.sax.saxutils import quoteattr

from case_process import CaseProcess


class Outcome:
    """How one case ended: "passed", "failed", "skipped" or "disabled"; and what it said."""

    def __init__(self, state, reason="", text="", seconds=0.0):
        self.state, self.reason, self.text, self.seconds = state, reason, text, seconds


def run_together(program, limit_s, cases):
    """{case: Outcome} of all of them."""
    outcomes = {case: Outcome("disabled") for case in cases if "DISABLED_" in case}
    left = [case for case in cases if case not in outcomes]
    while left:
        process = CaseProcess(program, left, limit_s)
        outcomes.update(finished(process))
        if process.broken_by in left:
            outcomes[process.broken_by] = Outcome("failed", process.reason, process.text_of(process.broken_by))
        elif process.reason:
            outcomes.update(blamed(program, limit_s, left, process.reason))
        before = len(left)
        left = [case for case in left if case not in outcomes]
        if len(left) == before:
            outcomes.update({case: Outcome("failed", "the program did not run it") for case in left})
            left = []
    return outcomes


def finished(process):
    return {case: Outcome(state, "", process.text_of(case), process.seconds.get(case, 0.0))
            for case, state in process.states.items()}


def blamed(program, limit_s, cases, reason):
    """A process that ended badly with no case to blame: each for itself shows whose fault it is, or the last one has it."""
    outcomes = run_alone(program, limit_s, cases)
    if not any(outcome.state == "failed" for outcome in outcomes.values()):
        outcomes[cases[-1]] = Outcome("failed", f"{reason}; together with {', '.join(cases[:-1]) or 'nothing'} only")
    return outcomes


def run_alone(program, limit_s, cases):
    outcomes = {}
    for case in cases:
        process = CaseProcess(program, [case], limit_s)
        state = process.states.get(case, "failed")
        reason = process.reason or ("" if case in process.states else "the program did not run it")
        outcomes[case] = Outcome("failed" if reason else state, reason, process.text_of(case) or process.text,
                                 process.seconds.get(case, 0.0))
    return outcomes


def failed_in(report, cases):
    """What failed according to the report; everything when there is none."""
    try:
        root = xml.etree.ElementTree.parse(report).getroot()
    except (OSError, xml.etree.ElementTree.ParseError):
        return cases
    failed = {case.get("name") for case in root.iter("testcase") if case.find("failure") is not None}
    return [case for case in cases if case in failed]


def write_report(path, outcomes):
    def number(state):
        return sum(outcome.state == state for outcome in outcomes.values())

    lines = [f'<testsuite tests="{len(outcomes)}" failures="{number("failed")}" disabled="{number("disabled")}" '
             f'skipped="{number("skipped")}">']
    for case, outcome in outcomes.items():
        inside = f"<failure message={quoteattr(outcome.reason)}/>" if outcome.state == "failed" else ""
        lines.append(f'<testcase name={quoteattr(case)} status="{outcome.state}" time="{outcome.seconds:.3f}">{inside}</testcase>')
    path.parent.mkdir(parents=True, exist_ok=True)
    unfinished = path.with_name(path.name + ".new")
    unfinished.write_text("\n".join([*lines, "</testsuite>", ""]))
    os.replace(unfinished, path)


def show(outcomes):
    """What failed, with what it said; then all names once more, so that nobody has to search."""
    failed = {case: outcome for case, outcome in outcomes.items() if outcome.state == "failed"}
    for case, outcome in failed.items():
        print(outcome.text.rstrip())
        if outcome.reason:
            print(f"{case}: {outcome.reason}")
    for case in failed:
        print(f"failed: {case}")
    print(f"{len(outcomes)} cases, {len(failed)} failed")
    return 1 if failed else 0


def main(program, report, limit_s, *cases):
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    report, limit_s = pathlib.Path(report), float(limit_s)
    if os.environ.get("PRIAMOS_FAILED_ALONE"):
        outcomes = run_alone(program, limit_s, failed_in(report, cases))
        report = report.with_name(report.name + ".again")
    else:
        os.nice(5)  # what keeps real time runs beside it
        outcomes = run_together(program, limit_s, cases)
    write_report(report, outcomes)
    return show(outcomes)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
