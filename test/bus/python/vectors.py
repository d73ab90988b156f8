"""Compares bus/python with vectors that C++ wrote: vectors.py FILE."""

import json
import pathlib
import sys

import priamos_bus as bus

ROOT = pathlib.Path(__file__).resolve().parents[3]
NOW_US = 1_800_000_000_000_000
schema = bus.Schema(bus.own_types() + bus.read_folder(ROOT / "test/bus/schema/foreign"))
assert not schema.problems, schema.problems


def same(what, got, expected):
    if got != expected:
        sys.exit(f"{what}: expected\n{expected}\ngot\n{got}")


def taken(struct, encoded):
    try:
        return bus.decode(struct, encoded)
    except bus.MessageError:
        return None


def packer_of(struct):
    try:
        return bus.Packer(struct), None
    except bus.SchemaError as error:
        return None, str(error)


def compare(vector):
    struct = schema.find(vector["type"])
    if "fingerprint" in vector:
        return same(vector["type"], struct.fingerprint, vector["fingerprint"])
    encoded = bytes.fromhex(vector["encoded"])
    message = taken(struct, encoded)
    same(f"{vector['type']}: taken", message is not None, vector["taken"])
    if message is None:
        return None
    form = bus.json_form(message)
    same(vector["type"], json.dumps(form), json.dumps(vector["json"]))
    again = bus.encode(struct, form)  # what is no number keeps its bits as C++ keeps them: not at all
    same(vector["type"], json.dumps(bus.json_form(bus.decode(struct, again))), json.dumps(form))
    packer, why = packer_of(struct)
    same(f"{vector['type']}: packed at all", packer is None, "unpackable" in vector)
    if packer is None:
        return same(vector["type"], why.rsplit("/", 1)[-1], vector["unpackable"].rsplit("/", 1)[-1])
    packed = packer.pack(encoded, NOW_US)
    same(f"{vector['type']}: packed {form}", packed.bytes.hex(), vector["packed"])
    same(vector["type"], (packed.saturated, packed.refused), (vector["saturated"], vector["refused"]))
    if not packed.refused:
        unpacked = bus.encode(struct, packer.unpack(packed.bytes, NOW_US + 5))
        same(f"{vector['type']}: unpacked", unpacked.hex(), vector["unpacked"])
    return None


lines = pathlib.Path(sys.argv[1]).read_text().splitlines()
for line in lines:
    compare(json.loads(line))
print(f"{len(lines)} messages, the same")
