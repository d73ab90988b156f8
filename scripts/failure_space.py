"""What scripts/find-failures varies: groups of parameters, each a number from 0 to 1 that a world is made of."""
import copy
import dataclasses
import math


@dataclasses.dataclass
class Base:
    """Contents of the files of a scenario, as tables."""
    scenario: dict
    robot: dict
    world: dict
    map: dict
    parameters: dict = dataclasses.field(default_factory=dict)


def mix(low, high, part):
    return low + part * (high - low)


def place(base, along, across):
    """A place on the way from the start to the door, `across` to the left of it [m]."""
    start, door = base.world["start"], target(base)
    dx, dy = door["x_m"] - start["x_m"], door["y_m"] - start["y_m"]
    length = math.hypot(dx, dy)
    return (start["x_m"] + along * dx - across * dy / length, start["y_m"] + along * dy + across * dx / length)


def target(base):
    wanted = base.scenario.get("landmark_id", 1)
    return next(d for d in base.map["doors"] if d.get("id", 1) == wanted)


def vary_start(b, p):
    start = b.world["start"]
    x, y = mix(-0.7, 0.7, p[0]), mix(-0.4, 0.4, p[1])
    start["x_m"] += x
    start["y_m"] += y
    start["yaw_deg"] = start.get("yaw_deg", 0.0) + mix(-25, 25, p[2])
    robot = next(q for q in b.scenario["process"] if q["module"] == "robot")
    robot["set"] = (f"localiser.estimator.initial={{x_m={start['x_m']:.4f},y_m={start['y_m']:.4f},"
                    f"yaw_deg={start['yaw_deg']:.3f},position_error_m=0.3,yaw_error_deg=8}}")
    return {"start_x_m": start["x_m"], "start_y_m": start["y_m"], "start_yaw_deg": start["yaw_deg"]}


def vary_light(b, p):
    light = b.world.setdefault("light", {})
    light["brightness"], light["window_yaw_deg"] = mix(0.3, 2.2, p[0]), mix(-180, 180, p[1])
    light["ambient"], light["window"] = mix(0.1, 0.5, p[2]), 0.4
    b.world["brightness_spread"] = b.world["window_spread_deg"] = 0.0
    return {"brightness": light["brightness"], "window_yaw_deg": light["window_yaw_deg"], "ambient": light["ambient"]}


def vary_wheels(b, p):
    factor = 0.5 * 6 ** p[0]
    base = b.robot.setdefault("robot", {}).setdefault("base", {})
    for key, nominal in (("radius_error", 0.008), ("lever_error", 0.01), ("lateral_loss", 0.03), ("roller_slip", 0.012)):
        base[key] = factor * base.get(key, nominal)
    return {"wheels": factor}


def vary_leaf(b, p):
    door = next(d for d in b.world["doors"] if d.get("id", 1) == target(b).get("id", 1))
    door["open_deg"], door["open_spread_deg"] = mix(60, 115, p[0]), 0.0
    return {"leaf_deg": door["open_deg"]}


def add_box(b, name, along, across, side, **more):
    x, y = place(b, along, across)
    b.world.setdefault("boxes", []).append({"name": name, "x_m": x, "y_m": y, "length_m": side, "width_m": side, **more})
    return {f"{name}_x_m": x, f"{name}_y_m": y, f"{name}_m": side}


def vary_post(b, p):
    return add_box(b, "post", mix(0.25, 0.95, p[0]), mix(-0.9, 0.9, p[1]), mix(0.02, 0.15, p[2]), height_m=1.2,
                   material="metal", yaw_deg=mix(0.0, 90.0, p[3]))


def vary_overhang(b, p):
    bottom = mix(0.05, 1.2, p[2])
    found = add_box(b, "overhang", mix(0.25, 0.85, p[0]), mix(-1.0, 1.0, p[1]), 0.7, height_m=0.05, bottom_m=bottom,
                    material="furniture")
    return found | {"overhang_bottom_m": bottom}


def vary_person(b, p):
    along, side = mix(0.2, 0.8, p[0]), 1.0 if p[1] < 0.5 else -1.0
    ends = [place(b, along, side * 1.4), place(b, mix(0.2, 0.8, p[4]), -side * 1.4)]
    speed, start_s = mix(0.3, 1.2, p[2]), mix(0.0, 15.0, p[3])
    b.world.setdefault("people", []).append({
        "name": "searcher", "speed_m_s": speed, "start_s": start_s, "attentive": True,
        "waypoints": [{"x_m": x, "y_m": y, "pause_s": 2.0} for x, y in ends]})
    return {"person_speed_m_s": speed, "person_start_s": start_s, "person_from_m": ends[0], "person_to_m": ends[1]}


def vary_sonar(b, p):
    sensor = 1 + min(23, int(24 * p[0]))
    kind = ("dead", "deaf", "stuck")[min(2, int(3 * p[1]))]
    faults = b.world.setdefault("faults", {}).setdefault("sonars", [])
    faults.append({"sensor": sensor, "kind": kind, "at_s": mix(0.0, 15.0, p[2])})
    return {"sonar": sensor, "sonar_kind": kind}


# Name, how many numbers it takes, what it does with them.
GROUPS = {"start": (3, vary_start), "light": (3, vary_light), "wheels": (1, vary_wheels), "leaf": (1, vary_leaf),
          "post": (4, vary_post), "overhang": (3, vary_overhang), "person": (5, vary_person), "sonar": (3, vary_sonar)}


def dimensions(groups):
    return sum(GROUPS[g][0] for g in groups)


def missing(base, groups):
    """What the scenario lacks for these groups, in words; empty: nothing."""
    if not base.map.get("doors"):
        return "expected a map with a door, got none"
    if "start" not in base.world:
        return "expected a world with a [start], got none"
    if "leaf" in groups and not base.world.get("doors"):
        return "leaf: expected a world that lists its doors, got none"
    return ""


def apply(base, groups, point):
    """The base with the parameters of a point; what is drawn relative to the start uses the varied start."""
    varied = copy.deepcopy(base)
    robot_world = next(q for q in varied.scenario["process"] if q["module"] == "world")
    robot_world["set"] = "world=worlds/failure.toml"
    at = 0
    for group in sorted(groups, key=list(GROUPS).index):
        count, act = GROUPS[group]
        varied.parameters.update(act(varied, point[at:at + count]))
        at += count
    return varied
