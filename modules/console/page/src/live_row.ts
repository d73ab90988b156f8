// One parameter that may be changed while its process runs: what is in force, a field for a new value, how an order fared.

import { setText } from "./dom";
import { ParameterValue } from "./protocol";
import type { PageServices } from "./views";

const PATIENCE_MS = 12_000;  // the station gives up after 8 s, and the order may have waited for others
const DECIMALS = 1e6;  // what the radio keeps of a value

/** As `--print-parameters` of the process writes it. */
export interface Parameter {
  name: string; unit: string; min: number; max: number; change: "any" | "lower" | "higher"; value: number; meaning: string;
}

export class LiveRow {
  readonly element = document.createElement("tr");
  private readonly field = document.createElement("input");
  private readonly button = document.createElement("button");
  private readonly inForce = document.createElement("td");
  private readonly range = document.createElement("td");
  private readonly state = document.createElement("td");
  private readonly unit: string;
  private value: number | undefined;  // as the process said it
  private outcome: number | undefined;
  private asked_ms: number | undefined;
  private wanted: number | undefined;  // the value that was ordered last, until it is answered

  constructor(readonly parameter: Parameter, private readonly page: PageServices,
    private readonly order: (action: "read" | "set", value?: number) => void) {
    this.unit = parameter.unit === "-" ? "" : ` ${parameter.unit}`;
    const name = document.createElement("th"), set = document.createElement("td");
    name.textContent = parameter.name;
    name.title = parameter.meaning;
    this.field.type = "number";
    this.field.step = "any";
    this.field.min = String(parameter.min);
    this.field.max = String(parameter.max);
    this.field.setAttribute("aria-label", parameter.name);
    this.field.addEventListener("focus", () => { if (!this.isKnown()) this.ask("read"); });
    this.field.addEventListener("input", () => this.enable());
    this.field.addEventListener("keydown", (event) => { if (event.key === "Enter") this.set(); });
    this.button.addEventListener("click", () => this.set());
    this.state.setAttribute("role", "status");
    set.append(this.field, this.button);
    this.element.append(name, this.inForce, set, this.range, this.state);
    this.label();
  }

  isKnown(): boolean {
    return this.value !== undefined;
  }

  /** An answer; one with another value than the one ordered answers an order of before. */
  hear(message: ParameterValue): void {
    this.value = Math.round(message.value * DECIMALS) / DECIMALS;
    const before = message.outcome === 0 && this.wanted !== undefined && Math.abs(this.value - this.wanted) > 1 / DECIMALS;
    if (!before) {
      this.outcome = message.outcome;
      this.asked_ms = this.wanted = undefined;
    }
    this.draw();
  }

  /** The process has its file's value in force. */
  forget(): void {
    if (this.asked_ms === undefined) this.value = this.outcome = undefined;
    this.draw();
  }

  filter(words: string[]): void {
    const text = `${this.parameter.name} ${this.parameter.meaning}`.toLowerCase();
    this.element.hidden = !words.every((word) => text.includes(word));
  }

  label(): void {
    const { min, max, change } = this.parameter;
    const side = change === "any" ? "" : `, ${this.page.text(change === "lower" ? "atMostFile" : "atLeastFile")}`;
    setText(this.button, this.page.text("set"));
    setText(this.range, `${min} … ${max}${this.unit}${side}`);
    this.draw();
  }

  /** Called several times a second: an answer may never come. */
  draw(): void {
    const waits = this.asked_ms !== undefined;
    const late = this.asked_ms !== undefined && performance.now() - this.asked_ms > PATIENCE_MS;
    const refused = !waits && (this.outcome ?? 0) > 0;
    setText(this.inForce, this.value === undefined ? `${this.parameter.value}${this.unit} (${this.page.text("ofFile")})`
      : `${this.value}${this.unit}`);
    setText(this.state, late ? this.page.text("noAnswer") : waits ? this.page.text("underWay")
      : this.outcome === undefined ? "" : this.page.outcomeText(this.outcome));
    this.state.className = late || refused ? "bad" : waits ? "warn" : this.outcome === 0 ? "good" : "";
    this.enable();
  }

  private enable(): void {
    this.button.disabled = !this.page.mayOrder() || !this.field.validity.valid || Number.isNaN(this.field.valueAsNumber);
  }

  private set(): void {
    if (!this.button.disabled) this.ask("set", this.field.valueAsNumber);
  }

  private ask(action: "read" | "set", value?: number): void {
    if (!this.page.mayOrder()) return;
    this.asked_ms = performance.now();
    this.wanted = value;
    this.order(action, value);
    this.draw();
  }
}
