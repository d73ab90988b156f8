"""Does what modules/console/TUTORIAL.md says: types its commands and follows the comments `<!-- test: ... -->` behind its steps.

usage: tutorial.py TUTORIAL FOLDER    pictures go to FOLDER; the station is up already
"""
import re
import subprocess
import sys
import time

from browser import Browser
from station_page import wait_for

TUTORIAL, FOLDER = sys.argv[1], sys.argv[2]
ALREADY_DONE = "scripts/demo --interactive"  # builds and brings up; the demo itself has a test
STAYS = "replay show"


class Reader:
    def __init__(self):
        self.browser, self.staying, self.steps, self.failed = None, [], 0, []

    def command(self, text):
        if text == ALREADY_DONE or text.startswith("export "):
            return
        if STAYS in text:
            self.staying.append(subprocess.Popen(text.split(), stdout=subprocess.DEVNULL))
            return
        done = subprocess.run(["bash", "-c", text], capture_output=True, text=True, timeout=60)
        if done.returncode != 0:
            self.failed.append(f"{text}: {done.returncode} {done.stderr}")

    def step(self, verb, *words):
        self.steps += 1
        if not getattr(self, "do_" + verb)(*words):
            self.failed.append(" ".join((verb, *words)))

    def do_open(self, url):
        if self.browser is None:
            self.browser = Browser()
        return wait_for(lambda: "errorText" not in self.browser.call("Page.navigate", url=url), 10)

    def do_wait(self, element, words, seconds):
        find = f"document.querySelector('{element if element.startswith('.') else '#' + element}')?.innerText ?? ''"
        return wait_for(lambda: any(w in self.browser.run(find) for w in words.replace("_", " ").split("|")), float(seconds))

    def do_unfold(self, *selector):
        """Opens a part of the page that is folded."""
        found = f"document.querySelector('{' '.join(selector)}')"
        return self.browser.run(f"(() => {{ const e = {found}; if (e === null) return false; e.open = true; e.scrollIntoView(); return true; }})()")

    def do_press(self, selector, label):
        """A button without a name, by what is written on it, as soon as it can be pressed."""
        button = (f"[...document.querySelectorAll('{selector} button')].find((b) => b.textContent.startsWith('{label.replace('_', ' ')}')"
                  " && !b.hidden && !b.disabled)")
        there = wait_for(lambda: self.browser.run(f"{button} !== undefined"), 10)
        self.browser.run(f"{button}?.click()")
        return there

    def do_click(self, element):
        there = self.browser.run(f"(() => {{ const e = document.getElementById('{element}'); return e !== null && !e.disabled; }})()")
        self.browser.click(element)
        return there

    def do_down(self, code, key=" "):
        self.browser.key("down", code, key)
        return True

    def do_up(self, code, key=" "):
        self.browser.key("up", code, key)
        return True

    def _place(self, element, x, y):
        return self.browser.run(f"(() => {{ const r = document.getElementById('{element}').getBoundingClientRect();"
                                f" return [r.x + {x} * r.width, r.y + {y} * r.height]; }})()")

    def do_hold(self, element, seconds):
        x, y = self._place(element, 0.5, 0.5)
        self.browser.mouse("mousePressed", x, y)
        gone = wait_for(lambda: self.browser.run("document.getElementById('stopped').hidden"), float(seconds))
        self.browser.mouse("mouseReleased", x, y)
        return gone

    def do_drag(self, element, x1, y1, x2, y2):
        self.browser.mouse("mousePressed", *self._place(element, x1, y1))
        for action in ("mouseMoved", "mouseReleased"):
            self.browser.mouse(action, *self._place(element, x2, y2))
        return True

    def do_field(self, channel, field):
        button = f"[...document.querySelectorAll('.fields details[data-channel={channel}] button')].find((b) => b.textContent === '{field}')"
        there = wait_for(lambda: self.browser.run(f"{button} !== undefined"), 5)
        self.browser.run(f"{button}.closest('details').open = true; {button}.click()")
        return there

    def do_sleep(self, seconds):
        time.sleep(float(seconds))
        return True

    def do_picture(self, name):
        self.browser.picture(f"{FOLDER}/{name}.png")
        return True

    def end(self):
        if self.browser is not None:
            self.browser.close()
        for process in self.staying:
            process.terminate()
            process.wait()


def main():
    text = open(TUTORIAL, encoding="utf-8").read()
    reader = Reader()
    pictures = set(re.findall(r"\(tutorial/(\w+)\.png\)", text))
    taken = set(re.findall(r"picture (\w+)", text))
    try:
        for command, steps in re.findall(r"```sh\n(.*?)\n```|<!-- test: (.*?) -->", text, re.S):
            if command:
                reader.command(command)
            for step in steps.split(";") if steps else []:
                reader.step(*step.split())
    finally:
        reader.end()
    print(f"steps: {reader.steps}, failed: {reader.failed}, pictures without a step: {sorted(pictures - taken)}")


main()
