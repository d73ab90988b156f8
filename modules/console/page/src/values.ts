// The view of parameters: those of every process, with units and ranges, as the workstation's files have them; and those that
// may be changed while the process runs, as it has them in force.

import { fillTable, setText } from "./dom";
import { LiveValues } from "./live_values";
import { Parameter, readSheet } from "./sheet";
import type { Item } from "./protocol";
import type { PageServices, View } from "./views";

const RETRY_MS = 1000, RETRIES = 10;

export function open(element: HTMLElement, page: PageServices): View {
  return new Values(element, page);
}

class Values implements View {
  private readonly process = document.createElement("select");
  private readonly filter = document.createElement("input");
  private readonly note = document.createElement("p");
  private readonly table = document.createElement("table");
  private readonly live: LiveValues;
  private parameters: Parameter[] = [];
  private sentence = "";

  constructor(element: HTMLElement, private readonly page: PageServices) {
    const tools = document.createElement("div"), scroll = document.createElement("div");
    tools.className = "tools";
    scroll.className = "values";
    this.filter.type = "search";
    this.filter.addEventListener("input", () => this.fill());
    this.process.addEventListener("change", () => void this.load());
    this.note.className = "age";
    tools.append(this.process, this.filter);
    this.live = new LiveValues(page);
    scroll.append(this.live.element, this.note, this.table);
    element.append(tools, scroll);
    this.label();
    void this.find(RETRIES);
  }

  show(): void {}
  draw(): void {
    this.live.draw();
  }
  hear(item: Item): void {
    this.live.hear(item);
  }
  restart(): void {}

  label(): void {
    this.process.setAttribute("aria-label", this.page.text("processes"));
    this.filter.placeholder = this.page.text("filterValues");
    this.filter.setAttribute("aria-label", this.page.text("filterValues"));
    this.live.label();
    this.fill();
  }

  /** The station asks its processes when the first page comes: that takes a moment. */
  private async find(tries: number): Promise<void> {
    const answer = await fetch(`/parameters/index.json${location.search}`).catch(() => undefined);
    if (answer?.ok !== true) {
      if (tries > 0) window.setTimeout(() => void this.find(tries - 1), RETRY_MS);
      else this.say(this.page.text("noValues"));
      return;
    }
    const names = await answer.json() as string[];
    this.process.replaceChildren(...names.map((name) => new Option(name, name)));
    await this.load();
  }

  private async load(): Promise<void> {
    void this.live.load(this.process.value);
    const answer = await fetch(`/parameters/${this.process.value}.toml${location.search}`).catch(() => undefined);
    const text = answer?.ok === true ? await answer.text() : "";
    this.parameters = readSheet(text);
    this.say(this.parameters.length > 0 ? "" : text === "" ? this.page.text("noValues") : text);
  }

  private say(sentence: string): void {
    this.sentence = sentence;
    this.fill();
  }

  private fill(): void {
    setText(this.note, this.sentence === "" ? this.page.text("valuesNote") : this.sentence);
    const words = this.filter.value.toLowerCase().split(/\s+/).filter((word) => word !== "");
    this.live.filter(words);
    const fits = (p: Parameter): boolean =>
      words.every((word) => `${p.section}.${p.key} ${p.meaning}`.toLowerCase().includes(word));
    fillTable(this.table, this.parameters.filter(fits).map((p) => ({
      cells: [p.section === "" ? p.key : `${p.section}.${p.key}`, `${p.value} ${p.unit}`, p.range, p.meaning] })),
    [this.page.text("parameter"), this.page.text("value"), this.page.text("allowed"), this.page.text("meaning")]);
  }
}
