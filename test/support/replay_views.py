"""Looks at a log on the page of the station: plays, pauses, seeks, and leaves a picture.

usage: replay_views.py URL FOLDER
"""
import sys
import time

from browser import Browser
from station_page import wait_for

URL, FOLDER = sys.argv[1], sys.argv[2]


def report(name, value):
    print(f"{name}: {value}", flush=True)


def position(browser):
    return float((browser.text("time") or "0").split(" / ")[0])


def main():
    browser = Browser()
    browser.call("Page.navigate", url=URL)
    wait_for(lambda: " / " in (browser.text("time") or ""), 8)
    report("paused at the beginning", position(browser) == 0)
    browser.click("play")
    report("plays", wait_for(lambda: position(browser) > 0.5, 4))
    browser.click("play")
    browser.run("(() => { const s = document.getElementById('position'); s.value = 12;"
                " s.dispatchEvent(new Event('change')); })()")
    report("seeks", wait_for(lambda: 11.9 < position(browser) < 12.6, 4))
    report("states after a seek", wait_for(lambda: "passing" in browser.text("mission-text"), 2))
    browser.click("play")
    browser.click("show-space")
    browser.click("show-plots")
    field = "[...document.querySelectorAll('.fields details[data-channel=POSE] button')].find((b) => b.textContent === 'x_m')"
    wait_for(lambda: browser.run(f"{field} !== undefined"), 4)
    browser.run(f"{field}.click()")
    time.sleep(1.5)
    value = browser.run("parseFloat(document.querySelector('.chart output').textContent)")
    report("plots the log's numbers", value > 4)
    browser.picture(FOLDER + "/replay-plots.png")
    browser.click("show-space")
    report("space is drawn", browser.bytes_of("space") > 8000)
    browser.picture(FOLDER + "/replay-space.png")
    browser.click("show-plan")
    time.sleep(0.5)
    browser.picture(FOLDER + "/replay.png")
    report("complaints", browser.complaints)
    browser.close()


main()
