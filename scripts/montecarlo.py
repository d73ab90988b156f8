"""What scripts/montecarlo does: its help says how it is called."""
import argparse
import collections
import concurrent.futures
import json
import math
import os
import pathlib
import re
import statistics
import subprocess
import sys

# What `priamos world generate` makes, and all of them in turn.
KINDS = ("room", "floor", "corridor", "any")
MORE_KINDS = ("storey",)  # only when asked for


def refuse(sentence):
    print(f"montecarlo: {sentence}; next: scripts/montecarlo --help", file=sys.stderr)
    sys.exit(2)


def arguments():
    parser = argparse.ArgumentParser(prog="scripts/montecarlo", description=__doc__)
    parser.add_argument("--scenario", default="door", help="a file of the deployment's scenarios/")
    parser.add_argument("--generate", choices=KINDS + MORE_KINDS, help="instead: a building of that kind, another one for each seed, "
                        "in which the robot is sent to places, through the door and back")
    parser.add_argument("--follow", action="store_true", help="with --generate corridor: the robot follows it to its end")
    parser.add_argument("--explore", action="store_true", help="with --generate: the robot explores the building without a plan")
    parser.add_argument("--deployment", default="sim", help="sim, robot, or a folder of configurations, with a slash")
    parser.add_argument("--seeds", default="1..100", help="FIRST..LAST")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="runs at a time")
    parser.add_argument("--into", default="montecarlo", help="folder of the summaries, the table and the plots")
    parser.add_argument("--programs", default="build/bin", help="folder of the programs, as scripts/build leaves them")
    options = parser.parse_args()
    match = re.fullmatch(r"(\d+)\.\.(\d+)", options.seeds)
    if not match or int(match[1]) > int(match[2]):
        refuse(f"--seeds: expected FIRST..LAST, got \"{options.seeds}\"")
    if options.jobs < 1:
        refuse(f"--jobs: expected 1 or more, got {options.jobs}")
    options.seeds = range(int(match[1]), int(match[2]) + 1)
    options.program = pathlib.Path(options.programs) / "priamos"
    if not options.program.exists():
        refuse(f"{options.program}: expected the program, got none; scripts/build makes it")
    return options


def generated(options, seed):
    """Deployment and scenario of a building that is made up for this seed."""
    kind = KINDS[seed % (len(KINDS) - 1)] if options.generate == "any" else options.generate
    folder = pathlib.Path(options.into) / f"seed-{seed}"
    done = subprocess.run([options.program, "world", "generate", "--kind", kind, "--seed", str(seed), "--into", folder,
                           "--deployment", options.deployment, "--force", "--explore" if options.explore else "--follow" if options.follow else "--there-and-back"], capture_output=True, text=True)
    if done.returncode != 0:
        refuse(f"seed {seed}: {done.stderr.strip()}")
    return f"{folder}/", f"{kind}-{seed}"


def run(options, seed):
    """The summary of a run, from its file when it was run before; a text when the run failed to run."""
    file = pathlib.Path(options.into) / f"seed-{seed}.json"
    if not file.exists():
        part = file.with_suffix(".part")
        made = getattr(options, "generate", None)
        deployment, scenario = generated(options, seed) if made else (options.deployment, options.scenario)
        command = [options.program, "lockstep", "--scenario", scenario, "--deployment", deployment,
                   "--seed", str(seed), "--json", str(part)]
        done = subprocess.run(command, capture_output=True, text=True)
        if not part.exists() or part.stat().st_size == 0:
            return (done.stderr.strip().splitlines() or [f"exit code {done.returncode}"])[-1]
        part.rename(file)  # whole, or not there
    return json.loads(file.read_text())


def run_all(options):
    pathlib.Path(options.into).mkdir(parents=True, exist_ok=True)
    results = {}
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        futures = {pool.submit(run, options, seed): seed for seed in options.seeds}
        for future in concurrent.futures.as_completed(futures):
            results[futures[future]] = future.result()
            if sys.stderr.isatty():
                print(f"\r{len(results)} of {len(options.seeds)} runs", end="", file=sys.stderr, flush=True)
    if sys.stderr.isatty():
        print(file=sys.stderr)
    return dict(sorted(results.items()))


def quantile(values, part):
    """The smallest value that at least `part` of them do not exceed."""
    return sorted(values)[max(0, math.ceil(part * len(values)) - 1)]


def cause(summary):
    """The reason of a failure without its figures."""
    return re.sub(r"-?\d+(\.\d+)?", "#", summary["reason"] or "no reason")


def line(name, values, unit, scale=1.0):
    values = [v for v in values if v is not None]  # a drive that leads through no door has none
    if not values:
        return f"{name:<36} none"
    scaled = [abs(v) * scale for v in values]
    return (f"{name:<36} median {quantile(scaled, 0.5):7.2f}   95 % {quantile(scaled, 0.95):7.2f}   "
            f"worst {max(scaled):7.2f} {unit}")


def figures(runs):
    """Lines of text: how the runs ended, and what was measured in those that passed."""
    passed = [r for r in runs.values() if r["passed"]]
    beliefs = [r["belief_at_door"] for r in passed if r.get("belief_at_door")]
    text = [f"{len(passed)} of {len(runs)} passed ({100 * len(passed) / len(runs):.1f} %), "
            f"{sum(r['contacts'] > 0 for r in runs.values())} runs with contacts"]
    causes = collections.defaultdict(list)
    for seed, r in runs.items():
        if not r["passed"]:
            causes[cause(r)].append(seed)
    for reason, seeds in sorted(causes.items(), key=lambda c: -len(c[1])):
        text.append(f"  {len(seeds):4}  {reason}   (seeds {', '.join(map(str, seeds[:8]))}{', ...' if len(seeds) > 8 else ''})")
    text.append(line("lateral in the door", [r["lateral_at_door_m"] for r in passed], "cm", 100))
    text.append(line("heading in the door", [r["heading_at_door_deg"] for r in passed], "degrees"))
    text.append(line("error of the pose across the door", [b["lateral_m"] for b in beliefs], "cm", 100))
    text.append(line("error of the heading there", [b["heading_deg"] for b in beliefs], "degrees"))
    text.append(line("what the robot expects across, sigma", [b["lateral_sigma_m"] for b in beliefs], "cm", 100))
    text += floor_figures([r["explore"] for r in runs.values() if r.get("explore")])
    text += door_figures([r["doors"] for r in runs.values() if r.get("doors")])
    text += corridor_figures([r["corridor"] for r in passed if r.get("corridor")])
    if beliefs:
        nees = [b["nees"] for b in beliefs]
        spread = 1.96 * statistics.pstdev(nees) / math.sqrt(len(nees))
        text.append(f"{'NEES in the door (3 is right)':<36} mean {statistics.mean(nees):.2f} +- {spread:.2f}")
    text += correction_figures([r["corrections"] for r in runs.values() if r.get("corrections")])
    if passed:
        text.append(f"{'smallest gap':<36} worst {100 * min(r['min_gap_m'] for r in passed):7.2f} cm")
        text.append(f"{'mean speed':<36} median {quantile([r['mean_speed_m_s'] for r in passed], 0.5):7.3f} m/s")
    return text


def correction_figures(runs):
    """Lines of text about how landmark fixes agreed with what the robot expected."""
    count, beyond = sum(r["count"] for r in runs), sum(r["beyond_3_sigma"] for r in runs)
    if not count:
        return []
    return [f"{'corrections beyond 3 sigmas':<36} {beyond} of {count}, {100 * beyond / count:.2f} %, "
            f"largest distance {max(r['most_distance'] for r in runs):.1f}"]


def floor_figures(floors):
    """Lines of text about explorations."""
    if not floors:
        return []
    return [line("floor not seen", [1 - f["seen"] for f in floors], "%", 100),
            line("floor that can be reached", [f["reachable_m2"] for f in floors], "m2"),
            line("driven", [f["driven_m"] for f in floors], "m"),
            line("driven, parts of the best tour", [f["driven_m"] / f["tour_m"] for f in floors if f.get("tour_m")], "-"),
            line("walls, 95 % within", [f["wall_error_p95_m"] for f in floors], "cm", 100),
            line("pose at the end", [f["pose_error_m"] for f in floors], "cm", 100)]


def door_figures(runs):
    """Lines of text about doors that the head found in passing."""
    if not runs:
        return []
    doors = [d for r in runs for d in r["on_the_way"]]
    found = [d for d in doors if d["told"]]
    told = [d for d in found if d["told"] != "unknown"]
    text = [f"{'doors on the way':<36} {len(found)} of {len(doors)} found, {sum(r['false'] for r in runs)} false; state "
            f"told of {len(told)}, right {sum(d['told'] == d['state'] for d in told)}",
            line("their place along the wall", [d["along_m"] for d in found], "cm", 100),
            line("their place across the wall", [d["across_m"] for d in found], "cm", 100)]
    if found:
        nees = [(d["along_m"] / max(0.001, d["sigma_along_m"])) ** 2 + (d["across_m"] / max(0.001, d["sigma_across_m"])) ** 2
                for d in found]
        text.append(f"{'their NEES (2 is right)':<36} mean {statistics.mean(nees):.2f}")
    for d in found:
        if d["told"] != d["state"]:
            text.append(f"  {d['name']}: {d['state']} ({d['open_deg']:.0f} degrees) told {d['told']}")
    return text


def corridor_figures(corridors):
    """Lines of text about drives along corridors: what the robot knew of its pose."""
    if not corridors:
        return []
    ends = [c["end"] for c in corridors if c["end"]]
    text = [line("length of the drive", [c["driven_m"] for c in corridors], "m"),
            line("error across on the way, RMS of a run", [c["across_rms_m"] for c in corridors], "cm", 100),
            line("error across at the end", [e["lateral_m"] for e in ends], "cm", 100),
            line("expected across at the end, sigma", [e["lateral_sigma_m"] for e in ends], "cm", 100),
            line("error along at the end", [e["along_m"] for e in ends], "cm", 100),
            line("error of the heading at the end", [e["heading_deg"] for e in ends], "degrees")]
    if len(ends) > 1:
        nees = [e["nees"] for e in ends]
        spread = 1.96 * statistics.stdev(nees) / math.sqrt(len(nees))
        text.append(f"{'NEES at the end (3 is right)':<36} mean {statistics.mean(nees):.2f} +- {spread:.2f}")
    return text


def histogram(values, title, unit, width=520, height=240):
    """An SVG of how often values occur."""
    low, high = min(values), max(values)
    bins = max(5, min(30, round(math.sqrt(len(values)))))
    step = (high - low) / bins or 1.0
    counts = collections.Counter(min(bins - 1, int((v - low) / step)) for v in values)
    most = max(counts.values())
    bars = "".join(
        f'<rect x="{40 + i * (width - 60) / bins:.1f}" y="{height - 40 - n * (height - 80) / most:.1f}" '
        f'width="{(width - 60) / bins - 1:.1f}" height="{n * (height - 80) / most:.1f}" fill="#3b6ea5"/>'
        for i, n in counts.items())
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="sans-serif" '
            f'font-size="12"><rect width="100%" height="100%" fill="white"/><text x="40" y="22">{title}: {len(values)} runs'
            f'</text>{bars}<text x="40" y="{height - 20}">{low:.2f}</text>'
            f'<text x="{width - 20}" y="{height - 20}" text-anchor="end">{high:.2f} {unit}</text></svg>\n')


def write_plots(folder, runs):
    passed = [r for r in runs.values() if r["passed"]]
    lateral = [100 * r["lateral_at_door_m"] for r in passed if r["lateral_at_door_m"] is not None]
    nees = [r["belief_at_door"]["nees"] for r in passed if r.get("belief_at_door")]
    for name, values, title, unit in (("lateral", lateral, "lateral in the door", "cm"),
                                      ("nees", nees, "NEES in the door", "")):
        if values:
            (folder / f"{name}.svg").write_text(histogram(values, title, unit))


def main():
    options = arguments()
    results = run_all(options)
    runs = {seed: r for seed, r in results.items() if not isinstance(r, str)}
    broken = {seed: r for seed, r in results.items() if isinstance(r, str)}
    for seed, reason in broken.items():
        print(f"seed {seed}: {reason}", file=sys.stderr)
    if not runs:
        sys.exit(2)
    text = "\n".join(figures(runs)) + "\n"
    folder = pathlib.Path(options.into)
    (folder / "table.txt").write_text(text)
    write_plots(folder, runs)
    print(text, end="")
    print(f"in {folder}: table.txt, lateral.svg, nees.svg, a summary per seed")
    sys.exit(2 if broken else 0)


if __name__ == "__main__":
    main()
