"""Channel tables for the tests of the Python end."""

import json
import pathlib
import re

import priamos_bus as bus
from priamos_link import frames
from priamos_link.table import Channel, Table

ROOT = pathlib.Path(__file__).resolve().parents[3]

_CHANNELS = {
    "POSE": {"meaning": "1" * 16, "direction": "up", "class": "state", "fixed_bits": 83, "max_bits": 83},
    "PATH": {"meaning": "2" * 16, "direction": "down", "class": "event", "fixed_bits": 0, "max_bits": 800},
    "DRIVE": {"meaning": "3" * 16, "direction": "down", "class": "command", "fixed_bits": 40, "max_bits": 40,
              "ttl_us": 250000},
    "NOTE": {"meaning": "4" * 16, "direction": "down", "class": "event", "fixed_bits": 0, "max_bits": 200},
    "STOP": {"meaning": "5" * 16, "direction": "down", "class": "event", "fixed_bits": 16, "max_bits": 16, "urgent": True}}


def table_of(*names):
    """A table of these channels, in this order, on a line of 9600 baud."""
    channels = [{"name": name, "ttl_us": 0, "urgent": False, "delta": [], **_CHANNELS[name]} for name in names]
    data = {"encrypted": False, "code_bytes": 4, "baud": 9600, "bytes_per_s": 960, "table_hash": "0", "channels": channels}
    try:
        Table(json.dumps(data))
    except ValueError as error:
        data["table_hash"] = re.search(r"hash ([0-9a-f]{8})", str(error))[1]
    return Table(json.dumps(data))


def channel_of_stops():
    """ESTOP with its own type."""
    schema = bus.Schema([("estop_t.lcm", (ROOT / "lcmtypes/estop_t.lcm").read_text())])
    packer = bus.Packer(schema.find("estop_t"))
    return Channel("ESTOP", "0" * 16, frames.DOWN, "event", 0, packer.max_bits, 0, True, [], packer)
