// The 3-D view: plan, robot, path, sonars, what the head looks at, and the edges it found. Loaded when it is opened first.

import { colour, setText } from "./dom";
import { deadReckoned, place, Pose2, sonarPose } from "./geometry";
import { GlCanvas } from "./gl_canvas";
import { Landmarks } from "./landmarks";
import { addFace, addLine, addPolyline, addPrism, Mesh, Spot, tint } from "./mesh";
import { Orbit } from "./orbit";
import { HeadState, Hello, Item, Path, Point, Pose, SonarRanges } from "./protocol";
import type { PageServices, View } from "./views";

const WALL_M = 1.0, DOOR_M = 2.0, CUPBOARD_M = 1.8, LEARNED_M = 0.8, BODY_M = 0.5, SONAR_M = 0.4;
const TURN_RAD = 0.15, LINE_PX = 1.6;
const ON_REQUEST = ["SONAR_RANGES", "HEAD_STATE"];
// Of the pyramid that shows where the head looks: half its angles, and how far it is drawn.
const HALF_WIDE_RAD = 0.3, HALF_HIGH_RAD = 0.22, SIGHT_M = 2.5;

export function open(element: HTMLElement, page: PageServices): View {
  return new Space(element, page);
}

class Space implements View {
  private readonly canvas = document.createElement("canvas");
  private readonly tools = document.createElement("div");
  private readonly follow = document.createElement("input");
  private readonly labels: (() => void)[] = [];
  private readonly orbit = new Orbit(this.canvas);
  private readonly landmarks = new Landmarks();
  private gl: GlCanvas | undefined;

  constructor(element: HTMLElement, private readonly page: PageServices) {
    this.tools.className = "tools";
    this.canvas.id = "space";
    this.canvas.setAttribute("role", "img");
    this.buildTools();
    element.append(this.tools, this.canvas);
    try {
      this.gl = new GlCanvas(this.canvas);
    } catch {
      this.labels.push(() => setText(this.tools, page.text("noSpace")));
    }
    page.store.each((item, valid_s) => this.hear(item, valid_s));
    this.fit();
    this.orbit.onUserMove = () => { this.follow.checked = false; };
    this.label();
  }

  show(on: boolean): void {
    this.page.want("space", ON_REQUEST, on);
  }

  hear(item: Item, valid_s: number): void {
    this.landmarks.hear(item, valid_s);
  }

  restart(): void {
    if (this.page.hello()?.replay !== undefined) this.landmarks.restart();
  }

  label(): void {
    for (const label of this.labels) label();
    this.canvas.setAttribute("aria-label", this.page.text("spaceHelp"));
    this.canvas.title = this.page.text("spaceHelp");
  }

  draw(): void {
    const hello = this.page.hello();
    if (this.gl === undefined || hello === undefined || this.canvas.clientWidth === 0) return;
    const solid: Mesh = { values: [] }, lines: Mesh = { values: [] }, clear: Mesh = { values: [] };
    const robot = this.robot();
    if (robot !== undefined && this.follow.checked) this.orbit.at = [robot.x, robot.y];
    this.addPlan(hello, solid, lines);
    this.addPath(lines);
    for (const edge of this.landmarks.expected()) addLine(lines, edge.from, edge.to, tint(colour("stale")));
    for (const edge of this.landmarks.matched()) addLine(lines, edge.from, edge.to, tint(colour("good")));
    if (robot !== undefined) this.addRobot(hello, robot, solid, lines, clear);
    this.gl.draw(this.orbit.matrix(), solid, lines, clear, LINE_PX);
  }

  private buildTools(): void {
    const button = (sign: string, word: Parameters<PageServices["text"]>[0], act: () => void): void => {
      const element = document.createElement("button");
      element.type = "button";
      element.textContent = sign;
      element.addEventListener("click", act);
      this.labels.push(() => element.setAttribute("aria-label", this.page.text(word)));
      this.tools.append(element);
    };
    const label = document.createElement("label"), words = document.createElement("span");
    this.follow.type = "checkbox";
    label.append(this.follow, " ", words);
    this.labels.push(() => setText(words, this.page.text("follow")));
    this.tools.append(label);
    button("↺", "turnLeft", () => this.orbit.turn(-TURN_RAD, 0));
    button("↻", "turnRight", () => this.orbit.turn(TURN_RAD, 0));
    button("↑", "higher", () => this.orbit.turn(0, TURN_RAD));
    button("↓", "lower", () => this.orbit.turn(0, -TURN_RAD));
    button("+", "nearer", () => this.orbit.zoom(0.8));
    button("−", "farther", () => this.orbit.zoom(1.25));
    button("⌂", "fit", () => this.fit());
  }

  private fit(): void {
    this.orbit.fit(this.page.hello()?.plan.walls.flat().concat(this.page.floor().extent) ?? []);
  }

  private robot(): Pose2 | undefined {
    const pose = this.page.store.get<Pose>("POSE");
    return pose === undefined ? undefined : deadReckoned(pose, this.page.store.age("POSE"));
  }

  private addPlan(hello: Hello, solid: Mesh, lines: Mesh): void {
    const wall = tint(colour("wall")), wood = tint(colour("landmark")), learned = tint(colour("learned"));
    for (const corners of hello.plan.walls) addPrism(solid, corners, 0, WALL_M, wall);
    for (const { from, to } of this.page.floor().walls)
      addPolyline(lines, [[...from, 0], [...to, 0], [...to, LEARNED_M], [...from, LEARNED_M], [...from, 0]], learned);
    for (const cupboard of hello.plan.cupboards) addPrism(solid, cupboard.corners, 0, CUPBOARD_M, wood);
    for (const door of hello.plan.doors) {
      const pose = { x: door.x_m, y: door.y_m, yaw: door.yaw_rad };
      const post = (side: number, z: number): Spot => [...place(pose, 0, side * door.width_m / 2), z];
      addPolyline(lines, [post(1, 0), post(1, DOOR_M), post(-1, DOOR_M), post(-1, 0)], wood);
    }
  }

  private addPath(lines: Mesh): void {
    const points = this.page.store.get<Path>("PATH")?.points ?? [];
    addPolyline(lines, points.map((p): Spot => [p.x_m, p.y_m, 0.03]), tint(colour("path")));
  }

  private addRobot(hello: Hello, robot: Pose2, solid: Mesh, lines: Mesh, clear: Mesh): void {
    const style = tint(colour(this.page.store.isStale("POSE") ? "stale" : "robot"));
    const l = hello.body.length_m / 2, w = hello.body.width_m / 2;
    const box = (x1: number, x2: number, y: number): Point[] =>
      [place(robot, x2, y), place(robot, x1, y), place(robot, x1, -y), place(robot, x2, -y)];
    addPrism(solid, box(-l, l, w), 0.05, BODY_M, style);
    addFace(solid, [[...place(robot, l * 0.8, 0), BODY_M + 0.01], [...place(robot, l * 0.3, w * 0.4), BODY_M + 0.01],
      [...place(robot, l * 0.3, -w * 0.4), BODY_M + 0.01]], tint(colour("accent-text")));
    const { x_m, y_m, z_m } = hello.head ?? { x_m: 0.25, y_m: 0, z_m: 1.2 };
    addPrism(solid, box(x_m - 0.04, x_m + 0.04, 0.04), BODY_M, z_m - 0.05, style);
    addPrism(solid, box(x_m - 0.06, x_m + 0.08, 0.2), z_m - 0.05, z_m + 0.05, style);
    this.addSonars(hello, robot, lines);
    const eye: Spot = [...place(robot, x_m, y_m), z_m];
    this.addSight(eye, this.landmarks.lookedAt(this.page.now()), lines, clear);
    this.addSight(eye, this.facing(robot, eye), lines, clear);
  }

  /** Corners of what the head faces; none while that is not known, or old. */
  private facing(robot: Pose2, eye: Spot): Spot[] {
    const head = this.page.store.get<HeadState>("HEAD_STATE");
    if (head === undefined || this.page.store.isStale("HEAD_STATE")) return [];
    const corner = (side: number, down: number): Spot => {
      const yaw = robot.yaw + head.pan_rad + side * HALF_WIDE_RAD, tilt = head.tilt_rad + down * HALF_HIGH_RAD;
      const flat = SIGHT_M * Math.cos(tilt);
      return [eye[0] + flat * Math.cos(yaw), eye[1] + flat * Math.sin(yaw), eye[2] - SIGHT_M * Math.sin(tilt)];
    };
    return [corner(1, 1), corner(-1, 1), corner(-1, -1), corner(1, -1)];
  }

  private addSonars(hello: Hello, robot: Pose2, lines: Mesh): void {
    const sonars = this.page.store.get<SonarRanges>("SONAR_RANGES");
    if (sonars === undefined || this.page.store.isStale("SONAR_RANGES")) return;
    sonars.range_m.forEach((range, i) => {
      if (range < 0) return;
      const at = sonarPose(i, hello.body.length_m, hello.body.width_m);
      const [x, y] = place(robot, at.x, at.y), beam = { x, y, yaw: robot.yaw + at.yaw };
      addLine(lines, [x, y, SONAR_M], [...place(beam, range, 0), SONAR_M], tint(colour("sonar")));
    });
  }

  /** From the head to the corners of what it looks at, or was asked to. */
  private addSight(eye: Spot, corners: Spot[], lines: Mesh, clear: Mesh): void {
    const style = colour("accent");
    corners.forEach((corner, i) => {
      addLine(lines, eye, corner, tint(style));
      addFace(clear, [eye, corner, corners[(i + 1) % corners.length] ?? corner], tint(style, 0.14));
    });
    addPolyline(lines, corners, tint(style));
  }
}
