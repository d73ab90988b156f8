"""The Python end on a line on which somebody loses, doubles, holds, damages and replays frames and sends his own, and
beside ends that are started again: events once and in order, no command late, every STOP."""

import itertools
import pathlib
import random
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "bus/python"))
sys.path.insert(0, str(ROOT / "test/bus/python"))

from priamos_link.end import End  # noqa: E402
from priamos_link.table import pack, unpack  # noqa: E402
from link_tables import channel_of_stops, table_of  # noqa: E402

POSE, NOTE, DRIVE, STOP = range(4)
TICK_S = 0.002


class HostileLine:
    """Bytes of one direction as they leave it, to those that arrive. Frames are lost, doubled, or held so that they come
    in between later ones; his own cut off what is being received."""

    def __init__(self, rng, lost=0.0, doubled=0.0, held=0.0, replays_hz=0.0, garbage_hz=0.0, bit_errors=0.0):
        self.rng, self.lost, self.doubled, self.held = rng, lost, doubled, held
        self.replays_hz, self.garbage_hz, self.bit_errors = replays_hz, garbage_hz, bit_errors
        self.frame, self.fate, self.recorded, self.waiting = bytearray(), "pass", [], []

    def pass_on(self, data, now):
        out = bytearray()
        for byte in data:
            self._take(byte, now, out)
        for at, frame in [w for w in self.waiting if w[0] <= now]:
            out += b"\0" + frame + b"\0"
            self.waiting.remove((at, frame))
        if self.recorded and self.rng.random() < self.replays_hz * TICK_S:
            out += b"\0" + self.rng.choice(self.recorded) + b"\0"
        if self.rng.random() < self.garbage_hz * TICK_S:
            out += b"\0" + bytes(self.rng.randrange(1, 256) for _ in range(self.rng.randrange(1, 60))) + b"\0"
        return bytes(out)

    def _take(self, byte, now, out):
        if not self.frame and byte:
            u = self.rng.random()
            self.fate = "lost" if u < self.lost else "held" if u < self.lost + self.held else "pass"
        if self.fate == "pass":
            flipped = byte ^ (1 << self.rng.randrange(8) if self.rng.random() < 8 * self.bit_errors else 0)
            out.append(flipped)
        if byte:
            self.frame.append(byte)
            return
        if not self.frame:
            return
        frame = bytes(self.frame)
        if self.fate == "held":
            self.waiting.append((now + self.rng.uniform(0, 0.5), frame))
        elif self.fate == "pass" and self.rng.random() < self.doubled:
            out += b"\0" + frame + b"\0"
        self.recorded = (self.recorded + [frame])[-500:]
        self.frame, self.fate = bytearray(), "pass"


class World:
    """The robot's end and the workstation's, both in Python, with somebody on the line."""

    def __init__(self, seed, **hostility):
        self.rng, self.table, self.now = random.Random(seed), table_of("POSE", "NOTE", "DRIVE", "STOP"), 100.0
        self.lines = [HostileLine(random.Random(f"{seed} {way}"), **hostility) for way in ("up", "down")]
        self.ends = [None, None]
        self.came = {channel: [] for channel in range(4)}
        self.sent, self.made, self.ages = {NOTE: 0, STOP: 0}, {}, []
        self.stop_at, self.stop_took = {}, []
        for i in (0, 1):
            self.start(i)

    def start(self, i):
        self.ends[i] = End(self.table, bytes(range(32)), i == 0, lambda: self.rng.getrandbits(64), self.now)

    def offer(self, channel):
        n = self.sent[channel] + 1
        data = n.to_bytes(2, "big") + (bytes(18) if channel == NOTE else b"")
        if self.ends[1].offer(channel, data, 8 * len(data), self.now):
            self.sent[channel] = n
            if channel == STOP:
                self.stop_at[n] = self.now

    def run(self, seconds, offers=True, each=None):
        for step in range(round(seconds / TICK_S)):
            self.now += TICK_S
            if each is not None:
                each(step)
            if offers and step % 250 == 0:
                self.offer(NOTE)
            if offers and step % 500 == 100:
                self.offer(STOP)
            if offers and step % 25 == 0:
                self.made[step & 0xFFFF] = self.now
                self.ends[1].offer(DRIVE, (step & 0xFFFF).to_bytes(5, "big"), 40, self.now)
                self.ends[0].offer(POSE, bytes(11), 83, self.now)
            arriving = [self.lines[1].pass_on(self.ends[1].step(self.now), self.now),
                        self.lines[0].pass_on(self.ends[0].step(self.now), self.now)]
            for end, data in zip(self.ends, arriving):
                for d in end.receive(data, self.now):
                    self._note(d)

    def _note(self, delivery):
        number = int.from_bytes(delivery.packed[:5 if delivery.channel == DRIVE else 2], "big")
        self.came[delivery.channel].append(number)
        if delivery.channel == DRIVE:
            self.ages.append(self.now - self.made[number])
        if delivery.channel == STOP:
            self.stop_took.append(self.now - self.stop_at[number])

    def rest(self, seconds):
        """Nobody is on the line any more, and nothing is offered."""
        for line in self.lines:
            line.__init__(line.rng)
        self.run(seconds, offers=False)


HOSTILE = {"lost": 0.1, "doubled": 0.1, "held": 0.1, "replays_hz": 6, "garbage_hz": 4, "bit_errors": 1e-4}


class Attacks(unittest.TestCase):
    def test_events_come_once_and_in_order_and_no_command_late(self):
        for seed in (1, 2):
            dut = World(seed, **HOSTILE)
            dut.run(30)
            came = {channel: len(dut.came[channel]) for channel in (NOTE, STOP)}
            dut.rest(20)
            for channel in (NOTE, STOP):
                self.assertEqual(dut.came[channel], list(range(1, dut.sent[channel] + 1)))
                self.assertGreaterEqual(came[channel] + 8, dut.sent[channel], "of the last seconds some are under way")
            self.assertGreaterEqual(dut.sent[STOP], 29)
            self.assertLessEqual(max(dut.ages), 0.25)
            self.assertGreater(len(dut.ages), 60)
            print(f"stops: median {sorted(dut.stop_took)[len(dut.stop_took) // 2]:.3f} s, longest {max(dut.stop_took):.3f} s")

    def test_bit_errors_alone(self):
        dut = World(3, bit_errors=1e-3)
        dut.run(30)
        dut.rest(15)
        for channel in (NOTE, STOP):
            self.assertEqual(dut.came[channel], list(range(1, dut.sent[channel] + 1)))

    def test_restarts_of_the_workstation_lose_only_what_waited_there(self):
        for seed in (4, 5):
            dut, lost = World(seed, **HOSTILE), set()

            def again(step):
                if step and step % 3000 == 0:
                    came = set(dut.came[NOTE])
                    lost.update(n for n in range(1, dut.sent[NOTE] + 1) if n not in came)
                    dut.start(1)

            dut.run(30, each=again)
            dut.rest(20)
            came = dut.came[NOTE]
            self.assertEqual(came, sorted(set(came)), "once and in order")
            self.assertLessEqual(set(range(1, dut.sent[NOTE] + 1)) - set(came), lost)

    def test_restarts_of_the_robots_end_lose_none_and_a_stop_comes_soon_after(self):
        for seed in (6, 7):
            dut = World(seed, **HOSTILE)
            dut.run(30, each=lambda step: step and step % 3000 == 0 and dut.start(0))
            dut.rest(20)
            for channel in (NOTE, STOP):
                came = dut.came[channel]
                # What was handed on and not yet acknowledged comes again: the new end cannot know of it.
                self.assertEqual(list(dict.fromkeys(came)), list(range(1, dut.sent[channel] + 1)))
                self.assertLessEqual(len(came) - len(set(came)), 4 * 6)
            self.assertLess(max(dut.stop_took), 6)

    def test_ten_thousand_garbage_frames(self):
        dut = World(8)
        dut.run(3)
        rng, before = random.Random(8), {c: len(v) for c, v in dut.came.items()}
        for _, i in itertools.product(range(5000), (0, 1)):
            noise = bytes(rng.randrange(1, 256) for _ in range(rng.randrange(1, 80)))
            self.assertEqual(dut.ends[i].receive(noise + b"\0", dut.now), [])
        dut.run(3)
        self.assertEqual(dut.came[STOP], list(range(1, dut.sent[STOP] + 1)))
        self.assertGreater(len(dut.came[DRIVE]) - before[DRIVE], 40, "the link did not suffer")


class Stops(unittest.TestCase):
    def test_a_stop_is_packed_whatever_its_other_fields_hold_and_a_rearm_is_not(self):
        channel = channel_of_stops()
        for driver, sent in ((9, 3), (-5, 0), (127, 3), (2, 2)):
            packed, _ = pack(channel, {"action": 1, "driver": driver}, 5_000_000)
            self.assertEqual((unpack(channel, packed, 5_000_000)["action"], unpack(channel, packed, 5_000_000)["driver"]),
                             (1, sent))
        with self.assertRaisesRegex(ValueError, "got another one in driver"):
            pack(channel, {"action": 0, "driver": 9}, 5_000_000)


if __name__ == "__main__":
    unittest.main()
