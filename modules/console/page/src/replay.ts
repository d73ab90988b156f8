// A log instead of a robot: where it stands, and the bar that moves it.

import { byId, setText } from "./dom";
import { Hello, ReplayState } from "./protocol";
import { number, text } from "./text";

const STEP_S = 5;

export type ReplayAction = "play" | "pause" | "step";

export interface ReplayOrders {
  act(action: ReplayAction): void;
  set(what: "seek" | "speed", value: number): void;
}

export class Replay {
  private state: ReplayState | undefined;
  private heard_ms = 0;
  private length_s = 0;
  private readonly slider = byId<HTMLInputElement>("position");

  constructor(orders: ReplayOrders) {
    byId("play").addEventListener("click", () => orders.act(this.state?.paused === false ? "pause" : "play"));
    byId("step").addEventListener("click", () => orders.act("step"));
    byId("back").addEventListener("click", () => orders.set("seek", Math.max(0, this.position() - STEP_S)));
    byId("ahead").addEventListener("click", () => orders.set("seek", Math.min(this.length_s, this.position() + STEP_S)));
    this.slider.addEventListener("change", () => orders.set("seek", Number(this.slider.value)));
    const speed = byId<HTMLSelectElement>("speed");
    speed.addEventListener("change", () => orders.set("speed", Number(speed.value)));
  }

  greet(hello: Hello): void {
    this.length_s = hello.replay?.length_s ?? Infinity;
    const steered = Number.isFinite(this.length_s);
    this.slider.max = String(steered ? this.length_s : 1);
    document.body.classList.toggle("played-elsewhere", hello.replay !== undefined && !steered);
    byId("replay").hidden = hello.replay === undefined;
    document.body.classList.toggle("replay", hello.replay !== undefined);
  }

  hear(state: ReplayState | undefined): void {
    this.state = state;
    this.heard_ms = performance.now();
  }

  /** The time in which messages age [s]: that of the log, or without one of this page. */
  now(): number {
    return this.state === undefined ? performance.now() / 1000 : this.position();
  }

  draw(): void {
    if (this.state === undefined) return;
    setText(byId("play"), text(this.state.paused ? "play" : "pause"));
    const length = Number.isFinite(this.length_s) ? ` / ${number(this.length_s, 1)}` : "";
    setText(byId("time"), `${number(this.position(), 1)}${length} s`);
    if (document.activeElement !== this.slider || !this.slider.matches(":active"))
      this.slider.value = String(this.position());
  }

  private position(): number {
    if (this.state === undefined) return 0;
    const since_s = this.state.paused ? 0 : Math.min(0.5, (performance.now() - this.heard_ms) / 1000);
    return Math.min(this.length_s, this.state.position_s + since_s * this.state.speed);
  }
}
