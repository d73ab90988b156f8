"""Sees the robot and orders it as Foxglove does, beside `up sim`.

usage: foxglove_station.py PORT
"""
import sys
import time

from foxglove_client import Foxglove
from station_page import wait_for

PORT = int(sys.argv[1])
SCENE = {"/tf": "foxglove.FrameTransform", "/scene/plan": "foxglove.SceneUpdate", "/scene/robot": "foxglove.SceneUpdate",
         "/scene/path": "foxglove.SceneUpdate", "/sonars": "foxglove.PointCloud", "/scene/edges": "foxglove.SceneUpdate",
         "/edges": "foxglove.ImageAnnotations"}


def report(name, value):
    print(f"{name}: {value}", flush=True)


def refused(**arguments):
    try:
        Foxglove(PORT, **arguments)
    except ConnectionError as error:
        return " 403 " in str(error)
    return False


def same_place(client):
    """Whether the newest transform is at the newest pose."""
    transform, pose = client.newest.get("/tf"), client.newest.get("POSE")
    return transform and pose and transform["translation"]["x"] == pose["x_m"]


def path_lines(client):
    """The lines that the scene draws for the robot's path."""
    entities = client.newest.get("/scene/path", {}).get("entities", [])
    return [line for entity in entities for line in entity["lines"]]


def walls(client):
    """The boxes that the scene draws for the plan."""
    entities = client.newest.get("/scene/plan", {}).get("entities", [])
    return [cube for entity in entities for cube in entity["cubes"]]


def offered(client, topics):
    """Whether the server offers all of `topics` by now: it says who it is first, in a message of its own."""
    return wait_for(lambda: all(topic in client.channels for topic in topics), 5)


def main():
    client = Foxglove(PORT)
    report("says who it is", wait_for(lambda: client.info and client.info["name"] == "PRIAMOS", 2))
    report("topics are offered", offered(client, ["POSE", "DRIVE_STATUS", "MISSION_STATUS", "PATH", *SCENE]))
    report("schemas of the panels", all(client.channels[t]["schemaName"] == s for t, s in SCENE.items()))
    report("schema of a type", '"x_m"' in client.channels["POSE"]["schema"])
    client.subscribe("POSE", "DRIVE_STATUS", "MISSION_STATUS", "PATH", *SCENE)
    report("pose comes", wait_for(lambda: client.counts.get("POSE", 0) > 5, 5))
    report("and as a transform", wait_for(lambda: same_place(client), 5))
    report("plan comes", wait_for(lambda: len(walls(client)) > 3, 5))
    report("sonars are asked for over the radio", wait_for(lambda: len(client.newest.get("/sonars", {}).get("data", "")) > 0, 8))
    report("time goes on", wait_for(lambda: client.time is not None and client.time >= client.times["POSE"], 2))
    client.call("mission/goto", 1, x_m=3, y_m=2.4, yaw_rad=0, turn=False)
    report("an order is taken", wait_for(lambda: client.answers.get(1) == {"done": True}, 2))
    report("and obeyed", wait_for(lambda: "driving to" in client.newest.get("MISSION_STATUS", {}).get("text", ""), 5))
    report("path is drawn", wait_for(lambda: path_lines(client) != [], 5))
    client.call("mission/goto", 2, x_m="there")
    report("nonsense is refused", wait_for(lambda: "expected" in str(client.answers.get(2)), 2))
    client.ask_parameters(number="all")
    report("parameters are shown", wait_for(lambda: "robot/drive.blocked_s" in client.parameter_answers.get("all", {}), 10))
    client.set_parameter("robot/drive.blocked_s", 5, number="set")
    report("a parameter is changed through the radio", wait_for(lambda: client.parameter_answers.get("set") == {"robot/drive.blocked_s": 5}, 30))
    client.call("stop", 3)
    report("stop stops", wait_for(lambda: client.newest.get("DRIVE_STATUS", {}).get("estop"), 3))
    client.unsubscribe("/sonars")
    time.sleep(0.5)
    before = client.counts["/sonars"]
    time.sleep(1)
    report("nobody looks, nothing comes", client.counts["/sonars"] == before)
    report("a page of another origin", "refused" if refused(origin="https://evil.example") else "taken")
    report("warnings", client.status)
    client.close()


main()
