// The simulation: which scenario it is in, and the beginning of a new world. A real robot has none of it.

import { byId, setText } from "./dom";
import { Item, ProcessAction, ProcessReport, ScenarioOffer, Simulation } from "./protocol";
import { Store } from "./store";
import { hasText, named, text } from "./text";
import { TwoStep } from "./two_step";

const BEGINS = 1;
const LONGEST_MS = 30_000;  // after which it is not believed that the world still comes

export interface WorldPage {
  store: Store;
  mayOrder(): boolean;
  order(action: ProcessAction, name: string): void;
  /** Another world: nothing that was seen of the one before holds. */
  forget(): void;
}

export class World {
  private readonly section = byId("world-section");
  private readonly choice = byId<HTMLSelectElement>("scenario");
  private readonly button: TwoStep;
  private offers = "";
  private worlds: number | undefined;
  private begun_ms: number | undefined;
  private before: number | undefined;  // the world that goes
  private refusal: number | undefined;

  constructor(private readonly page: WorldPage) {
    this.button = new TwoStep(() => [text("newWorld"), text("newWorldNow")], () => this.begin());
    this.button.element.id = "new-world";
    byId("world-buttons").append(this.button.element);
    this.choice.addEventListener("change", () => this.button.disarm());
  }

  /** Whether a world is on its way: the station itself is away meanwhile. */
  isBeginning(): boolean {
    return this.begun_ms !== undefined && performance.now() - this.begun_ms < LONGEST_MS;
  }

  label(): void {
    this.offers = "";
  }

  /** The answer to an order that was refused: it came too often, or the scenario is gone. */
  hear(item: Item): void {
    const report = item.message as unknown as ProcessReport;
    if (item.channel !== "PROCESS_REPORT" || report.name !== this.choice.value || report.outcome === 0) return;
    if (this.begun_ms === undefined) return;
    this.begun_ms = undefined;
    this.refusal = report.outcome;
  }

  draw(): void {
    const simulation = this.page.store.get<Simulation>("SIMULATION");
    if (simulation !== undefined) this.take(simulation);
    this.button.draw();
    this.button.element.disabled = !this.page.mayOrder() || this.isBeginning() || this.choice.value === "";
    this.choice.disabled = !this.page.mayOrder() || this.isBeginning();
    const late = this.begun_ms !== undefined && !this.isBeginning();
    const bad = late ? text("worldLate") : this.refusal !== undefined ? named("processOutcome", this.refusal) : "";
    const good = this.isBeginning() ? text("worldBegins") : this.button.isArmed() ? text("worldArmed") : "";
    setText(byId("world-text"), bad === "" ? good : bad);
    byId("world-text").className = bad === "" ? "warn" : "bad";
  }

  private take(simulation: Simulation): void {
    this.section.hidden = false;
    this.fill(simulation);
    const stale = this.page.store.isStale("SIMULATION");
    if (this.worlds !== undefined && simulation.worlds !== this.worlds) {
      this.choice.value = simulation.scenario;
      this.note(this.worlds);
      this.page.forget();
    }
    this.worlds = simulation.worlds;
    if (stale) return;
    if (simulation.state === BEGINS) this.note(undefined);
    else if (simulation.worlds !== this.before) this.begun_ms = undefined;
  }

  private note(before: number | undefined): void {
    if (this.begun_ms !== undefined) return;
    this.begun_ms = performance.now();
    this.before = before;
  }

  private fill(simulation: Simulation): void {
    const offers = JSON.stringify(simulation.scenarios);
    if (offers === this.offers) return;
    const chosen = this.offers === "" && this.choice.value === "" ? simulation.scenario : this.choice.value;
    this.offers = offers;
    this.choice.replaceChildren(...simulation.scenarios.map((offer) => {
      const option = document.createElement("option");
      option.value = offer.name;
      option.textContent = titleOf(offer);
      return option;
    }));
    this.choice.value = chosen;
  }

  private begin(): void {
    if (!this.page.mayOrder() || this.choice.value === "") return;
    this.refusal = undefined;
    this.begun_ms = undefined;
    this.note(this.worlds);
    this.page.order("new_world", this.choice.value);
  }
}

/** Of the shipped scenarios in the page's language; of others as their file says. */
function titleOf(offer: ScenarioOffer): string {
  const word = `scenario_${offer.name}`;
  return hasText(word) ? text(word) : `${offer.name}: ${offer.title}`;
}
