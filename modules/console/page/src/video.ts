// Pictures of the third camera: they come over the video link, never over the radio.

import { byId, setText } from "./dom";
import { ageText, text } from "./text";

const STALE_S = 1;  // five times the time between two pictures

export class Video {
  private readonly image = byId<HTMLImageElement>("picture");
  private readonly age = byId("picture-age");
  private exposed_ms: number | undefined;  // of the page's clock
  private shown = false;

  /** Whether the station has pictures to show. */
  offer(on: boolean): void {
    byId("video-part").hidden = !on;
  }

  show(on: boolean): void {
    this.shown = on;
    this.image.hidden = !on;
    this.age.hidden = !on;
    if (on) return;
    this.exposed_ms = undefined;
    this.image.removeAttribute("src");
  }

  /** A message of the station: how old the picture is [s], as a double, and the JPEG. */
  hear(message: ArrayBuffer): void {
    if (!this.shown || message.byteLength < 8) return;
    this.exposed_ms = performance.now() - 1000 * new DataView(message).getFloat64(0);
    const url = URL.createObjectURL(new Blob([message.slice(8)], { type: "image/jpeg" }));
    this.image.onload = this.image.onerror = () => URL.revokeObjectURL(url);
    this.image.src = url;
  }

  /** `problem`: why nothing comes, as the station says it. */
  draw(problem: string): void {
    if (!this.shown) return;
    const age_s = this.exposed_ms === undefined ? undefined : (performance.now() - this.exposed_ms) / 1000;
    const stale = age_s === undefined || age_s > STALE_S;
    this.image.classList.toggle("stale", stale);
    this.age.classList.toggle("stale", stale);
    const picture = age_s === undefined ? text("noPicture") : `${text("pictureAge")}: ${ageText(age_s)}`;
    setText(this.age, problem === "" ? picture : `${picture} ${problem}`);
  }
}
