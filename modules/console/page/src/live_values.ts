// The parameters of a process that may be changed while it runs, with what it answers.

import { setText } from "./dom";
import { LiveRow, Parameter } from "./live_row";
import { Item, ParameterValue } from "./protocol";
import type { PageServices } from "./views";

const PROCESSES = ["", "robot", "head", "planner"];  // constants of parameter_order_t
const OTHER_TABLE = 5;  // of parameter_value_t

/** A parameter's number is its place, from 1 on. */
interface Sheet { table: number; parameters: Parameter[] }

export class LiveValues {
  readonly element = document.createElement("div");
  private readonly table = document.createElement("table");
  private readonly head = document.createElement("tr");
  private readonly note = document.createElement("span");
  private readonly save = document.createElement("button");
  private readonly reset = document.createElement("button");
  private process = "";
  private fingerprint = 0;
  private rows: LiveRow[] = [];
  private words: string[] = [];

  constructor(private readonly page: PageServices) {
    const tools = document.createElement("div");
    tools.className = "tools";
    this.save.addEventListener("click", () => page.parameter(this.process, "save"));
    this.reset.addEventListener("click", () => page.parameter(this.process, "reset"));
    this.note.setAttribute("role", "status");
    tools.append(this.save, this.reset, this.note);
    this.element.className = "live";
    this.element.append(tools, this.table);
    this.label();
  }

  /** Shows those of a process, and asks it what differs from its file. */
  async load(process: string): Promise<void> {
    this.process = process;
    const answer = await fetch(`/parameters/${process}.json${location.search}`).catch(() => undefined);
    const sheet = answer?.ok === true ? await answer.json() as Sheet : { table: 0, parameters: [] };
    if (this.process !== process) return;
    this.fingerprint = sheet.table;
    this.rows = sheet.parameters.map((parameter) => new LiveRow(parameter, this.page,
      (action, value) => this.page.parameter(process, action, parameter.name, value)));
    this.table.replaceChildren(this.head, ...this.rows.map((row) => row.element));
    this.element.hidden = this.rows.length === 0;
    setText(this.note, "");
    this.filter(this.words);
    if (this.rows.length > 0) this.page.parameter(process, "read");
  }

  hear(item: Item): void {
    if (item.channel !== "PARAMETER_VALUE") return;
    const message = item.message as unknown as ParameterValue;
    if (PROCESSES[message.process] !== this.process) return;
    if (message.table !== this.fingerprint) {
      setText(this.note, this.page.outcomeText(OTHER_TABLE));
      return;
    }
    const row = this.rows[message.key - 1];
    if (row !== undefined) row.hear(message);
    else if (message.outcome === 0 && message.next_changed === 0) this.rows.forEach((one) => one.forget());
    setText(this.note, row === undefined && message.outcome !== 0 ? this.page.outcomeText(message.outcome)
      : this.page.text(message.unsaved ? "unsaved" : "allSaved"));
    const next = this.rows[message.next_changed - 1];
    if (next !== undefined && !next.isKnown()) this.page.parameter(this.process, "read", next.parameter.name);
  }

  filter(words: string[]): void {
    this.words = words;
    this.rows.forEach((row) => row.filter(words));
  }

  label(): void {
    this.head.replaceChildren(...(["liveParameter", "inForce", "newValue", "allowed", "state"] as const).map((word) => {
      const th = document.createElement("th");
      th.textContent = this.page.text(word);
      return th;
    }));
    setText(this.save, this.page.text("saveValues"));
    setText(this.reset, this.page.text("resetValues"));
    this.rows.forEach((row) => row.label());
  }

  draw(): void {
    this.save.disabled = this.reset.disabled = !this.page.mayOrder();
    this.rows.forEach((row) => row.draw());
  }
}
