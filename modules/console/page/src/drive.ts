// The hand at this page: keys, the stick on the screen, a game pad. Only while the page is seen and has the focus.

import { colour, prepare } from "./dom";
import { isTakenByField } from "./keys";
import { StickReport } from "./protocol";

const PERIOD_MS = 40;
// A hand that came to rest says so three times, and then once a second: the station obeys none that it has not seen at rest.
const RESTING_REPORTS = 3, REST_PERIOD = 25;
const PAD_DEAD_BAND = 0.12, PAD_DEAD_MAN = 5;  // right shoulder

// Key codes, so that they lie alike on every keyboard: axis and sign.
const KEYS: Record<string, [number, number]> = {
  KeyW: [0, 1], ArrowUp: [0, 1], KeyS: [0, -1], ArrowDown: [0, -1],
  KeyA: [1, 1], ArrowLeft: [1, 1], KeyD: [1, -1], ArrowRight: [1, -1],
  KeyQ: [5, 1], KeyE: [5, -1],
};
// Of the head: pan with the turning keys and A D, tilt with W S (positive looks down).
const HEAD_KEYS: Record<string, [number, number]> = {
  KeyW: [4, -1], ArrowUp: [4, -1], KeyS: [4, 1], ArrowDown: [4, 1],
  KeyA: [5, 1], ArrowLeft: [5, 1], KeyD: [5, -1], ArrowRight: [5, -1],
  KeyQ: [3, 1], KeyE: [3, -1],
};

/** Whether the finger or the left button is down: while another button is, letting go of this one is a movement. */
function isPressed(event: PointerEvent): boolean {
  return (event.buttons & 1) !== 0;
}

type Button = "rearm" | "take_over" | "mode" | "range";

export class Hand {
  mode: "base" | "head" = "base";
  onStop: () => void = () => undefined;
  private readonly keys = new Set<string>();
  private readonly buttons = new Set<Button>();
  private stick: [number, number] | undefined;  // right, up: -1..1
  private turn: number | undefined;
  private resting = 0;  // steps since the hand came to rest
  private heldSince_ms: number | undefined;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly slider: HTMLInputElement,
    private readonly send: (report: StickReport) => void) {
    document.addEventListener("keydown", (event) => this.keyDown(event));
    document.addEventListener("keyup", (event) => this.keyUp(event));
    document.addEventListener("contextmenu", () => this.letGo());  // a menu takes what the hand does next
    window.addEventListener("blur", () => this.letGo());
    document.addEventListener("visibilitychange", () => this.letGo());
    window.addEventListener("pagehide", () => this.letGo());
    canvas.addEventListener("pointerdown", (event) => this.dragStick(event));
    slider.addEventListener("pointerdown", (event) => this.holdTurn(event));
    slider.addEventListener("input", () => {
      if (this.turn === undefined) slider.value = "0";  // moved by keys: nothing holds it
    });
    window.setInterval(() => this.step(), PERIOD_MS);
  }

  /** Whatever is held counts no more, until it is pressed again. */
  letGo(): void {
    this.keys.clear();
    this.buttons.clear();
    this.stick = undefined;
    this.turn = undefined;
    this.slider.value = "0";
    this.resting = 0;
    this.step();
  }

  /** For how long the hand has held something [ms]; 0: it rests. */
  held_ms(): number {
    return this.heldSince_ms === undefined ? 0 : performance.now() - this.heldSince_ms;
  }

  /** A button of the page that acts while it is held. */
  bind(element: HTMLElement, button: Button): void {
    const down = (): void => { this.buttons.add(button); this.step(); };
    const up = (): void => { this.buttons.delete(button); };
    element.addEventListener("pointerdown", down);
    for (const name of ["pointerup", "pointerleave", "pointercancel", "blur"]) element.addEventListener(name, up);
    element.addEventListener("keydown", (event) => {
      if (event.key === "Enter" && !event.repeat) down();
    });
    element.addEventListener("keyup", up);
  }

  draw(): void {
    if (this.canvas.clientWidth === 0) return;  // not shown
    const context = prepare(this.canvas);
    const size = this.canvas.clientWidth, middle = size / 2, reach = middle - 22;
    context.beginPath();
    context.arc(middle, middle, middle - 2, 0, 2 * Math.PI);
    context.fillStyle = colour("grid");
    context.fill();
    context.strokeStyle = colour("line");
    context.stroke();
    const [right, up] = this.stick ?? this.shown();
    context.beginPath();
    context.arc(middle + right * reach, middle - up * reach, 20, 0, 2 * Math.PI);
    context.fillStyle = colour(this.isBusy() ? "accent" : "soft");
    context.fill();
  }

  private shown(): [number, number] {
    const { axis } = this.report();
    return this.mode === "base" ? [-(axis[1] ?? 0), axis[0] ?? 0] : [-(axis[5] ?? 0), -(axis[4] ?? 0)];
  }

  private isHere(): boolean {
    return document.visibilityState === "visible" && document.hasFocus();
  }

  // While the command key of a Mac is down no key is said to go up: whatever is held then may have been let go since.
  // Keyboards on screens and of remote desktops may not say which key went up.
  private keyUp(event: KeyboardEvent): void {
    if (event.key === "Meta" || event.metaKey || event.code === "") this.letGo();
    else if (this.keys.delete(event.code)) this.step();
  }

  private keyDown(event: KeyboardEvent): void {
    if (event.key === "Meta" || event.metaKey) this.letGo();
    if (event.code === "Space") {
      event.preventDefault();
      if (!event.repeat) this.onStop();
      return;
    }
    if (isTakenByField(event) || event.ctrlKey || event.altKey || event.metaKey || !(event.code in KEYS)) return;
    event.preventDefault();
    // A repetition of a key that went down before the page had the focus is no wish.
    if (event.repeat) return;
    this.keys.add(event.code);
    this.step();
  }

  private dragStick(start: PointerEvent): void {
    const middle = this.canvas.clientWidth / 2, reach = middle - 22;
    if (start.button !== 0) return;
    const take = (event: PointerEvent): void => {
      if (!isPressed(event)) return end();
      const x = (event.offsetX - middle) / reach, y = (middle - event.offsetY) / reach;
      const size = Math.max(1, Math.hypot(x, y));
      this.stick = [x / size, y / size];
    };
    const end = (): void => {
      this.stick = undefined;
      this.canvas.removeEventListener("pointermove", take);
    };
    this.canvas.setPointerCapture(start.pointerId);
    take(start);
    this.canvas.addEventListener("pointermove", take);
    for (const name of ["pointerup", "pointercancel", "lostpointercapture"])
      this.canvas.addEventListener(name, end, { once: true });
  }

  private holdTurn(start: PointerEvent): void {
    if (start.button !== 0) return;
    this.slider.setPointerCapture(start.pointerId);
    this.turn = 0;
    const take = (): void => { this.turn = -Number(this.slider.value) / 100; };
    const watch = (event: PointerEvent): void => { if (!isPressed(event)) end(); };
    const end = (): void => {
      this.turn = undefined;
      this.slider.value = "0";
      this.slider.blur();  // arrows turn it no more, and drive again
      this.slider.removeEventListener("input", take);
      this.slider.removeEventListener("pointermove", watch);
    };
    this.slider.addEventListener("input", take);
    this.slider.addEventListener("pointermove", watch);
    for (const name of ["pointerup", "pointercancel"]) this.slider.addEventListener(name, end, { once: true });
  }

  private isBusy(): boolean {
    const { axis, hold, rearm, take_over, mode, range } = this.report();
    return hold || rearm || take_over || mode || range || axis.some((v) => v !== 0);
  }

  private report(): StickReport {
    const axis = [0, 0, 0, 0, 0, 0];
    const add = (i: number, value: number): void => {
      axis[i] = Math.max(-1, Math.min(1, (axis[i] ?? 0) + value));
    };
    let hold = false;
    if (this.isHere()) {
      const map = this.mode === "base" ? KEYS : HEAD_KEYS;
      for (const code of this.keys) {
        const use = map[code];
        if (use !== undefined) add(...use);
      }
      if (this.stick !== undefined) {
        add(this.mode === "base" ? 0 : 4, this.mode === "base" ? this.stick[1] : -this.stick[1]);
        add(this.mode === "base" ? 1 : 5, -this.stick[0]);
      }
      if (this.turn !== undefined) add(5, this.turn);
      hold = this.keys.size > 0 || this.stick !== undefined || this.turn !== undefined;
      hold = this.addPad(add) || hold;
    }
    const pressed = (button: Button): boolean => this.buttons.has(button) && this.isHere();
    return { axis, hold, rearm: pressed("rearm"), take_over: pressed("take_over"), mode: pressed("mode"),
      range: pressed("range") };
  }

  private addPad(add: (i: number, value: number) => void): boolean {
    const pad = (navigator.getGamepads?.() ?? []).find((p) => p !== null && p.connected);
    if (pad === null || pad === undefined || pad.buttons[PAD_DEAD_MAN]?.pressed !== true) return false;
    const value = (i: number): number => {
      const v = pad.axes[i] ?? 0;
      return Math.abs(v) < PAD_DEAD_BAND ? 0 : -v;  // a pad's axes grow to the right and down
    };
    add(this.mode === "base" ? 0 : 4, this.mode === "base" ? value(1) : -value(1));
    add(this.mode === "base" ? 1 : 5, value(0));
    if (this.mode === "base") add(5, value(2));
    return true;
  }

  private step(): void {
    const report = this.report();
    this.resting = this.isBusy() ? 0 : this.resting + 1;
    this.heldSince_ms = report.hold ? this.heldSince_ms ?? performance.now() : undefined;
    if (this.resting <= RESTING_REPORTS || this.resting % REST_PERIOD === 0) this.send(report);
  }
}
