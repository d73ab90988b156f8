// The edges of the last look, as the head sent them: no picture crosses the radio.

import { colour, prepare } from "./dom";
import { LandmarkView } from "./protocol";
import { Store } from "./store";

const WIDTH_PX = 768, HEIGHT_PX = 576;
const STYLES = ["stale", "good", "bad"];  // predicted, matched, rejected

export function drawHeadView(canvas: HTMLCanvasElement, store: Store): void {
  const context = prepare(canvas);
  const view = store.get<LandmarkView>("LANDMARK_VIEW");
  if (view === undefined) return;
  const sx = canvas.clientWidth / WIDTH_PX, sy = canvas.clientHeight / HEIGHT_PX;
  for (const edge of view.edges) {
    context.beginPath();
    context.moveTo(edge.u1_px * sx, edge.v1_px * sy);
    context.lineTo(edge.u2_px * sx, edge.v2_px * sy);
    context.strokeStyle = colour(STYLES[edge.kind] ?? "text");
    context.setLineDash(edge.kind === 0 ? [5, 4] : []);
    context.lineWidth = edge.kind === 1 ? 2.5 : 1.3;
    context.stroke();
  }
}
