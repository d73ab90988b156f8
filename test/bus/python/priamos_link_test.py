"""The Python end against the vectors of PROTOCOL.md, and two of its ends against each other."""

import json
import pathlib
import random
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "bus/python"))
sys.path.insert(0, str(ROOT / "test/bus/python"))

import priamos_bus as bus  # noqa: E402
from priamos_link import bundle, frames  # noqa: E402
from priamos_link.__main__ import offer  # noqa: E402
from priamos_link.end import End  # noqa: E402
from priamos_link.table import Channel, Table, pack, unpack  # noqa: E402
from link_tables import table_of  # noqa: E402

VECTORS = dict(re.findall(r"^(\w+) = (\S+)$", (ROOT / "bus/radio/PROTOCOL.md").read_text(), re.M))


def vector(name):
    return bytes.fromhex(VECTORS[name])


class Scope:
    def __init__(self, name="table_hash", encrypted=False, code_bytes=4, echo=1):
        self.hash, self.encrypted, self.code_bytes = int(VECTORS[name], 16), encrypted, code_bytes
        self.echo_bytes = lambda direction: echo if direction == frames.DOWN else 0


def codec(outgoing, *scope):
    return frames.Codec(vector("link_key"), Scope(*scope), outgoing)


EPOCH = int(VECTORS["epoch"], 16)


class Vectors(unittest.TestCase):
    def test_keys_and_epoch(self):
        dut = codec(frames.UP)
        self.assertEqual(dut.authentication_key, vector("authentication_key"))
        self.assertEqual(dut.epoch_of(int(VECTORS["onboard_nonce"], 16), int(VECTORS["offboard_nonce"], 16)), EPOCH)

    def test_frames_are_sealed(self):
        up, down = codec(frames.UP), codec(frames.DOWN)
        self.assertEqual(up.seal(EPOCH, 300, vector("bundle_up"), False, 0), vector("frame_up_counter_300"))
        self.assertEqual(up.seal(EPOCH, 300, vector("bundle_up"), True, 0), vector("frame_up_counter_300_whole"))
        self.assertEqual(down.seal(EPOCH, 7, vector("bundle_down"), False, 300), vector("frame_down_counter_7"))
        sealed = codec(frames.DOWN, "table_hash_sealed", True)
        self.assertEqual(sealed.seal(EPOCH, 7, vector("bundle_down"), False, 300),
                         vector("frame_down_counter_7_encrypted"))

    def test_frames_are_opened_once(self):
        dut, window = codec(frames.UP), frames.Window()
        content = frames.cobs_decode(vector("frame_down_counter_7")[:-1])
        opened = dut.open(content, EPOCH, window, 310)
        self.assertEqual((opened.bundle, opened.echo), (vector("bundle_down"), 300))
        self.assertIsNone(dut.open(content, EPOCH, window, 310))
        block = dut.open(frames.block_decode(vector("block_down_counter_7")[:-1]), EPOCH, frames.Window(), 310)
        self.assertTrue(block.bundle.startswith(vector("bundle_down")))

    def test_longer_codes_and_echoes(self):
        for name, scope in (("code_6", ("table_hash_code_6", False, 6)), ("code_8", ("table_hash_code_8", False, 8)),
                            ("fast", ("table_hash", False, 4, 2))):
            wire = vector(f"frame_down_counter_7_{name}")
            self.assertEqual(codec(frames.DOWN, *scope).seal(EPOCH, 7, vector("bundle_down"), False, 300), wire)
            opened = codec(frames.UP, *scope).open(frames.cobs_decode(wire[:-1]), EPOCH, frames.Window(), 310)
            self.assertEqual((opened.bundle, opened.echo), (vector("bundle_down"), 300))

    def test_a_changed_bit_is_refused(self):
        content = bytearray(frames.cobs_decode(vector("frame_down_counter_7")[:-1]))
        for i in range(8 * len(content)):
            content[i // 8] ^= 1 << i % 8
            self.assertIsNone(codec(frames.UP).open(bytes(content), EPOCH, frames.Window(), 310))
            content[i // 8] ^= 1 << i % 8

    def test_hello(self):
        hello = codec(frames.UP).open(frames.cobs_decode(vector("hello_down")[:-1]), 0, frames.Window(), 0)
        self.assertTrue(hello.agreed and hello.over)
        self.assertEqual(codec(frames.DOWN).seal_hello(hello), vector("hello_down"))

    def test_difference(self):
        reader = bundle.Reader(vector("difference"))
        self.assertEqual(bundle.apply_difference([15, 13, 3, 9], vector("difference_baseline"), reader),
                         vector("difference_message"))


def channel_of(fields):
    struct = bus.Schema([("t.lcm", "struct s { const int8_t GO = 1; " + fields + " }")]).find("s")
    packer = bus.Packer(struct)
    return Channel("X", "0" * 16, frames.UP, "state", 0, packer.max_bits, 0, False, [], packer)


class Fields(unittest.TestCase):
    def test_messages_come_back_within_half_a_step(self):
        channel = channel_of("""double x_m;  // [m] @range -100,100 @step 0.01: position
            float near_m[2];  // [m] @range 0,5 @step 0.01 @invalid -1: distance
            boolean on;  // [-]: whether
            int8_t n;  // [-] @range 0,3 @step 1: number of words
            string words[n];  // [ascii] @max 3,8: words
            """)
        message = {"x_m": -12.344, "near_m": [-1, 2.5], "on": True, "words": ["yes", ""]}
        packed, _ = pack(channel, message, 0)
        self.assertEqual(unpack(channel, packed, 0), {**message, "x_m": -12.34, "near_m": [-1.0, 2.5], "n": 2})
        self.assertEqual(unpack(channel, pack(channel, {}, 0)[0], 0),
                         {"x_m": 0.0, "near_m": [0.0, 0.0], "on": False, "n": 0, "words": []})
        for wrong in ({"near_m": [1]}, {"y_m": 1}, {"on": "yes"}):
            with self.assertRaises(ValueError):
                pack(channel, wrong, 0)

    def test_time_stamps_left_out_are_now(self):
        channel = channel_of("int64_t utime;  // [us] @age 1000000 @step 1000: when\n")
        self.assertEqual(unpack(channel, pack(channel, {}, 5_000_000)[0], 7_000_000), {"utime": 7_000_000})

    def test_a_code_that_the_field_does_not_have_is_refused(self):
        channel = channel_of("int8_t mode;  // [-] @range 0,5 @step 1: GO or not\n")
        self.assertEqual(unpack(channel, b"\xa0", 0), {"mode": 5})
        for packed in (b"\xc0", b"\xe0"):
            with self.assertRaises(ValueError):
                unpack(channel, packed, 0)
        with self.assertRaisesRegex(ValueError, "got another one in mode"):
            pack(channel, {"mode": 7}, 0)


class TwoEnds(unittest.TestCase):
    def run_ends(self, seconds, loss=0.0, delay=0.0, seed=1):
        rng, table, now = random.Random(seed), table_of("POSE", "PATH", "DRIVE"), 100.0
        ends = [End(table, bytes(range(32)), onboard, lambda: rng.getrandbits(64), now) for onboard in (True, False)]
        air, got, sent, offered = [[], []], [], [], {}
        for step in range(int(seconds * 1000)):
            now += 0.001
            if step % 500 == 0 and step > 1000 and step < seconds * 1000 - 8000:
                sent += [len(sent)] if ends[1].offer(1, len(sent).to_bytes(60, "big"), 480, now) else []
            if step % 50 == 0:
                offered[step] = now
                ends[1].offer(2, step.to_bytes(5, "big"), 40, now)
            for i, end in enumerate(ends):
                air[i] += [(now + delay, byte) for byte in end.step(now) if rng.random() >= loss]
                due = bytes(byte for at, byte in air[1 - i] if at <= now)
                air[1 - i] = [(at, byte) for at, byte in air[1 - i] if at > now]
                got += [(now, d) for d in end.receive(due, now)]
        return sent, got, offered

    def test_events_come_once_and_in_order_over_a_bad_line(self):
        for loss in (0.0, 0.01):
            sent, got, _ = self.run_ends(30, loss)
            came = [int.from_bytes(d.packed, "big") for _, d in got if d.channel == 1]
            self.assertEqual(came, sent)
            self.assertGreater(len(sent), 30)

    def test_no_command_comes_too_late(self):
        for delay, least in ((0.0, 100), (0.04, 100), (0.3, 0)):
            _, got, offered = self.run_ends(10, 0.0, delay)
            ages = [now - offered[int.from_bytes(d.packed, "big")] for now, d in got if d.channel == 2]
            self.assertLessEqual(max(ages, default=0), 0.25)
            self.assertGreaterEqual(len(ages), least)
            if delay > 0.25:
                self.assertEqual(ages, [])

    def agree(self):
        rng, table, now = random.Random(1), table_of("POSE", "PATH", "DRIVE"), 100.0
        ends = [End(table, bytes(range(32)), onboard, lambda: rng.getrandbits(64), now) for onboard in (True, False)]
        for _ in range(2000):
            now += 0.001
            ends[1].receive(ends[0].step(now), now)
            ends[0].receive(ends[1].step(now), now)
        return ends, now

    def test_events_of_a_frame_overtaken_by_many_are_passed_over(self):
        (up, down), now = self.agree()

        def sealed(counter, numbers):
            w = bundle.Writer()
            for n in numbers:
                for value, bits in ((2, up.table.id_bits), (n, 8), (n == numbers[0], 1), (3, 2), (0, 12), (1, 5), (n, 8),
                                    (0, 1)):
                    w.put(value, bits)
            return down.codec.seal(down.epoch, counter, w.bytes(), True, 0)

        first = up.window.highest + 1
        held = sealed(first, [0])
        for k in range(60):
            self.assertEqual(len(up.receive(sealed(first + 1 + k, range(3 * k, 3 * k + 3)), now)), 3)
        self.assertEqual(up.receive(held, now), [])
        self.assertEqual(len(up.receive(sealed(first + 61, [180]), now)), 1)

    def test_an_old_command_does_not_fill_the_line(self):
        (_, down), now = self.agree()
        now += 3  # the other end has gone silent
        down.offer(2, bytes(5), 40, now)
        sent = 0
        for _ in range(10000):
            now += 0.001
            sent += len(down.step(now))
        self.assertLess(sent, 3000)

    def test_a_command_ages_from_when_it_was_made(self):
        for made, arrives in ((0, True), (-0.2, True), (-0.3, False), (60, True)):
            (up, down), now = self.agree()
            down.offer(2, bytes(5), 40, now, now + made)
            got = []
            for _ in range(500):
                now += 0.001
                got += [d for d in up.receive(down.step(now), now) if d.channel == 2]
                down.receive(up.step(now), now)
            self.assertEqual(len(got), arrives, made)
        (_, down), now = self.agree()
        down.offer(2, b"newer", 40, now)
        down.offer(2, b"older", 40, now, now - 0.1)
        self.assertEqual(down.waiting[2][0], b"newer")

    def test_typed_messages_of_wrong_size_are_refused(self):
        (_, down), now = self.agree()
        for line in ("[" * 60000, '{"channel": "PATH", "hex": "00", "bits": -5}',
                     '{"channel": "PATH", "hex": "%s", "bits": 8}' % ("00" * 1400)):
            with self.assertRaises(ValueError):
                offer(down, line, now)

    def test_odd_tables_are_refused_in_a_sentence(self):
        good = {
            "encrypted": False, "code_bytes": 4, "baud": 9600, "bytes_per_s": 960, "table_hash": "0", "channels": [
                {"name": "A", "meaning": "0", "direction": "up", "class": "state", "fixed_bits": 8, "max_bits": 8,
                 "ttl_us": 0, "urgent": False, "delta": [],
                 "type": "s", "lcm": "struct s { byte x; }"}]}
        odd = [{**good, key: value} for key, value in (
            ("bytes_per_s", 0), ("bytes_per_s", -1), ("bytes_per_s", float("nan")), ("bytes_per_s", float("inf")),
            ("baud", 0), ("baud", float("inf")), ("code_bytes", float("inf")), ("channels", 5))]
        channel = good["channels"][0]
        odd += [{**good, "channels": [{**channel, key: value}]} for key, value in (
            ("delta", 5), ("delta", [0]), ("lcm", "struct {"), ("lcm", 5), ("type", "t"),
            ("lcm", "struct s { byte x[2]; }"), ("lcm", "struct s { double x; }"))]
        for data in odd:
            with self.assertRaisesRegex(ValueError, "expected what `priamos link table"):
                Table(json.dumps(data))
        with self.assertRaisesRegex(ValueError, "expected what"):
            Table("[" * 100_000)

    def test_garbage_is_refused(self):
        rng, table = random.Random(3), table_of("POSE", "PATH", "DRIVE")
        end = End(table, bytes(range(32)), True, lambda: rng.getrandbits(64), 0.0)
        for _ in range(2000):
            self.assertEqual(end.receive(rng.randbytes(rng.randrange(60)) + b"\0", 1.0), [])


if __name__ == "__main__":
    unittest.main()
