// The missions: orders to the planner, the one under way, those that wait, and how the last ones ended.

import { byId, fillList, setText } from "./dom";
import { Hello, MissionStatus, PoseCorrection } from "./protocol";
import { Store } from "./store";
import { Place, Target } from "./target";
import { ageText, named, number, text } from "./text";

const POSE_SET = 4, POSE_MOVING = 5, SHOWN_S = 20;
const MOST_PLACES = 12;

/** What the page asks of the planner, as README.md says under "What a page says". */
export interface MissionOrder { order: string; [field: string]: unknown }

export interface MissionMeans {
  mayOrder(): boolean;
  order(order: MissionOrder): void;
  /** The robot stands there. */
  place(place: Place): void;
}

/** Short enough for twelve of them in one message: to a millimetre. */
function fields(place: Place): { x_m: number; y_m: number; yaw_rad: number; turn: boolean } {
  const rounded = (value: number): number => Math.round(value * 1000) / 1000;
  return { x_m: rounded(place.x), y_m: rounded(place.y), yaw_rad: rounded(place.yaw ?? 0), turn: place.yaw !== undefined };
}

/** What a field says; undefined when that is nothing, or nothing that is allowed: it has no other meaning then. */
function numberIn(id: string): number | undefined {
  const input = byId<HTMLInputElement>(id);
  return input.validity.valid && !Number.isNaN(input.valueAsNumber) ? input.valueAsNumber : undefined;
}

function withNumber(id: string, order: (value: number) => MissionOrder): MissionOrder | undefined {
  const value = numberIn(id);
  return value === undefined ? undefined : order(value);
}

/** What may stand in the first field that says something else. */
function hint(): string {
  const wrong = byId("orders").querySelector<HTMLInputElement>("input[type=number]:invalid");
  if (wrong === null) return "";
  const name = (wrong.closest("label")?.textContent ?? "").replace(/\s+/g, " ").trim();
  return `${name}: ${text("allowed")}: ${text(wrong.step === "1" ? "wholeNumber" : "aNumber")}, ${wrong.min} … ${wrong.max}`;
}

/** A command for a terminal is no advice at a page, which has a button for it. */
function withoutCommand(words: string): string {
  return words.split("; next: ")[0] ?? words;
}

export class MissionPanel {
  /** Places of the patrol that is being put together. */
  readonly patrol: Place[] = [];
  private longest: { order: number; round: number; left_s: number } = { order: 0, round: 0, left_s: 0 };

  constructor(private readonly store: Store, private readonly target: Target, private readonly means: MissionMeans) {
    this.bind("pass", () => ({ order: "pass_door", landmark: Number(byId<HTMLSelectElement>("door").value) }));
    this.bind("corridor", () => withNumber("corridor-m", (distance_m) => ({ order: "corridor", distance_m })));
    this.bind("explore", () => ({ order: "explore" }));
    this.bind("locate", () => ({ order: "locate" }));
    this.bind("pause", () => ({ order: this.status()?.paused === true ? "resume" : "pause" }));
    this.bind("abort", () => ({ order: "abort" }));
    this.bind("patrol", () => withNumber("rounds", (rounds) => ({ order: "patrol", places: this.patrol.map(fields), rounds })));
    this.bindPlaces();
  }

  greet(hello: Hello): void {
    byId<HTMLSelectElement>("door").replaceChildren(...hello.plan.doors.map((door) => {
      const option = document.createElement("option");
      option.value = String(door.id);
      option.textContent = door.name;
      return option;
    }));
  }

  draw(): void {
    this.enable();
    const status = this.status(), element = byId("mission-text");
    setText(element, status === undefined ? text("never") :
      `${named("phase", status.phase)}: ${withoutCommand(status.text)} (${ageText(this.store.age("MISSION_STATUS"))})`);
    element.classList.toggle("stale", this.store.isStale("MISSION_STATUS"));
    this.drawProgress(status);
    this.drawQueue(status);
    this.drawEnds(status);
    this.drawPlaced();
  }

  private status(): MissionStatus | undefined {
    return this.store.get<MissionStatus>("MISSION_STATUS");
  }

  private bind(id: string, order: () => MissionOrder | undefined): void {
    byId(id).addEventListener("click", () => {
      const given = order();
      if (given !== undefined) this.means.order(given);
    });
  }

  private bindPlaces(): void {
    const withPlace = (act: (place: Place) => void) => (): void => {
      const place = this.target.place();
      if (place !== undefined) act(place);
    };
    byId("goto").addEventListener("click", withPlace((place) => this.means.order({ order: "goto", ...fields(place) })));
    byId("place").addEventListener("click", withPlace((place) => this.means.place(place)));
    byId("add-place").addEventListener("click", withPlace((place) => {
      if (this.patrol.length < MOST_PLACES) this.patrol.push(place);
    }));
    byId("clear-places").addEventListener("click", () => this.patrol.splice(0));
    byId("orders").addEventListener("input", () => this.enable());
  }

  /** To say where the robot stands, its heading has to be said, too. */
  private enable(): void {
    const place = this.target.place(), may = this.means.mayOrder(), status = this.status();
    const set = (id: string, on: boolean): void => { byId<HTMLButtonElement>(id).disabled = !on; };
    for (const id of ["pass", "explore", "locate", "abort"]) set(id, may);
    set("corridor", may && numberIn("corridor-m") !== undefined);
    setText(byId("field-hint"), hint());
    set("pause", may && status?.running === true);
    setText(byId("pause"), text(status?.paused === true ? "resumeMission" : "pauseMission"));
    set("goto", may && place !== undefined);
    set("place", may && place?.yaw !== undefined);
    set("add-place", place !== undefined && this.patrol.length < MOST_PLACES);
    set("clear-places", this.patrol.length > 0);
    set("patrol", may && this.patrol.length > 0 && numberIn("rounds") !== undefined);
    setText(byId("patrol-places"), this.patrol.length === 0 ? text("noPlaces") :
      this.patrol.map((p) => `(${number(p.x, 1)}; ${number(p.y, 1)})`).join(" → "));
  }

  private drawProgress(status: MissionStatus | undefined): void {
    const running = status?.running === true;
    byId("progress").hidden = !running;
    if (status === undefined || !running) return;
    const { order_id, round, left_s } = status;
    if (this.longest.order !== order_id || this.longest.round !== round) this.longest = { order: order_id, round, left_s };
    this.longest.left_s = Math.max(this.longest.left_s, left_s);
    const bar = byId<HTMLProgressElement>("progress-bar");
    if (left_s < 0 || this.longest.left_s <= 0) bar.removeAttribute("value");
    else bar.value = 1 - left_s / this.longest.left_s;
    setText(byId("progress-text"), this.progressWords(status).join(" · "));
  }

  private progressWords(status: MissionStatus): string[] {
    const words = [status.title];
    if (status.n_steps > 1) words.push(`${text("missionStep")} ${status.step} / ${status.n_steps}`);
    if (status.rounds !== 1) words.push(`${text("round")} ${status.round}${status.rounds > 0 ? ` / ${status.rounds}` : ""}`);
    words.push(status.left_s < 0 ? text("timeLeftUnknown") : `${text("timeLeft")} ${number(status.left_s, 0)} s`);
    if (status.paused) words.push(text("paused"));
    return words;
  }

  private drawQueue(status: MissionStatus | undefined): void {
    const may = this.means.mayOrder();
    fillList(byId("queue"), (status?.waiting ?? []).map((waits) => ({
      key: `${waits.order_id} ${may}`,
      words: `${text("waits")} ${waits.title}`,
      button: may ? { words: text("cancel"), act: () => this.means.order({ order: "cancel", number: waits.order_id }) } : undefined,
    })));
  }

  private drawEnds(status: MissionStatus | undefined): void {
    const ends = (status?.results ?? []).filter((end) => end.step === 0).reverse();
    fillList(byId("ends"), ends.map((end) => ({
      key: `${end.order_id} ${end.round} ${end.outcome}`,
      words: `${named("missionOutcome", end.outcome)}: ${withoutCommand(end.text)} (${number(end.took_s, 0)} s)`,
    })));
  }

  /** What the robot answered to the newest order that said where it stands. */
  private drawPlaced(): void {
    const answer = this.store.get<PoseCorrection>("POSE_CORRECTION");
    const ours = answer !== undefined && (answer.verdict === POSE_SET || answer.verdict === POSE_MOVING);
    setText(byId("placed"), !ours || this.store.age("POSE_CORRECTION") > SHOWN_S ? "" :
      text(answer.verdict === POSE_SET ? "placed" : "notPlaced"));
  }
}
