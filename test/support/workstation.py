"""A page at one of two workstations of a robot, run on that computer: the first drives, and the second may only ask.

usage: workstation.py first|second PORT FOLDER   (prints what it saw; files in FOLDER tell the other one)
"""
import pathlib
import sys
import time

from station_page import Page, wait_for

CONSOLE = 2  # lease_request_t
role, folder = sys.argv[1], pathlib.Path(sys.argv[3])
page = Page(int(sys.argv[2]))


def sees_the_robot():
    return all(page.ages.get(channel, 99) < 2 for channel in ("POSE", "DRIVE_STATUS"))


def phase():
    return page.station["phase"]


def holder():
    status = page.messages["DRIVE_STATUS"]
    return status["driver"], status["session"]


def own_lease():
    return holder() == (CONSOLE, page.station["session"])


def press(condition, buttons=None, tries=5):
    """Pushes the stick, from rest, until the condition holds. A slow machine loses the hand now and then."""
    for _ in range(tries):
        page.let_go()
        time.sleep(0.3)
        page.buttons = buttons or {}
        page.push(0.3)
        if wait_for(condition, 3):
            return True
    return False


print(role, "sees the robot:", wait_for(sees_the_robot, 15), flush=True)
if role == "first":
    print("first drives:", press(lambda: phase() == "driving" and own_lease()))
    (folder / "drives").touch()
    wait_for((folder / "asked").exists, 20)
    print("first kept the lease:", own_lease())
    (folder / "kept").touch()
    print("first is told who has it now:", wait_for(lambda: holder()[0] == CONSOLE and not own_lease(), 15))
    page.let_go()
else:
    wait_for((folder / "drives").exists, 25)
    print("second asks:", press(lambda: phase() == "asking" and holder()[0] == CONSOLE and not own_lease()))
    print("second drives unasked:", wait_for(lambda: phase() == "driving" or own_lease(), 1.5))
    (folder / "asked").touch()
    wait_for((folder / "kept").exists, 10)
    print("second takes over:", press(own_lease, {"take_over": True}))
    time.sleep(1.5)
page.close()
