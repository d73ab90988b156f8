// A button for what nobody may hit by accident: the first press arms it, the second one, not at once, does it.

import { setText } from "./dom";

const NOT_BEFORE_MS = 500, ARMED_MS = 5000;

export class TwoStep {
  readonly element = document.createElement("button");
  private armed_ms: number | undefined;

  /** `words`: what is on it at rest, and when it is armed. */
  constructor(private readonly words: () => [string, string], act: () => void) {
    this.element.type = "button";
    this.element.addEventListener("click", () => {
      const since_ms = this.armed_ms === undefined ? undefined : performance.now() - this.armed_ms;
      if (since_ms === undefined) this.armed_ms = performance.now();
      else if (since_ms >= NOT_BEFORE_MS) {
        this.armed_ms = undefined;
        act();
      }
      this.draw();
    });
    this.element.addEventListener("blur", () => this.disarm());
    this.draw();
  }

  disarm(): void {
    this.armed_ms = undefined;
    this.draw();
  }

  isArmed(): boolean {
    return this.armed_ms !== undefined;
  }

  /** Called several times a second: what is armed is so for a while only. */
  draw(): void {
    if (this.armed_ms !== undefined && performance.now() - this.armed_ms > ARMED_MS) this.armed_ms = undefined;
    const [rest, armed] = this.words();
    setText(this.element, this.isArmed() ? armed : rest);
    this.element.classList.toggle("armed", this.isArmed());
  }
}
