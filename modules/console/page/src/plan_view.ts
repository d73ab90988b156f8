// The ground plan with everything that is known to stand or move on it.

import { colour, prepare } from "./dom";
import { Floor } from "./floor";
import { deadReckoned, ellipse, place, Pose2, sonarPose } from "./geometry";
import {
  DoorFound, DoorSeen, DriveStatus, Hello, LIMIT_SONAR, ObstacleLine, Path, Point, Pose, SCENE_EDGE, SceneObject, SonarRanges,
} from "./protocol";
import { Store } from "./store";
import { Place } from "./target";
import { ViewPort } from "./view_port";

const TRAIL_STEP_M = 0.03, LONGEST_TRAIL = 4000;
const SONAR_HALF_RAD = 0.13;
const LEAF_LEFT = 1;
const LEAST_DEPTH_M = 0.05;  // of a thing of which only the front was seen
const DOOR_STATES = ["", "closed", "ajar", "open"];

/** `0.6 x 0.4 m, 1.1 m high`; of a front alone `0.6 m wide, 1.1 m high`. */
function sizeText(thing: SceneObject): string {
  const size = thing.depth_m > 0 ? `${thing.width_m.toFixed(1)} x ${thing.depth_m.toFixed(1)} m` : `${thing.width_m.toFixed(1)} m wide`;
  return `${size}, ${thing.top_m.toFixed(1)} m high`;
}

export class PlanView {
  readonly port: ViewPort;
  follows = false;
  showsSonars = false;
  readonly floor = new Floor();
  target: () => Place | undefined = () => undefined;
  /** Places of the patrol that is being put together. */
  patrol: () => readonly Place[] = () => [];
  private hello: Hello | undefined;
  private trail: Point[] = [];
  private context!: CanvasRenderingContext2D;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly store: Store) {
    this.port = new ViewPort(canvas);
  }

  greet(hello: Hello): void {
    const other = JSON.stringify(this.hello?.plan) !== JSON.stringify(hello.plan);
    this.hello = hello;
    this.floor.restart();
    if (other || hello.replay !== undefined) this.forget();
    if (other) this.fit();
  }

  /** Forgets where the robot was. */
  forget(): void {
    this.trail = [];
  }

  fit(): void {
    if (this.hello !== undefined) this.port.fit([...this.hello.plan.walls.flat(), ...this.floor.extent]);
  }

  /** Keeps where the robot is now, also while another view is shown. */
  remember(): void {
    const robot = this.robotPose();
    if (robot === undefined || this.store.isStale("POSE")) return;
    const last = this.trail[this.trail.length - 1];
    if (last === undefined || Math.hypot(robot.x - last[0], robot.y - last[1]) > TRAIL_STEP_M)
      this.trail.push([robot.x, robot.y]);
    if (this.trail.length > LONGEST_TRAIL) this.trail.splice(0, LONGEST_TRAIL / 4);
  }

  draw(): void {
    this.context = prepare(this.canvas);
    this.drawGrid();
    if (this.hello === undefined) return;
    const robot = this.robotPose();
    if (robot !== undefined && this.follows) this.port.centre = [robot.x, robot.y];
    this.drawFloor();
    this.drawPlan(this.hello);
    this.drawObjects();
    this.drawFoundDoors();
    this.stroke(this.trail, colour("trail"), 2);
    this.drawPath();
    if (robot !== undefined) {
      if (this.showsSonars) this.drawSonars(robot, this.hello.body);
      this.drawObstacles(robot);
      this.drawRobot(robot, this.hello.body);
    }
    this.drawPatrol();
    this.drawTarget(this.hello.body);
    this.drawMeasure();
  }

  /** The measured distance [m]. */
  measured(): number | undefined {
    const ends = this.port.measured;
    return ends === undefined ? undefined : Math.hypot(ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]);
  }

  private robotPose(): Pose2 | undefined {
    const pose = this.store.get<Pose>("POSE");
    return pose === undefined ? undefined : deadReckoned(pose, this.store.age("POSE"));
  }

  private trace(points: Point[], closed: boolean): void {
    this.context.beginPath();
    for (const point of points) this.context.lineTo(...this.port.toScreen(point));
    if (closed) this.context.closePath();
  }

  private stroke(points: Point[], style: string, width: number, closed = false): void {
    this.trace(points, closed);
    this.context.strokeStyle = style;
    this.context.lineWidth = width;
    this.context.stroke();
  }

  private fill(points: Point[], style: string): void {
    this.trace(points, true);
    this.context.fillStyle = style;
    this.context.fill();
  }

  private drawGrid(): void {
    const [left, top] = this.port.toMap(0, 0);
    const [right, bottom] = this.port.toMap(this.canvas.clientWidth, this.canvas.clientHeight);
    const step = this.port.scale < 20 ? 5 : 1;
    const style = colour("grid");
    for (let x = Math.ceil(left / step) * step; x <= right; x += step) this.stroke([[x, top], [x, bottom]], style, 1);
    for (let y = Math.ceil(bottom / step) * step; y <= top; y += step) this.stroke([[left, y], [right, y]], style, 1);
  }

  /** What the planner learned: where it was free, walls that robots found, and where that ends. */
  private drawFloor(): void {
    const { floor, context } = this;
    context.save();
    this.port.useMapFrame(context);
    context.fillStyle = colour("seen");
    context.fill(floor.seen);
    context.restore();
    for (const wall of floor.walls) this.stroke([wall.from, wall.to], colour("learned"), 2.5);
    for (const edge of floor.edges) this.drawDot(edge.at, edge.left ? "stale" : "accent");
  }

  private drawDot(at: Point, style: string): void {
    const [u, v] = this.port.toScreen(at);
    this.context.beginPath();
    this.context.arc(u, v, 4, 0, 2 * Math.PI);
    this.context.fillStyle = colour(style);
    this.context.fill();
  }

  private drawPatrol(): void {
    const places = this.patrol();
    this.context.setLineDash([3, 4]);
    this.stroke(places.map((p): Point => [p.x, p.y]), colour("accent"), 1.5);
    this.context.setLineDash([]);
    places.forEach((p, i) => this.write(String(i + 1), [p.x + 0.05, p.y + 0.05], colour("accent")));
  }

  private drawPlan(hello: Hello): void {
    const wall = colour("wall"), landmark = colour("landmark");
    for (const corners of hello.plan.walls) this.fill(corners, wall);
    for (const cupboard of hello.plan.cupboards) this.stroke(cupboard.corners, landmark, 2, true);
    this.context.setLineDash([4, 4]);
    for (const area of hello.plan.no_go) this.stroke(area.corners, colour("bad"), 1.5, true);
    this.context.setLineDash([]);
    for (const area of hello.plan.no_go) this.write(area.name, area.corners[0], colour("bad"));
    for (const door of hello.plan.doors) {
      const pose = { x: door.x_m, y: door.y_m, yaw: door.yaw_rad };
      const d = door.depth_m / 2, w = door.width_m / 2;
      for (const side of [-1, 1])
        this.stroke([place(pose, -d, side * w), place(pose, d, side * w)], landmark, 3);
      this.drawLeaf(pose, door.id, d, w);
      this.write(door.name, place(pose, d + 0.1, w + 0.12), landmark);
    }
  }

  private drawLeaf(pose: Pose2, id: number, d: number, w: number): void {
    const seen = this.store.get<DoorSeen>(`DOOR_SEEN ${id}`);
    if (seen === undefined || seen.hinge === 0) return;
    const side = seen.hinge === LEAF_LEFT ? 1 : -1;
    const turned = Math.PI / 2 - seen.open_rad;  // closed it lies across the opening
    const end = place(pose, d + 2 * w * Math.cos(turned), side * (w - 2 * w * Math.sin(turned)));
    this.stroke([place(pose, d, side * w), end], colour("landmark"), 4);
  }

  /** Doors that the head found in passing: across the opening, dashed where one can go through. */
  private drawFoundDoors(): void {
    for (const { message: door } of this.store.all<DoorFound>("DOOR_FOUND")) {
      const pose = { x: door.x_m, y: door.y_m, yaw: door.yaw_rad };
      const words = DOOR_STATES[door.state] ?? "";
      this.context.setLineDash(words === "open" ? [3, 5] : []);
      this.stroke([place(pose, 0, -door.width_m / 2), place(pose, 0, door.width_m / 2)], colour("landmark"), 3);
      this.context.setLineDash([]);
      this.write(words, place(pose, 0.35, 0), colour("landmark"));
    }
  }

  /** Things that the head put together: what they cover of the floor, with their size; a single edge is a dot. */
  private drawObjects(): void {
    const style = colour("learned");
    for (const { message: thing } of this.store.all<SceneObject>("SCENE_OBJECT")) {
      if (thing.looks === 0) continue;  // it has gone
      if (thing.kind === SCENE_EDGE) {
        this.drawDot([thing.x_m, thing.y_m], "learned");
        continue;
      }
      const pose = { x: thing.x_m, y: thing.y_m, yaw: thing.yaw_rad };
      const w = thing.width_m / 2, d = Math.max(thing.depth_m, LEAST_DEPTH_M);
      const corners = [place(pose, 0, -w), place(pose, d, -w), place(pose, d, w), place(pose, 0, w)];
      this.context.globalAlpha = 0.25;
      this.fill(corners, style);
      this.context.globalAlpha = 1;
      this.stroke(corners, style, 1, true);
      const [x, y] = corners.reduce((a, b) => (b[0] > a[0] ? b : a));
      this.write(sizeText(thing), [x + 0.08, y], style);
    }
  }

  private drawPath(): void {
    const path = this.store.get<Path>("PATH");
    if (path === undefined || path.points.length === 0) return;
    this.context.setLineDash([8, 5]);
    this.stroke(path.points.map((p): Point => [p.x_m, p.y_m]), colour("path"), 2);
    this.context.setLineDash([]);
    const goal = path.points[path.points.length - 1];
    if (goal === undefined) return;
    const pose = { x: goal.x_m, y: goal.y_m, yaw: goal.yaw_rad };
    this.stroke([place(pose, -0.12, 0.1), place(pose, 0.12, 0), place(pose, -0.12, -0.1)], colour("path"), 2, true);
  }

  private drawSonars(robot: Pose2, body: Hello["body"]): void {
    const sonars = this.store.get<SonarRanges>("SONAR_RANGES");
    if (sonars === undefined) return;
    const age_s = this.store.age("SONAR_RANGES");
    this.context.globalAlpha = this.store.isStale("SONAR_RANGES") ? 0.12 : Math.max(0.25, 0.8 - age_s / 2);
    const style = colour(this.store.isStale("SONAR_RANGES") ? "stale" : "sonar");
    sonars.range_m.forEach((range, i) => {
      if (range < 0) return;
      const at = sonarPose(i, body.length_m, body.width_m);
      const [x, y] = place(robot, at.x, at.y);
      const beam = { x, y, yaw: robot.yaw + at.yaw };
      const arc = [-1, -0.5, 0, 0.5, 1].map((k) =>
        place(beam, range * Math.cos(k * SONAR_HALF_RAD), range * Math.sin(k * SONAR_HALF_RAD)));
      this.stroke(arc, style, 3);
      this.stroke([[x, y], place(beam, range, 0)], style, 0.7);
    });
    this.context.globalAlpha = 1;
  }

  private drawObstacles(robot: Pose2): void {
    const status = this.store.get<DriveStatus>("DRIVE_STATUS");
    if (status?.limit === LIMIT_SONAR && !this.store.isStale("DRIVE_STATUS"))
      this.drawDot(place(robot, status.nearest_x_m, status.nearest_y_m), "bad");  // what slows it down
    const line = this.store.get<ObstacleLine>("OBSTACLE_LINE");
    if (line === undefined || this.store.isStale("OBSTACLE_LINE")) return;
    for (const s of line.segments)
      this.stroke([place(robot, s.x1_m, s.y1_m), place(robot, s.x2_m, s.y2_m)], colour("bad"), 4);
  }

  private drawRobot(robot: Pose2, body: Hello["body"]): void {
    const style = colour(this.store.isStale("POSE") ? "stale" : "robot");
    const l = body.length_m / 2, w = body.width_m / 2;
    const corners = [place(robot, l, w), place(robot, -l, w), place(robot, -l, -w), place(robot, l, -w)];
    this.context.globalAlpha = 0.3;
    this.fill(corners, style);
    this.context.globalAlpha = 1;
    this.stroke(corners, style, 2, true);
    this.fill([place(robot, l * 0.8, 0), place(robot, l * 0.3, w * 0.4), place(robot, l * 0.3, -w * 0.4)], style);
    const pose = this.store.get<Pose>("POSE");
    if (pose === undefined) return;
    const { a, b, direction } = ellipse(pose, 3);
    const [u, v] = this.port.toScreen([robot.x, robot.y]);
    this.context.beginPath();
    this.context.ellipse(u, v, a * this.port.scale, b * this.port.scale, -direction, 0, 2 * Math.PI);
    this.context.stroke();
  }

  /** Where a person wants the robot, or says that it stands: its outline, or a cross when any heading will do. */
  private drawTarget(body: Hello["body"]): void {
    const target = this.target();
    if (target === undefined) return;
    const style = colour("accent"), pose = { x: target.x, y: target.y, yaw: target.yaw ?? 0 };
    const l = body.length_m / 2, w = body.width_m / 2;
    this.stroke([place(pose, -0.12, 0), place(pose, 0.12, 0)], style, 2);
    this.stroke([place(pose, 0, -0.12), place(pose, 0, 0.12)], style, 2);
    if (target.yaw === undefined) return;
    this.context.setLineDash([4, 4]);
    this.stroke([place(pose, l, w), place(pose, -l, w), place(pose, -l, -w), place(pose, l, -w)], style, 2, true);
    this.context.setLineDash([]);
    this.stroke([place(pose, l * 0.5, w * 0.4), place(pose, l * 0.9, 0), place(pose, l * 0.5, -w * 0.4)], style, 2);
  }

  private drawMeasure(): void {
    const ends = this.port.measured;
    if (ends !== undefined) this.stroke(ends, colour("accent"), 2);
  }

  private write(words: string, at: Point, style: string): void {
    this.context.fillStyle = style;
    this.context.font = "13px system-ui, sans-serif";
    this.context.fillText(words, ...this.port.toScreen(at));
  }
}
