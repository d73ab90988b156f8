// Lists of corners for GlCanvas: faces with their light baked in, and lines.

import { Point } from "./protocol";

export type Spot = [number, number, number];  // m, map frame
export type Tint = [number, number, number, number];  // red, green, blue, opacity: 0 to 1

export interface Mesh { values: number[] }

/** "#0b5cb8" as numbers. */
export function tint(hex: string, opacity = 1): Tint {
  const value = parseInt(hex.replace("#", ""), 16);
  return [(value >> 16 & 255) / 255, (value >> 8 & 255) / 255, (value & 255) / 255, opacity];
}

function shade([r, g, b, a]: Tint, light: number): Tint {
  return [r * light, g * light, b * light, a];
}

export function addFace(mesh: Mesh, corners: Spot[], colour: Tint): void {
  for (let i = 2; i < corners.length; ++i)
    for (const corner of [corners[0], corners[i - 1], corners[i]]) if (corner !== undefined) mesh.values.push(...corner, ...colour);
}

/** A prism over a polygon on the floor. Sides that face other ways are lit otherwise, so that edges are seen. */
export function addPrism(mesh: Mesh, floor: Point[], low: number, high: number, colour: Tint): void {
  addFace(mesh, floor.map(([x, y]): Spot => [x, y, high]), colour);
  floor.forEach((from, i) => {
    const to = floor[(i + 1) % floor.length] ?? from;
    const light = 0.62 + 0.2 * Math.abs(Math.sin(Math.atan2(to[1] - from[1], to[0] - from[0]) + 0.5));
    addFace(mesh, [[...from, low], [...to, low], [...to, high], [...from, high]], shade(colour, light));
  });
}

export function addLine(mesh: Mesh, from: Spot, to: Spot, colour: Tint): void {
  const corner = (at: Spot, other: Spot, side: number): void => { mesh.values.push(...at, ...other, side, ...colour); };
  // Seen from the other end, left is right.
  corner(from, to, 1); corner(from, to, -1); corner(to, from, 1);
  corner(from, to, 1); corner(to, from, 1); corner(to, from, -1);
}

export function addPolyline(mesh: Mesh, spots: Spot[], colour: Tint): void {
  spots.forEach((spot, i) => {
    const before = spots[i - 1];
    if (before !== undefined) addLine(mesh, before, spot, colour);
  });
}
