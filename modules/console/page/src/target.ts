// A place on the plan that a person chooses: to send the robot there, or to say that it stands there.

import { byId } from "./dom";
import { Point } from "./protocol";
import { Pick, ViewPort } from "./view_port";

const LEAST_ARROW_M = 0.15;  // a shorter drag chooses a place without a heading

export interface Place { x: number; y: number; yaw: number | undefined }  // m, rad

/** A button that has the next drag on the plan choose a place; pressed again, it does not. */
export function togglePick(button: HTMLButtonElement, port: ViewPort, act: Pick): void {
  if (button.getAttribute("aria-pressed") === "true") return port.endPick();
  port.beginPick(act, () => button.setAttribute("aria-pressed", "false"));
  button.setAttribute("aria-pressed", "true");
}

export class Target {
  private readonly button = byId<HTMLButtonElement>("pick");
  private readonly fields = ["target-x", "target-y", "target-yaw"].map((id) => byId<HTMLInputElement>(id));

  constructor(private readonly port: ViewPort) {
    this.button.addEventListener("click", () => togglePick(this.button, this.port, (from, to) => this.pick(from, to)));
  }

  /** What the fields say; undefined while they do not name a place. */
  place(): Place | undefined {
    const [x, y, degrees] = this.fields.map((field) => field.validity.valid ? field.valueAsNumber : NaN);
    if (x === undefined || y === undefined || Number.isNaN(x) || Number.isNaN(y)) return undefined;
    if (this.fields[2]?.validity.valid === false) return undefined;
    return { x, y, yaw: degrees === undefined || Number.isNaN(degrees) ? undefined : degrees * Math.PI / 180 };
  }

  private pick(from: Point, to: Point): void {
    const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    const degrees = Math.hypot(dx, dy) < LEAST_ARROW_M ? "" : String(Math.round(Math.atan2(dy, dx) * 180 / Math.PI));
    [from[0].toFixed(2), from[1].toFixed(2), degrees].forEach((value, i) => {
      const field = this.fields[i];
      if (field !== undefined) field.value = value;
    });
  }
}
