// What the planner learned of the floor: it comes in parts, which are put together once all are there.

import { FloorMap, Item, Point } from "./protocol";

export interface Line { from: Point; to: Point }
export interface FloorEdge { at: Point; length_m: number; left: boolean }

export class Floor {
  walls: Line[] = [];
  edges: FloorEdge[] = [];
  /** What was seen to be free: map frame, to be filled. */
  seen = new Path2D();
  /** Corners of what was seen. */
  extent: Point[] = [];
  private parts: FloorMap[] = [];

  hear(item: Item): void {
    if (item.channel !== "FLOOR_MAP") return;
    const part = item.message as unknown as FloorMap;
    if (this.parts[0]?.revision !== part.revision) this.parts = [];
    this.parts = [...this.parts.filter((p) => p.part !== part.part), part];
    if (this.parts.length === part.n_parts) this.take();
  }

  restart(): void {
    this.parts = [];
    this.take();
  }

  private take(): void {
    this.walls = this.parts.flatMap((p) => p.walls.map((w): Line => ({ from: [w.x1_m, w.y1_m], to: [w.x2_m, w.y2_m] })));
    this.edges = this.parts.flatMap((p) => p.frontiers.map((f) => ({ at: [f.x_m, f.y_m] as Point, length_m: f.length_m, left: f.left })));
    this.seen = new Path2D();
    this.extent = this.walls.flatMap((w) => [w.from, w.to]);
    for (const part of this.parts) for (const run of part.runs) {
      const x = part.x_m + run.first * part.cell_m, y = part.y_m + run.row * part.cell_m;
      this.seen.rect(x, y, run.length * part.cell_m, part.cell_m);
      this.extent.push([x, y], [x + run.length * part.cell_m, y + part.cell_m]);
    }
  }
}
