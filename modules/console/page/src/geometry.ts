// Poses in the plane, and where the robot is between two reports.

import { Point, Pose } from "./protocol";

export interface Pose2 { x: number; y: number; yaw: number }

/** A point of the frame of `pose` in the frame that the pose is given in. */
export function place(pose: Pose2, x: number, y: number): Point {
  const c = Math.cos(pose.yaw), s = Math.sin(pose.yaw);
  return [pose.x + c * x - s * y, pose.y + s * x + c * y];
}

const LONGEST_S = 0.6;  // what the robot does later nobody knows

/** Where the robot is by its last report and its velocity then. */
export function deadReckoned(pose: Pose, age_s: number): Pose2 {
  const dt = Math.min(Math.max(age_s, 0), LONGEST_S);
  const yaw = pose.yaw_rad + pose.wz_rad_s * dt / 2;  // half way: the mean direction
  const [x, y] = place({ x: pose.x_m, y: pose.y_m, yaw }, pose.vx_m_s * dt, pose.vy_m_s * dt);
  return { x, y, yaw: pose.yaw_rad + pose.wz_rad_s * dt };
}

/** Half axes [m] and direction [rad] of the ellipse of `sigmas` standard deviations. */
export function ellipse(pose: Pose, sigmas: number): { a: number; b: number; direction: number } {
  const xx = pose.sigma_x_m ** 2, yy = pose.sigma_y_m ** 2, xy = pose.rho_x_y * pose.sigma_x_m * pose.sigma_y_m;
  const mean = (xx + yy) / 2, spread = Math.hypot((xx - yy) / 2, xy);
  return {
    a: sigmas * Math.sqrt(Math.max(0, mean + spread)),
    b: sigmas * Math.sqrt(Math.max(0, mean - spread)),
    direction: Math.atan2(2 * xy, xx - yy) / 2,
  };
}

/** Pose of sonar `index` in the base frame: where the ray from the centre leaves the footprint. */
export function sonarPose(index: number, length_m: number, width_m: number): Pose2 {
  const yaw = index * Math.PI / 12;
  const c = Math.cos(yaw), s = Math.sin(yaw);
  const reach = Math.min(length_m / 2 / Math.max(1e-9, Math.abs(c)), width_m / 2 / Math.max(1e-9, Math.abs(s)));
  return { x: reach * c, y: reach * s, yaw };
}
