// The eye of the 3-D view: it looks at a place from a distance, and is turned around it.

import { Point } from "./protocol";

const LEAST_M = 1, MOST_M = 150, NEAR_M = 0.05, FAR_M = 400;
const FIELD_RAD = 0.9;

export class Orbit {
  at: Point = [0, 0];
  private distance_m = 8;
  private azimuth_rad = -2;
  private elevation_rad = 0.9;
  onUserMove: () => void = () => undefined;

  constructor(private readonly canvas: HTMLCanvasElement) {
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(event.deltaY / 400));
    }, { passive: false });
    canvas.addEventListener("pointerdown", (event) => this.drag(event));
  }

  turn(azimuth_rad: number, elevation_rad: number): void {
    this.azimuth_rad += azimuth_rad;
    this.elevation_rad = Math.min(1.55, Math.max(0.08, this.elevation_rad + elevation_rad));
  }

  zoom(factor: number): void {
    this.distance_m = Math.min(MOST_M, Math.max(LEAST_M, this.distance_m * factor));
  }

  fit(points: Point[]): void {
    if (points.length === 0) return;
    const xs = points.map((p) => p[0]), ys = points.map((p) => p[1]);
    const [left, right] = [Math.min(...xs), Math.max(...xs)], [low, high] = [Math.min(...ys), Math.max(...ys)];
    this.at = [(left + right) / 2, (low + high) / 2];
    this.distance_m = Math.min(MOST_M, 0.95 * Math.hypot(right - left, high - low));
  }

  /** From the map to the screen, column by column. */
  matrix(): Float32Array {
    const [ca, sa, ce, se] = [Math.cos(this.azimuth_rad), Math.sin(this.azimuth_rad),
      Math.cos(this.elevation_rad), Math.sin(this.elevation_rad)];
    const back = [ce * ca, ce * sa, se], right = [-sa, ca, 0], up = [-se * ca, -se * sa, ce];
    const eye = [this.at[0] + this.distance_m * ce * ca, this.at[1] + this.distance_m * ce * sa, this.distance_m * se];
    const minus = (axis: number[]): number => -axis.reduce((sum, v, i) => sum + v * (eye[i] ?? 0), 0);
    const fy = 1 / Math.tan(FIELD_RAD / 2), fx = fy * this.canvas.clientHeight / Math.max(1, this.canvas.clientWidth);
    const c = (FAR_M + NEAR_M) / (NEAR_M - FAR_M), d = 2 * FAR_M * NEAR_M / (NEAR_M - FAR_M);
    const columns: number[] = [];
    for (let i = 0; i < 3; ++i) columns.push(fx * (right[i] ?? 0), fy * (up[i] ?? 0), c * (back[i] ?? 0), -(back[i] ?? 0));
    return new Float32Array([...columns, fx * minus(right), fy * minus(up), c * minus(back) + d, -minus(back)]);
  }

  private drag(start: PointerEvent): void {
    let [u, v] = [start.clientX, start.clientY];
    this.canvas.setPointerCapture(start.pointerId);
    const move = (event: PointerEvent): void => {
      const [du, dv] = [event.clientX - u, event.clientY - v];
      [u, v] = [event.clientX, event.clientY];
      if (event.shiftKey) this.shift(du, dv);
      else this.turn(-du / 200, dv / 200);
    };
    const end = (): void => this.canvas.removeEventListener("pointermove", move);
    this.canvas.addEventListener("pointermove", move);
    for (const name of ["pointerup", "pointercancel"]) this.canvas.addEventListener(name, end, { once: true });
  }

  /** The floor follows the pointer. */
  private shift(du: number, dv: number): void {
    const m = this.distance_m * Math.tan(FIELD_RAD / 2) * 2 / Math.max(1, this.canvas.clientHeight);
    const [c, s] = [Math.cos(this.azimuth_rad), Math.sin(this.azimuth_rad)];
    const away = dv * m / Math.max(0.2, Math.sin(this.elevation_rad));
    this.at = [this.at[0] + s * du * m - c * away, this.at[1] - c * du * m - s * away];
    this.onUserMove();
  }
}
