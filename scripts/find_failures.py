"""What scripts/find-failures does: its help says how it is called."""
import argparse
import concurrent.futures
import json
import math
import os
import pathlib
import random
import shutil
import sys
import time
import tomllib

import failure_space
import montecarlo
import toml_text

FORGOTTEN_S = 30.0  # a touch that is not noticed by then never is


def refuse(sentence):
    print(f"find-failures: {sentence}; next: scripts/find-failures --help", file=sys.stderr)
    sys.exit(2)


def arguments(words=None):
    parser = argparse.ArgumentParser(prog="scripts/find-failures", description=__doc__)
    parser.add_argument("--scenario", default="door", help="a file of the deployment's scenarios/")
    parser.add_argument("--deployment", default="config/sim", help="folder of a deployment")
    parser.add_argument("--vary", default=",".join(failure_space.GROUPS), help="what may differ, with commas between")
    parser.add_argument("--evaluations", type=int, default=200, help="runs in all")
    parser.add_argument("--minutes", type=float, default=math.inf, help="begin no run after that")
    parser.add_argument("--population", type=int, default=16, help="runs of a generation")
    parser.add_argument("--seed", type=int, default=1, help="of the search, and of its first run")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="runs at a time")
    parser.add_argument("--into", default="find-failures", help="folder of what is found")
    parser.add_argument("--programs", default="build/bin", help="folder of the programs, as scripts/build leaves them")
    options = parser.parse_args(words)
    options.vary = [word for word in options.vary.split(",") if word]
    unknown = [word for word in options.vary if word not in failure_space.GROUPS]
    if unknown or not options.vary:
        refuse(f"--vary: expected some of {', '.join(failure_space.GROUPS)}, got \"{','.join(unknown)}\"")
    for name in ("evaluations", "population", "jobs"):
        if getattr(options, name) < 1:
            refuse(f"--{name}: expected 1 or more, got {getattr(options, name)}")
    options.program = pathlib.Path(options.programs) / "priamos"
    if not options.program.exists():
        refuse(f"{options.program}: expected the program, got none; scripts/build makes it")
    options.deployment = pathlib.Path(options.deployment)
    options.into = pathlib.Path(options.into)
    return options


def load(file):
    try:
        return tomllib.loads(file.read_text())
    except (OSError, tomllib.TOMLDecodeError) as error:
        refuse(f"{file}: {error}")


def base_of(options):
    """Scenario, robot model and world of the scenario that is varied."""
    scenario = load(options.deployment / "scenarios" / f"{options.scenario}.toml")
    process = next((p for p in scenario.get("process", []) if p["module"] == "world"), None)
    if not process:
        refuse(f"scenario {options.scenario}: expected a process \"world\", got none")
    robot = load(options.deployment / process["config"])
    name = robot.get("world", "")
    if process.get("set", "").startswith("world="):
        name = process["set"].removeprefix("world=")
    return failure_space.Base(scenario, robot, load(options.deployment / name), load(options.deployment / scenario["map"]))


def score(summary):
    """Lower is worse for the robot: the smallest gap [m]; after a touch that the base drove into, minus the part of
    30 s after which it was noticed, between 0 and -1."""
    driven = [t for t in summary["touches"] if t["kind"] in ("driven", "fell")]
    if not driven:
        return summary["min_gap_m"]
    return -max(min(FORGOTTEN_S, FORGOTTEN_S if t["noticed_after_s"] is None else t["noticed_after_s"])
                for t in driven) / FORGOTTEN_S


def write_deployment(options, varied, folder):
    """A deployment with the one scenario "failure"."""
    folder.mkdir(parents=True, exist_ok=True)
    for file in options.deployment.iterdir():
        if file.is_file():
            shutil.copy(file, folder / file.name)
    shutil.copytree(options.deployment / "maps", folder / "maps", dirs_exist_ok=True)
    for name in ("worlds", "scenarios"):
        (folder / name).mkdir(exist_ok=True)
    (folder / "worlds" / "failure.toml").write_text(toml_text.dumps(varied.world))
    (folder / "world.toml").write_text(toml_text.dumps(varied.robot))
    (folder / "scenarios" / "failure.toml").write_text(toml_text.dumps(varied.scenario))


def evaluate(options, base, index, point):
    """Runs one point; returns its record, and leaves its deployment when the base touched something."""
    varied = failure_space.apply(base, options.vary, point)
    seed = options.seed + index
    folder = options.into / f"run-{index:04}"
    write_deployment(options, varied, folder)
    run = argparse.Namespace(into=folder, program=options.program, scenario="failure", deployment=f"{folder}/")
    summary = montecarlo.run(run, seed)
    record = {"index": index, "point": point, "seed": seed, "parameters": varied.parameters}
    if isinstance(summary, str):
        record.update(score=math.inf, broken=summary)
        shutil.rmtree(folder)
        return record
    record.update(score=score(summary), passed=summary["passed"], touches=summary["touches"],
                  min_gap_m=summary["min_gap_m"])
    if record["score"] > 0:
        shutil.rmtree(folder)
        return record
    record["folder"] = f"failure-{index:04}"
    record["again"] = f"priamos lockstep --deployment {options.into}/{record['folder']}/ --scenario failure --seed {seed}"
    (folder / "failure.json").write_text(json.dumps(record, indent=2) + "\n")
    kept = options.into / record["folder"]
    shutil.rmtree(kept, ignore_errors=True)
    folder.rename(kept)
    return record


class CrossEntropy:
    """Independent normal distributions over the unit cube that move towards the best quarter of each generation
    (Rubinstein 1999), cut off at the cube; they keep a least width, so that the search does not freeze."""
    LEAST_SIGMA, SMOOTHING, ELITE = 0.05, 0.7, 0.25

    def __init__(self, dimensions, seed):
        self.mean, self.sigma = [0.5] * dimensions, [0.35] * dimensions
        self.random = random.Random(seed)

    def draw(self):
        return [min(1.0, max(0.0, self.random.gauss(m, s))) for m, s in zip(self.mean, self.sigma)]

    def learn(self, records):
        ranked = sorted((r for r in records if math.isfinite(r["score"])), key=lambda r: r["score"])
        elite = ranked[:max(2, round(self.ELITE * len(records)))]
        if len(elite) < 2:
            return
        for i in range(len(self.mean)):
            values = [r["point"][i] for r in elite]
            mean = sum(values) / len(values)
            sigma = math.sqrt(sum((v - mean) ** 2 for v in values) / len(values))
            self.mean[i] += self.SMOOTHING * (mean - self.mean[i])
            self.sigma[i] = max(self.LEAST_SIGMA, self.sigma[i] + self.SMOOTHING * (sigma - self.sigma[i]))


def remembered(options):
    """Records of an earlier search in the same folder, by index; those of another search are refused."""
    about = {"vary": options.vary, "scenario": options.scenario, "seed": options.seed, "population": options.population}
    file = options.into / "search.json"
    if file.exists() and json.loads(file.read_text()) != about:
        refuse(f"--into: {options.into} holds another search, {file.read_text().strip()}")
    options.into.mkdir(parents=True, exist_ok=True)
    file.write_text(json.dumps(about) + "\n")
    lines = options.into / "evaluations.jsonl"
    records = {}
    for line in lines.read_text().splitlines() if lines.exists() else []:
        try:
            record = json.loads(line)
        except json.JSONDecodeError:
            continue  # cut off when the search was stopped
        records[record["index"]] = record
    return records


def search(options, base):
    end = time.monotonic() + 60 * options.minutes
    known = remembered(options)
    method = CrossEntropy(failure_space.dimensions(options.vary), options.seed)
    records = []
    with open(options.into / "evaluations.jsonl", "a") as log, \
            concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        def one(index, point):
            if index in known and known[index]["point"] == point:
                return known[index]
            if time.monotonic() > end:
                return None
            record = evaluate(options, base, index, point)
            log.write(json.dumps(record) + "\n")
            log.flush()
            return record

        while len(records) < options.evaluations:
            count = min(options.population, options.evaluations - len(records))
            points = [method.draw() for _ in range(count)]
            done = list(pool.map(one, range(len(records), len(records) + count), points))
            generation = [r for r in done if r]
            records += generation
            if len(generation) < count:
                break
            method.learn(generation)
            worst = min(r["score"] for r in records)
            print(f"{len(records)} runs, worst {worst:+.3f}, {sum('folder' in r for r in records)} touches", flush=True)
    return records


def main():
    options = arguments()
    base = base_of(options)
    missing = failure_space.missing(base, options.vary)
    if missing:
        refuse(f"--vary: {missing}")
    records = search(options, base)
    found = sorted((r for r in records if "folder" in r), key=lambda r: r["score"])
    broken = [r for r in records if "broken" in r]
    for r in found:
        touch = next(t for t in r["touches"] if t["kind"] in ("driven", "fell"))
        late = "never noticed" if touch["noticed_after_s"] is None else f"noticed after {touch['noticed_after_s']:.2f} s"
        print(f"{r['score']:+.3f}  {touch['kind']} {touch['thing']}, {late}  {r['again']}")
    print(f"{len(records)} runs in {options.into}: {len(found)} in which the base touched something, "
          f"{len(broken)} that could not run")
    if broken:
        print(f"  e.g. {broken[0]['broken']}", file=sys.stderr)
    sys.exit(0)


if __name__ == "__main__":
    main()
