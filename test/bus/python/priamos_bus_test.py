"""bus/python alone: what it refuses, hostile bytes, logs it writes itself, and lcm-gen's modules beside it."""

import importlib
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "bus/python"))

import priamos_bus as bus  # noqa: E402
from priamos_bus.lcm_text import parse_lcm  # noqa: E402
from priamos_bus.type_texts import MOST_BYTES_OF_TEXT, MOST_TYPES_OF_TEXT, TYPE_TEXT, TypeTexts  # noqa: E402

SCHEMA = bus.Schema(bus.own_types())
POSE = SCHEMA.find("pose_t")


def pose(**fields):
    return {field.name: 0 for field in POSE.fields} | fields


class Messages(unittest.TestCase):
    def test_what_is_missing_or_wrong_is_named(self):
        for message, sentence in ((pose(x=1), "priamos.pose_t.x: there is no such field"),
                                  (pose(x_m="far"), "priamos.pose_t.x_m: expected a number, got far"),
                                  (pose(utime=2**63), "priamos.pose_t.utime: expected a whole number from"),
                                  ({}, "priamos.pose_t.utime: the field is missing"), ([], "expected an object")):
            with self.assertRaisesRegex(bus.MessageError, sentence):
                bus.encode(POSE, message)

    def test_a_count_may_be_left_out(self):
        struct = bus.Schema([("t.lcm", "struct s { int8_t n; int16_t m; byte raw[n]; float grid[m][2]; }")]).find("s")
        message = {"raw": b"ab", "grid": [[1, 2], [3, 4.5], [0, 1]]}
        self.assertEqual(bus.decode(struct, bus.encode(struct, message)), {"n": 2, "m": 3, **message})

    def test_a_negative_count_is_refused_where_it_stands(self):
        struct = bus.Schema([("t.lcm", "struct s { int8_t n; int8_t m; byte raw[n][m]; }")]).find("s")
        for count, place in (((0, 255), 9), ((255, 0), 8)):
            with self.assertRaisesRegex(bus.MessageError, f"byte {place} of 10: the count of an array is negative"):
                bus.decode(struct, struct.fingerprint.to_bytes(8, "big") + bytes(count))

    def test_messages_of_billions_of_structs_without_bytes_are_refused(self):
        text = "struct c45_t {}" + "".join(f"struct c{i}_t {{ c{i + 1}_t a; c{i + 1}_t b; }}" for i in range(45))
        schema = bus.Schema([("t.lcm", text + "struct e_t {} struct wide_t { e_t x[2000000000]; }")])
        for name, taken in (("c0_t", False), ("c29_t", False), ("wide_t", False), ("c33_t", True), ("e_t", True)):
            struct = schema.find(name)
            data = struct.fingerprint.to_bytes(8, "big")
            if taken:
                bus.decode(struct, data)
            else:
                with self.assertRaisesRegex(bus.MessageError, "larger than the message"):
                    bus.decode(struct, data)

    def test_hostile_bytes_are_refused_in_one_sentence(self):
        dice = random.Random(1)
        for struct in SCHEMA.types.values():
            head = struct.fingerprint.to_bytes(8, "big")
            for size in (0, 1, 9, 40, 300):
                try:
                    bus.decode(struct, head + dice.randbytes(size))
                except bus.MessageError as error:
                    self.assertTrue(str(error).startswith(struct.full_name + ": byte "))
                    self.assertNotIn("\n", str(error))

    def test_what_is_no_packed_message_is_refused(self):
        packer = bus.Packer(POSE)
        packed = packer.pack(pose(utime=10**15, x_m=1), 10**15).bytes
        for wrong in (b"", packed[:-1], packed + b"\0", b"\xff" * len(packed)):
            with self.assertRaises(bus.MessageError):
                packer.unpack(wrong, 10**15)


class Types(unittest.TestCase):
    def test_one_type_that_cannot_be_used_leaves_the_others(self):
        schema = bus.Schema([("a.lcm", "struct good { int8_t n; } struct bad { nobody x; } struct worse { bad b; }")])
        self.assertEqual(list(schema.types), ["good"])
        self.assertEqual(schema.problems, ["a.lcm:1: bad.x: expected a type that is defined, got nobody",
                                           "a.lcm:1: worse.b: expected a type that can be used, got bad"])

    def test_hostile_texts_end(self):
        dice = random.Random(2)
        words = ["struct", "package", "{", "}", ";", "[", "]", "a", "int8_t", "const", "=", "3", ",", "// [m] @range", "/*", "\n"]
        for _ in range(300):
            text = " ".join(dice.choice(words) for _ in range(40))
            bus.Schema([("x.lcm", text)])
            parse_lcm("x.lcm", text, [])
        chain = "".join(f"struct t{i} {{ t{i + 1} x; }}\n" for i in range(1500)) + "struct t1500 { int8_t n; }"
        self.assertTrue(bus.Schema([("x.lcm", chain)]).problems)

    def test_modules_of_lcm_gen_have_the_same_fingerprints_and_bytes(self):
        with tempfile.TemporaryDirectory() as folder:
            files = sorted((ROOT / "lcmtypes").glob("*.lcm"))
            subprocess.run(["lcm-gen", "-p", "--ppath", folder, *map(str, files)], check=True)
            sys.path.insert(0, folder)
            for name, struct in SCHEMA.types.items():
                generated = getattr(importlib.import_module(name), struct.name)
                self.assertEqual(int.from_bytes(generated._get_packed_fingerprint(), "big"), struct.fingerprint)
                encoded = generated().encode()
                self.assertEqual(bus.encode(struct, bus.decode(struct, encoded)), encoded)
            sys.path.remove(folder)


class Logs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name) / "x.lcmlog"

    def write(self, n):
        with bus.LogWriter(self.path) as log:
            for i in range(n):
                log.write_message(10**15 + i, "POSE", POSE, pose(x_m=i))

    def test_what_it_wrote_it_reads(self):
        self.write(5)
        read = [(event.number, event.utime, message["x_m"]) for event, message in bus.Log(self.path).messages("POSE")]
        self.assertEqual(read, [(i, 10**15 + i, float(i)) for i in range(5)])
        self.assertEqual(list(bus.Log(self.path).messages("OTHER")), [])

    def test_every_event_but_the_damaged_one_is_read(self):
        self.write(20)
        whole, dice = self.path.read_bytes(), random.Random(3)
        for _ in range(30):
            data = bytearray(whole)
            data[dice.randrange(len(data))] ^= 1 << dice.randrange(8)
            self.path.write_bytes(data)
            log = bus.Log(self.path)
            self.assertGreaterEqual(sum(1 for _ in log), 18)
            self.assertLessEqual(log.damaged_places, 1)

    def test_what_is_no_log_has_no_events(self):
        for data in (b"", b"nonsense", random.Random(4).randbytes(5000), b"\xed\xa1\xda\x01" * 2000):
            self.path.write_bytes(data)
            log = bus.Log(self.path)
            self.assertEqual(list(log), [])
            self.assertEqual(log.skipped_bytes, len(data))

    def test_hostile_type_texts_do_no_harm(self):
        struct = SCHEMA.find("type_text_t")
        texts = [(0, 1, "struct {"), (5, 3, "x"), (-1, 1, "x"), (0, -1, "x"), (0, 30000, "x"), (0, 1, "struct s { s x; }")]
        with bus.LogWriter(self.path) as log:
            for part, parts, text in texts:
                message = {"utime": 0, "fingerprint": parts, "part": part, "parts": parts, "text": text}
                log.write_message(0, TYPE_TEXT, struct, message)
        self.assertEqual(len(list(bus.Log(self.path))), len(texts))

    def test_a_text_of_more_types_than_a_recorder_writes_is_not_read(self):
        chain = "".join(f"struct c{i}_t {{ c{i + 1}_t a; }}\n" for i in range(59)) + "struct c59_t { int8_t x; }\n"
        inner = bus.Schema([("t.lcm", chain)]).find("c0_t")
        more = "".join(f"struct m{i}_t {{}}" for i in range(MOST_TYPES_OF_TEXT))
        for text, types in ((chain, ["c0_t"]), (chain + more, []), (chain + " " * MOST_BYTES_OF_TEXT, [])):
            dut = TypeTexts(bus.Schema([]))
            parts = [text[i:i + 1200] for i in range(0, len(text), 1200)]
            for i, part in enumerate(parts):
                message = {"utime": 0, "fingerprint": inner.fingerprint - 2**64 * (inner.fingerprint >> 63), "part": i,
                           "parts": len(parts), "text": part}
                dut.take(bus.encode(SCHEMA.find("type_text_t"), message))
            found = dut.of(inner.fingerprint.to_bytes(8, "big") + b"\1")
            self.assertEqual([found.name] if found else [], types)

    def test_a_flood_of_forged_texts_does_not_hide_the_genuine_one(self):
        genuine = "struct s_t { int8_t x; }"
        struct = bus.Schema([("t.lcm", genuine)]).find("s_t")
        forged = [f"struct forged{i}_t {{ int16_t y; }}" for i in range(200)]
        for before in range(10):
            dut = TypeTexts(bus.Schema([]))
            for text in (*forged[:before], genuine, *forged[before:]):
                message = {"utime": 0, "fingerprint": struct.fingerprint - 2**64 * (struct.fingerprint >> 63), "part": 0,
                           "parts": 1, "text": text}
                dut.take(bus.encode(SCHEMA.find("type_text_t"), message))
            self.assertIsNotNone(dut.of(struct.fingerprint.to_bytes(8, "big") + b"\1"), before)

    def test_an_event_that_swallowed_others_is_damage(self):
        self.write(4)
        data = bytearray(self.path.read_bytes())
        size = len(data) // 4
        for swallowed in (1, 2):
            broken = data[:]
            broken[24:28] = (int.from_bytes(data[24:28], "big") + swallowed * size).to_bytes(4, "big")
            self.path.write_bytes(broken)
            log = bus.Log(self.path)
            self.assertEqual([event.number for event in log], [1, 2, 3])
            self.assertEqual((log.damaged_places, log.skipped_bytes), (1, size))

    def test_what_the_kernel_makes_up_is_no_log(self):
        with self.assertRaisesRegex(bus.LogError, "/proc/self/status: cannot be read: it has no length"):
            bus.Log("/proc/self/status")

    def test_a_pipe_is_no_log_and_is_not_waited_for(self):
        os.mkfifo(self.path)
        with self.assertRaisesRegex(bus.LogError, "cannot be read: it is no file"):
            bus.Log(self.path)
        os.remove(self.path)

    def test_what_no_reader_takes_is_not_written(self):
        with bus.LogWriter(self.path) as log:
            for utime, channel in ((2**53 + 1, "A"), (0, ""), (0, "\n")):
                with self.assertRaises(bus.LogError):
                    log.write(utime, channel, b"")

    def test_a_file_that_cannot_be_read_or_written_is_named(self):
        for use in (bus.Log, bus.LogWriter):
            with self.assertRaisesRegex(bus.LogError, "^/nowhere/x: cannot be"):
                use("/nowhere/x")


class Addresses(unittest.TestCase):
    def test_a_bus_follows_from_its_name(self):
        self.assertEqual(bus.bus_url("offboard", "priamos", 0), "udpm://239.255.234.68:21933?ttl=0")
        for side, robot in (("x", "priamos"), ("onboard", ""), ("onboard", "A"), ("onboard", "a" * 33)):
            with self.assertRaises(bus.BusError):
                bus.bus_url(side, robot)


if __name__ == "__main__":
    unittest.main()
