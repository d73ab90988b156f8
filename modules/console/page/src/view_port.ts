// Which part of the plan the canvas shows: dragging, zooming, measuring.

import { Point } from "./protocol";

const LEAST = 2, MOST = 1200;  // pixels per metre

/** A drag that chooses a place: where it began, where it is, whether it ended. */
export type Pick = (from: Point, to: Point, done: boolean) => void;

export class ViewPort {
  scale = 60;  // pixels per metre
  centre: Point = [0, 0];
  measured: [Point, Point] | undefined;
  onUserMove: () => void = () => undefined;
  onPicked: () => void = () => undefined;
  private picking: { act: Pick; ended: () => void } | undefined;

  constructor(private readonly canvas: HTMLCanvasElement) {
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoomAt(Math.exp(-event.deltaY / 400), event.offsetX, event.offsetY);
    }, { passive: false });
    canvas.addEventListener("pointerdown", (event) => this.drag(event));
    canvas.addEventListener("keydown", (event) => {
      if (event.key === "+") this.zoom(1.25);
      if (event.key === "-") this.zoom(0.8);
    });
  }

  toScreen([x, y]: Point): Point {
    return [this.canvas.clientWidth / 2 + (x - this.centre[0]) * this.scale,
      this.canvas.clientHeight / 2 - (y - this.centre[1]) * this.scale];
  }

  toMap(u: number, v: number): Point {
    return [this.centre[0] + (u - this.canvas.clientWidth / 2) / this.scale,
      this.centre[1] - (v - this.canvas.clientHeight / 2) / this.scale];
  }

  /** From now on one unit of the context is a metre of the map. */
  useMapFrame(context: CanvasRenderingContext2D): void {
    const [u, v] = this.toScreen([0, 0]);
    context.transform(this.scale, 0, 0, -this.scale, u, v);
  }

  /** The next drag chooses a place instead of moving the plan. `ended`: it was chosen, or somebody else chooses now. */
  beginPick(act: Pick, ended: () => void): void {
    this.endPick();
    this.picking = { act, ended };
  }

  endPick(): void {
    const before = this.picking;
    this.picking = undefined;
    before?.ended();
  }

  zoom(factor: number): void {
    this.zoomAt(factor, this.canvas.clientWidth / 2, this.canvas.clientHeight / 2);
  }

  fit(points: Point[]): void {
    if (points.length === 0) return;
    const xs = points.map((p) => p[0]), ys = points.map((p) => p[1]);
    const [left, right] = [Math.min(...xs), Math.max(...xs)], [low, high] = [Math.min(...ys), Math.max(...ys)];
    this.centre = [(left + right) / 2, (low + high) / 2];
    const fits = Math.min(this.canvas.clientWidth / (right - left + 0.6), this.canvas.clientHeight / (high - low + 0.6));
    this.scale = Math.min(MOST, Math.max(LEAST, fits));
  }

  private zoomAt(factor: number, u: number, v: number): void {
    const before = this.toMap(u, v);
    this.scale = Math.min(MOST, Math.max(LEAST, this.scale * factor));
    const after = this.toMap(u, v);
    this.centre = [this.centre[0] + before[0] - after[0], this.centre[1] + before[1] - after[1]];
  }

  private drag(start: PointerEvent): void {
    const from = this.toMap(start.offsetX, start.offsetY);
    const pick = this.picking?.act, measures = pick === undefined && start.shiftKey;
    this.measured = measures ? [from, from] : undefined;
    this.canvas.setPointerCapture(start.pointerId);
    const move = (event: PointerEvent): void => {
      const here = this.toMap(event.offsetX, event.offsetY);
      if (pick !== undefined) return pick(from, here, false);
      if (measures) this.measured = [from, here];
      else this.centre = [this.centre[0] + from[0] - here[0], this.centre[1] + from[1] - here[1]];
      if (!measures) this.onUserMove();
    };
    const end = (event: PointerEvent): void => {
      if (pick !== undefined) {
        pick(from, this.toMap(event.offsetX, event.offsetY), true);
        this.endPick();
        this.onPicked();
      }
      this.canvas.removeEventListener("pointermove", move);
      this.canvas.removeEventListener("pointerup", end);
      this.canvas.removeEventListener("pointercancel", end);
    };
    this.canvas.addEventListener("pointermove", move);
    this.canvas.addEventListener("pointerup", end);
    this.canvas.addEventListener("pointercancel", end);
  }
}
