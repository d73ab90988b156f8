// The channels and their numbers, to be chosen or dragged onto a chart.

import { Json, numberPaths } from "./fields";
import type { PageServices } from "./views";

const UPDATE_MS = 1000;

export class FieldList {
  readonly element = document.createElement("div");
  private readonly filter = document.createElement("input");
  private readonly channels = document.createElement("div");
  private readonly paths = new Map<string, string[]>();
  private shown = "";
  private updated_ms = -UPDATE_MS;

  constructor(private readonly page: PageServices, private readonly choose: (channel: string, path: string) => void) {
    this.element.className = "fields";
    this.filter.type = "search";
    this.filter.addEventListener("input", () => this.update(true));
    this.element.append(this.filter, this.channels);
  }

  label(): void {
    this.filter.placeholder = this.page.text("filter");
    this.filter.setAttribute("aria-label", this.page.text("filter"));
    this.update(true);
  }

  hear(channel: string, message: Json): void {
    const paths = numberPaths(message), known = this.paths.get(channel);
    // An array may have been empty until now: what was once there stays.
    if (known === undefined || paths.some((path) => !known.includes(path)))
      this.paths.set(channel, [...new Set([...known ?? [], ...paths])]);
  }

  /** Shows what is known, at most once a second unless asked `now`. */
  update(now: boolean): void {
    if (!now && performance.now() - this.updated_ms < UPDATE_MS) return;
    this.updated_ms = performance.now();
    const names = new Set([...this.paths.keys(), ...Object.keys(this.page.hello()?.channels ?? {})]);
    const words = this.filter.value.toLowerCase().split(/\s+/).filter((word) => word !== "");
    const fits = (name: string): boolean => words.every((word) => name.toLowerCase().includes(word));
    const found = [...names].sort().map((channel): [string, string[]] =>
      [channel, (this.paths.get(channel) ?? []).filter((path) => fits(`${channel} ${path}`))])
      .filter(([channel, paths]) => paths.length > 0 || (words.length === 0 && this.isOnRequest(channel)));
    const key = JSON.stringify(found);
    if (key === this.shown) return;
    this.shown = key;
    const open = new Set([...this.channels.querySelectorAll("details[open]")].map((d) => (d as HTMLElement).dataset.channel));
    this.channels.replaceChildren(...found.map(([channel, paths]) =>
      this.channelOf(channel, paths, words.length > 0 || open.has(channel))));
  }

  private isOnRequest(channel: string): boolean {
    return this.page.hello()?.channels[channel]?.on_request === true;
  }

  private channelOf(channel: string, paths: string[], open: boolean): HTMLElement {
    const details = document.createElement("details"), summary = document.createElement("summary");
    details.dataset.channel = channel;
    details.open = open;
    summary.textContent = channel;
    details.append(summary, ...paths.map((path) => this.buttonOf(channel, path)));
    if (this.isOnRequest(channel))
      details.addEventListener("toggle", () => this.page.want(`list ${channel}`, [channel], details.open));
    return details;
  }

  private buttonOf(channel: string, path: string): HTMLElement {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = path;
    button.draggable = true;
    button.addEventListener("click", () => this.choose(channel, path));
    button.addEventListener("dragstart", (event) => event.dataTransfer?.setData("text/plain", `${channel} ${path}`));
    return button;
  }
}
