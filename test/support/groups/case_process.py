"""One process of a GoogleTest program that runs some of its cases, followed while it runs."""
import os
import pathlib
import re
import select
import signal
import subprocess
import tempfile
import time
import xml.etree.ElementTree

BEGIN = re.compile(rb"\[ RUN      \] (\S+)\r?$")  # perhaps behind what a case printed without an end of line
END = re.compile(rb"\[ +(OK|FAILED|SKIPPED) +\] (\S+?)(?:,| \()")
STATES = {b"OK": "passed", b"FAILED": "failed", b"SKIPPED": "skipped"}
LINGER_S = 60  # for processes that a case started and that still hold its output
KEPT = 100_000  # bytes of output per case


class CaseProcess:
    """Runs at once, to the end.

    states     {case: "passed", "failed" or "skipped"} of those that came to their end
    seconds    {case: float} of those that the program's own report names
    broken_by  the case during which the process ended or was ended, or None
    reason     why it ended otherwise than by its report and the exit code that belongs to it, or ""
    """

    def __init__(self, program, cases, limit_s):
        self.states, self.seconds, self.broken_by, self.reason = {}, {}, None, ""
        self._limit_s, self._texts, self._running, self._line = limit_s, {None: b""}, None, b""
        with tempfile.TemporaryDirectory(prefix="priamos-cases-") as folder:
            report = pathlib.Path(folder) / "report.xml"
            process = subprocess.Popen(
                [program, "--gtest_filter=" + ":".join(cases), f"--gtest_output=xml:{report}", "--gtest_color=no",
                 "--gtest_brief=0"], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                env=own_environment(), process_group=0)
            try:
                with process.stdout:
                    code = self._follow(process)
            except BaseException:  # who ends this ends the program as well
                end_group(process)
                raise
            self._judge(code, report, cases)

    def text_of(self, case):
        return self._texts.get(case, b"").decode(errors="replace")

    @property
    def text(self):
        """What was said outside of all cases."""
        return self.text_of(None)

    def _follow(self, process):
        """Reads until all who hold the output have closed it; the exit code, or None when that took too long."""
        self._began = time.monotonic()
        ended = None
        while True:
            if ended is None and process.poll() is not None:
                ended = time.monotonic()
            until = self._began + self._limit_s if ended is None else ended + LINGER_S
            left = until - time.monotonic()
            if left <= 0:
                self.reason = f"took longer than {self._limit_s:g} s" if ended is None else "left a process behind"
                end_group(process)
                return None
            if not select.select([process.stdout], [], [], min(left, 1))[0]:
                continue
            chunk = os.read(process.stdout.fileno(), 65536)
            if not chunk:
                return self._wait(process)
            self._hear(chunk)

    def _wait(self, process):
        """A program that closes its output may still run."""
        try:
            return process.wait(self._limit_s)
        except subprocess.TimeoutExpired:
            self.reason = f"took longer than {self._limit_s:g} s"
            end_group(process)
            return None

    def _hear(self, chunk):
        *lines, self._line = (self._line + chunk).split(b"\n")
        for line in lines:
            if begin := BEGIN.search(line):
                self._running, self._began = begin[1].decode(), time.monotonic()
            self._keep(line + b"\n")
            end = END.search(line)
            if end and end[2].decode() == self._running:
                self.states[self._running] = STATES[end[1]]
                if end[1] == b"OK":
                    self._texts.pop(self._running, None)
                self._running, self._began = None, time.monotonic()

    def _keep(self, text):
        self._texts[self._running] = (self._texts.get(self._running, b"") + text)[-KEPT:]

    def _judge(self, code, report, cases):
        if self._line:
            self._keep(self._line)
        if self._read(report, cases):
            expected = 1 if "failed" in self.states.values() else 0
            if code not in (expected, None):
                self.reason = f"{ending(code)} after its last case"
            return
        self.reason = self.reason or ending(code)
        self.broken_by = self._running

    def _read(self, report, cases):
        """What the program itself reports at its end is what counts."""
        try:
            root = xml.etree.ElementTree.parse(report).getroot()
        except (OSError, xml.etree.ElementTree.ParseError):
            return False
        for case in root.iter("testcase"):
            name = f'{case.get("classname")}.{case.get("name")}'
            if name not in cases or case.get("status") != "run":
                continue
            failed, skipped = case.find("failure") is not None, case.get("result") == "skipped"
            self.states[name] = "failed" if failed else "skipped" if skipped else "passed"
            self.seconds[name] = float(case.get("time") or 0)
        return True


def own_environment():
    """Without what would choose other cases or hide their beginnings."""
    return {name: value for name, value in os.environ.items()
            if not name.startswith("GTEST_") and name != "PRIAMOS_FAILED_ALONE"}


def end_group(process):
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass
    process.wait()


def ending(code):
    if code is not None and code < 0:
        return f"the process was ended by {signal.Signals(-code).name}"
    return f"the process ended with exit code {code}"
