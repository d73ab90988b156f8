"""An operator's drive commands on the offboard bus: drive_commands.py COUNT [--kept S] [--requests].

One every 50 ms, numbered from 1, stamped when it is made and put on the bus S seconds later; with --requests a
LOOK_REQUEST beside every 40th.
"""

import argparse
import collections
import pathlib
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "bus/python"))

import priamos_bus as bus  # noqa: E402

PERIOD_S = 0.05


def made(schema, number, requests):
    """(channel, type, message) of the moment."""
    kinds = [("DRIVE_COMMAND", "drive_command_t", {"sequence": number, "time_to_live_s": 0.25})]
    if requests and number % 40 == 0:
        kinds.append(("LOOK_REQUEST", "look_request_t", {"request_id": number // 40}))
    utime = time.time_ns() // 1000
    return [(channel, name, bus.filled(schema.find(name), fields, utime)) for channel, name, fields in kinds]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("count", type=int)
    parser.add_argument("--kept", type=float, default=0)
    parser.add_argument("--requests", action="store_true")
    options = parser.parse_args()
    schema = bus.Schema(bus.own_types())
    kept, begin, number = collections.deque(), time.monotonic(), 0
    with bus.Bus(bus.bus_url("offboard"), schema) as offboard:
        while number < options.count or kept:
            now = time.monotonic()
            if number < options.count and now >= begin + number * PERIOD_S:
                number += 1
                kept.append((now + options.kept, made(schema, number, options.requests)))
            while kept and now >= kept[0][0]:
                for channel, name, message in kept.popleft()[1]:
                    offboard.publish(channel, name, message)
            time.sleep(0.002)


main()
