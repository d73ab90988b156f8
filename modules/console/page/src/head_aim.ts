// Where the head looks, and where a person has it look: sliders, or a place on the plan.

import { byId, setText } from "./dom";
import { deadReckoned, place } from "./geometry";
import { Hello, HeadState, Point, Pose } from "./protocol";
import { Store } from "./store";
import { togglePick } from "./target";
import { ageText, number, text } from "./text";
import { ViewPort } from "./view_port";

const LOOKED_AT_M = 1.0;  // height of what is looked at: a door's middle
const MOST_PAN = 2, MOST_TILT = 0.8;
const DEGREE = Math.PI / 180;
const AXES = ["pan", "tilt", "zoom", "focus"] as const;
type Axis = typeof AXES[number];

export interface Aim { pan_rad: number; tilt_rad: number; zoom_step?: number; focus_step?: number }

export interface AimMeans {
  mayOrder(): boolean;
  aim(aim: Aim): void;
  hello(): Hello | undefined;
}

function clamp(value: number, most: number): number {
  return Math.max(-most, Math.min(most, value));
}

export class HeadAim {
  private held: Axis | undefined;  // slider under the hand: it does not follow the head

  constructor(private readonly store: Store, port: ViewPort, private readonly means: AimMeans) {
    for (const axis of AXES) this.bind(axis);
    byId("look-ahead").addEventListener("click", () => this.means.aim({ pan_rad: 0, tilt_rad: 0 }));
    const there = byId<HTMLButtonElement>("look-there");
    there.addEventListener("click", () => togglePick(there, port, (_from, to, done) => { if (done) this.lookAt(to); }));
  }

  draw(): void {
    const may = this.means.mayOrder();
    for (const id of ["look-ahead", "look-there"]) byId<HTMLButtonElement>(id).disabled = !may;
    for (const axis of AXES) this.slider(axis).disabled = !may;
    const state = this.store.get<HeadState>("HEAD_STATE");
    if (state !== undefined) this.follow(state);
    const shown = byId("head-state");
    setText(shown, state === undefined ? text("never") : `${this.words(state)} (${ageText(this.store.age("HEAD_STATE"))})`);
    shown.classList.toggle("stale", this.store.isStale("HEAD_STATE"));
  }

  /** The left camera speaks for both. */
  private follow(state: HeadState): void {
    const values = { pan: state.pan_rad / DEGREE, tilt: state.tilt_rad / DEGREE, zoom: state.zoom_step[0] ?? 0, focus: state.focus_step[0] ?? 0 };
    for (const axis of AXES) if (axis !== this.held) this.slider(axis).value = String(Math.round(values[axis]));
  }

  private words(state: HeadState): string {
    const degrees = (rad: number): string => `${number(rad / DEGREE, 1)}°`;
    return `${text("pan")} ${degrees(state.pan_rad)}, ${text("tilt")} ${degrees(state.tilt_rad)}, ` +
      `${text("zoom")} ${state.zoom_step.join(" / ")}, ${text("focus")} ${state.focus_step.join(" / ")}`;
  }

  private slider(axis: Axis): HTMLInputElement {
    return byId<HTMLInputElement>(`head-${axis}`);
  }

  private bind(axis: Axis): void {
    const slider = this.slider(axis);
    slider.addEventListener("input", () => { this.held = axis; });
    slider.addEventListener("change", () => {
      this.held = undefined;
      this.means.aim(this.wish(axis));
    });
  }

  /** Zoom and focus are only named when they are what is changed. */
  private wish(axis: Axis): Aim {
    const aim: Aim = { pan_rad: this.slider("pan").valueAsNumber * DEGREE, tilt_rad: this.slider("tilt").valueAsNumber * DEGREE };
    if (axis === "zoom") aim.zoom_step = this.slider("zoom").valueAsNumber;
    if (axis === "focus") aim.focus_step = this.slider("focus").valueAsNumber;
    return aim;
  }

  private lookAt([x, y]: Point): void {
    const pose = this.store.get<Pose>("POSE");
    if (pose === undefined) return;
    const robot = deadReckoned(pose, this.store.age("POSE"));
    const head = this.means.hello()?.head ?? { x_m: 0, y_m: 0, z_m: LOOKED_AT_M };
    const [hx, hy] = place(robot, head.x_m, head.y_m);
    const turned = Math.atan2(y - hy, x - hx) - robot.yaw;
    const pan = Math.atan2(Math.sin(turned), Math.cos(turned));
    const tilt = Math.atan2(head.z_m - LOOKED_AT_M, Math.hypot(x - hx, y - hy));
    this.means.aim({ pan_rad: clamp(pan, MOST_PAN), tilt_rad: clamp(tilt, MOST_TILT) });
  }
}
