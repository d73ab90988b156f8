// What fills the large field of the page: the ground plan, and views whose scripts are loaded when they are opened first.

import { byId } from "./dom";
import { Hello, Item, ParameterAction } from "./protocol";
import type { Floor } from "./floor";
import type { Store } from "./store";
import type { number, text } from "./text";

/** What a view is given of the page: its script is another one, and shares no state with it. */
export interface PageServices {
  store: Store;
  text: typeof text;
  number: typeof number;
  hello(): Hello | undefined;
  floor(): Floor;  // what the planner learned of it
  now(): number;  // s, of the clock in which messages age
  want(owner: string, channels: string[], on: boolean): void;
  mayOrder(): boolean;
  /** Reads or changes a parameter of a running process; nothing happens while nobody may order. */
  parameter(process: string, action: ParameterAction, key?: string, value?: number): void;
  outcomeText(outcome: number): string;
}

export interface View {
  show(on: boolean): void;
  draw(): void;
  /** A message came; `valid_s` is the moment it speaks of. */
  hear(item: Item, valid_s: number): void;
  /** The station was connected, or another place of a log is shown: nothing is known but what follows. */
  restart(): void;
  /** The language is another one. */
  label(): void;
}

const LEAST_FRAME_MS = 32;

export type ViewName = "plan" | "space" | "plots" | "values";
type Opener = (element: HTMLElement) => Promise<View>;

export class Views {
  private current: ViewName = "plan";
  private drawn_ms = 0;
  private readonly open = new Map<ViewName, View>();
  private readonly loading = new Set<ViewName>();

  constructor(private readonly openers: Partial<Record<ViewName, Opener>>) {
    for (const name of ["plan", "space", "plots", "values"] as const)
      byId(`show-${name}`).addEventListener("click", () => this.choose(name));
  }

  choose(name: ViewName): void {
    this.open.get(this.current)?.show(false);
    this.current = name;
    for (const one of ["plan", "space", "plots", "values"] as const) {
      byId(`view-${one}`).hidden = one !== name;
      byId(`show-${one}`).setAttribute("aria-pressed", String(one === name));
    }
    const view = this.open.get(name);
    if (view !== undefined) view.show(true);
    else void this.load(name);
  }

  isShown(name: ViewName): boolean {
    return this.current === name;
  }

  each(act: (view: View) => void): void {
    for (const view of this.open.values()) act(view);
  }

  /** At most 30 times a second: a machine that draws in software has other things to do. */
  draw(): void {
    const now_ms = performance.now();
    if (now_ms - this.drawn_ms < LEAST_FRAME_MS) return;
    this.drawn_ms = now_ms;
    this.open.get(this.current)?.draw();
  }

  private async load(name: ViewName): Promise<void> {
    const opener = this.openers[name];
    if (opener === undefined || this.loading.has(name)) return;
    this.loading.add(name);
    try {
      const view = await opener(byId(`view-${name}`));
      this.open.set(name, view);
      view.show(this.current === name);
    } finally {
      this.loading.delete(name);  // the station may be back at the next click
    }
  }
}
