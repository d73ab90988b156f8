// Landmarks in space: the edges that the planner expects, and where the head found them.

import { place, Pose2 } from "./geometry";
import { Item, LandmarkFix, LandmarkModel, LookRequest, Pose } from "./protocol";
import { Spot } from "./mesh";

const FOUND = 0;
const REMEMBERED_S = 30, LOOK_S = 8;

export interface Segment { from: Spot; to: Spot; side: number }

function spot(pose: Pose2, x: number, y: number, z: number): Spot {
  return [...place(pose, x, y), z];
}

function segments(model: LandmarkModel, pose: Pose2): Segment[] {
  return model.edges.map((e) => ({
    from: spot(pose, e.x1_m, e.y1_m, e.z1_m), to: spot(pose, e.x2_m, e.y2_m, e.z2_m), side: e.side }));
}

export class Landmarks {
  private readonly models = new Map<number, LandmarkModel>();
  private readonly found = new Map<number, Pose2>();
  private poses: { t: number; pose: Pose2 }[] = [];
  private look: { t: number; request: LookRequest } | undefined;

  hear(item: Item, valid_s: number): void {
    if (item.channel === "LANDMARK_MODEL") {
      const model = item.message as unknown as LandmarkModel;
      this.models.set(model.landmark_id, model);
    }
    if (item.channel === "LOOK_REQUEST") this.look = { t: valid_s, request: item.message as unknown as LookRequest };
    if (item.channel === "LANDMARK_FIX") this.take(item.message as unknown as LandmarkFix, valid_s);
    if (item.channel !== "POSE") return;
    const pose = item.message as unknown as Pose;
    this.poses = this.poses.filter(({ t }) => t > valid_s - REMEMBERED_S && t < valid_s);
    this.poses.push({ t: valid_s, pose: { x: pose.x_m, y: pose.y_m, yaw: pose.yaw_rad } });
  }

  restart(): void {
    this.poses = [];
    this.found.clear();
    this.look = undefined;
  }

  expected(): Segment[] {
    return [...this.models.values()].flatMap((model) =>
      segments(model, { x: model.x_m, y: model.y_m, yaw: model.yaw_rad }));
  }

  matched(): Segment[] {
    return [...this.found].flatMap(([id, pose]) => {
      const model = this.models.get(id);
      return model === undefined ? [] : segments(model, pose);
    });
  }

  /** Corners of what the head was asked to look at just now: the part of a landmark's front. */
  lookedAt(now_s: number): Spot[] {
    if (this.look === undefined || now_s - this.look.t > LOOK_S) return [];
    const { landmark_id, side } = this.look.request, model = this.models.get(landmark_id);
    if (model === undefined) return [];
    const edges = model.edges.filter((e) => side === 0 || e.side === 0 || e.side === side);
    const ys = edges.flatMap((e) => [e.y1_m, e.y2_m]), zs = edges.flatMap((e) => [e.z1_m, e.z2_m]);
    if (ys.length === 0) return [];
    const [left, right] = [Math.max(...ys), Math.min(...ys)], [low, high] = [Math.min(...zs), Math.max(...zs)];
    const pose = { x: model.x_m, y: model.y_m, yaw: model.yaw_rad };
    return [spot(pose, 0, left, low), spot(pose, 0, right, low), spot(pose, 0, right, high), spot(pose, 0, left, high)];
  }

  /** The fix is relative to the base at the moment of the exposure. */
  private take(fix: LandmarkFix, valid_s: number): void {
    if (fix.verdict !== FOUND || this.poses.length === 0) return;
    const nearest = this.poses.reduce((a, b) => Math.abs(a.t - valid_s) <= Math.abs(b.t - valid_s) ? a : b).pose;
    const [x, y] = place(nearest, fix.x_m, fix.y_m);
    this.found.set(fix.landmark_id, { x, y, yaw: nearest.yaw + fix.yaw_rad });
  }
}
