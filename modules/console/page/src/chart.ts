// A chart of numbers over time, on a canvas.

import { colour, prepare } from "./dom";
import { Sample, Series, ticks } from "./series";

const LEFT = 58, RIGHT = 8, TOP = 8, BOTTOM = 22;
const COLOURS = 6;
const SILENCE_S = 5, DOT_EVERY_PX = 10;

export interface Frame { from: number; to: number; cursor: number | undefined; unit: string; hint: string }  // s

export function lineColour(index: number): string {
  return colour(`line-${index % COLOURS + 1}`);
}

/** Least and largest of what is shown, with room around it; a chart without numbers shows 0 to 1. */
export function range(lines: Sample[][]): [number, number] {
  let low = Infinity, high = -Infinity;
  for (const line of lines)
    for (const sample of line) {
      low = Math.min(low, sample.v);
      high = Math.max(high, sample.v);
    }
  if (low > high) return [0, 1];
  const room = high > low ? (high - low) * 0.08 : Math.max(Math.abs(high) * 0.1, 0.5);
  return [low - room, high + room];
}

export class Chart {
  readonly series: Series[] = [];
  private context!: CanvasRenderingContext2D;

  constructor(readonly canvas: HTMLCanvasElement, private readonly write: (value: number, digits: number) => string) {}

  draw(frame: Frame): void {
    if (this.canvas.clientWidth === 0) return;
    this.context = prepare(this.canvas);
    const lines = this.series.map((series) => series.between(frame.from, frame.to));
    const [low, high] = range(lines);
    const right = this.canvas.clientWidth - RIGHT, bottom = this.canvas.clientHeight - BOTTOM;
    const x = (t: number): number => LEFT + (t - frame.from) / (frame.to - frame.from) * (right - LEFT);
    const y = (v: number): number => bottom - (v - low) / (high - low) * (bottom - TOP);
    this.drawValues(low, high, y, right, frame.unit);
    this.drawTimes(frame, x, bottom);
    this.context.font = "15px system-ui, sans-serif";
    this.context.fillText(frame.hint, (LEFT + right) / 2, bottom / 2, right - LEFT);
    this.context.save();
    this.context.beginPath();
    this.context.rect(LEFT, 0, right - LEFT, bottom + 1);
    this.context.clip();
    lines.forEach((line, i) => this.drawLine(line, i, x, y));
    if (frame.cursor !== undefined) this.segment([x(frame.cursor), TOP], [x(frame.cursor), bottom], colour("soft"), 1);
    this.context.restore();
  }

  /** The time at a place of the canvas [s]. */
  timeAt(u: number, frame: Frame): number {
    const share = (u - LEFT) / (this.canvas.clientWidth - RIGHT - LEFT);
    return frame.from + Math.min(1, Math.max(0, share)) * (frame.to - frame.from);
  }

  private segment(from: [number, number], to: [number, number], style: string, width: number): void {
    this.context.beginPath();
    this.context.moveTo(...from);
    this.context.lineTo(...to);
    this.context.strokeStyle = style;
    this.context.lineWidth = width;
    this.context.stroke();
  }

  private drawValues(low: number, high: number, y: (v: number) => number, right: number, unit: string): void {
    const { values, digits } = ticks(low, high, this.canvas.clientHeight / 45);
    this.context.font = "12px system-ui, sans-serif";
    this.context.textAlign = "right";
    this.context.textBaseline = "middle";
    for (const value of values) {
      this.segment([LEFT, y(value)], [right, y(value)], colour("line"), 1);
      this.context.fillStyle = colour("soft");
      this.context.fillText(this.write(value, digits), LEFT - 6, y(value));
    }
    this.context.textAlign = "left";
    this.context.textBaseline = "top";
    this.context.fillText(unit, LEFT + 4, TOP);
  }

  private drawTimes(frame: Frame, x: (t: number) => number, bottom: number): void {
    const { values, digits } = ticks(frame.from - frame.to, 0, this.canvas.clientWidth / 110);
    this.context.textAlign = "center";
    this.context.textBaseline = "top";
    for (const ago of values) {
      this.segment([x(frame.to + ago), TOP], [x(frame.to + ago), bottom], colour("grid"), 1);
      this.context.fillStyle = colour("soft");
      this.context.fillText(`${this.write(ago, digits)} s`, Math.min(x(frame.to + ago), this.canvas.clientWidth - 22), bottom + 5);
    }
  }

  /** Straight lines between samples, none across a silence; samples that stand apart are dots too. */
  private drawLine(line: Sample[], index: number, x: (t: number) => number, y: (v: number) => number): void {
    const style = lineColour(index);
    this.context.beginPath();
    let before: Sample | undefined;
    for (const sample of line) {
      if (before === undefined || sample.t - before.t > SILENCE_S) this.context.moveTo(x(sample.t), y(sample.v));
      else this.context.lineTo(x(sample.t), y(sample.v));
      before = sample;
    }
    this.context.strokeStyle = style;
    this.context.lineWidth = 2;
    this.context.setLineDash(index >= COLOURS ? [6, 4] : []);
    this.context.stroke();
    this.context.setLineDash([]);
    if (line.length * DOT_EVERY_PX > this.canvas.clientWidth) return;
    this.context.fillStyle = style;
    for (const sample of line) this.context.fillRect(x(sample.t) - 2, y(sample.v) - 2, 4, 4);
  }
}
