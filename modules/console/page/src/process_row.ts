// One process: a line that opens.

import { setText } from "./dom";
import type { ProcessPage } from "./processes";
import { Health, ProcessReport, ProcessState } from "./protocol";
import { ageText, named, number, text } from "./text";
import { TwoStep } from "./two_step";

const PATIENCE_MS = 17_000;  // the station gives up after 8 s, and the order may have waited for another
const READY_WITHIN_MS = 5000;  // a restart that is answered sooner has brought the process back
const HEALTH_OK = 1, READY = 2, DONE = 0;
const MOST_TEXT = 4000;
const PIECES = 8;  // that are asked for at once where no radio is in between

/** What is known of a process; one without a state has no supervisor who takes orders. */
export interface Known { state?: ProcessState; stateKey?: string; health?: Health | undefined; healthKey?: string | undefined }

export class ProcessRow {
  readonly element = document.createElement("details");
  private readonly title = document.createElement("span");
  private readonly mark = document.createElement("span");
  private readonly counts = document.createElement("span");
  private readonly why = document.createElement("p");
  private readonly lost = document.createElement("p");
  private readonly buttons = document.createElement("div");
  private readonly restart: TwoStep;
  private readonly log = document.createElement("button");
  private readonly earlier = document.createElement("button");
  private readonly answer = document.createElement("p");
  private readonly lines = document.createElement("pre");
  private begin = 0;  // bytes: where in the console the shown lines begin
  private asked: { what: "restart" | "log"; ms: number; end: number } | undefined;
  private outcome: number | undefined;
  private ready = false;  // the outcome says so
  private more = 0;  // pieces that are still to be asked for
  private supervised = false;

  constructor(private readonly name: string, private readonly page: ProcessPage) {
    const summary = document.createElement("summary");
    this.counts.className = "age";
    this.restart = new TwoStep(
      () => [text("restart"), text(name.endsWith("-robot") ? "restartRobotNow" : "restartNow")], () => this.order("restart"));
    for (const button of [this.log, this.earlier]) button.type = "button";
    this.log.addEventListener("click", () => this.ask(0));
    this.earlier.addEventListener("click", () => this.ask(this.begin));
    this.answer.setAttribute("role", "status");
    this.lines.tabIndex = 0;
    this.lines.hidden = true;
    this.buttons.className = "buttons";
    this.buttons.append(this.restart.element, this.log, this.earlier);
    summary.append(this.title, this.mark, this.counts);
    this.element.className = "process";
    this.element.dataset.name = name;
    this.element.append(summary, this.why, this.lost, this.buttons, this.answer, this.lines);
    setText(this.title, name);
  }

  /** An answer; one that nobody here has asked for is another page's. */
  hear(report: ProcessReport): void {
    const asked = this.asked;
    if (asked === undefined) return;
    this.asked = undefined;
    this.outcome = report.outcome;
    this.ready = asked.what === "restart" && report.outcome === DONE && performance.now() - asked.ms < READY_WITHIN_MS;
    if (asked.what !== "log" || report.outcome !== DONE) return;
    this.show(report, asked.end);
    if (--this.more > 0 && this.begin > 0) this.order("log", this.begin);
  }

  draw(known: Known): void {
    const { state, health } = known;
    this.supervised = state !== undefined;
    const stale = this.page.store.isStale(known.stateKey ?? known.healthKey ?? "");
    this.element.classList.toggle("stale", stale);
    this.drawMark(state, health, known.healthKey);
    const starts = Math.max(0, (state?.starts ?? 1) - 1);
    const lost = health === undefined ? 0 : health.messages_lost + health.decode_errors + health.handler_exceptions;
    setText(this.counts, [starts > 0 ? `${text("startedAgain")} ${starts}×` : "", lost > 0 ? `${text("lostSoFar")} ${lost}` : "",
      state?.alarm === true ? text("failsAgain") : ""].filter((word) => word !== "").join(" · "));
    if (this.element.open) this.drawInside(health, known.healthKey);
  }

  private drawMark(state: ProcessState | undefined, health: Health | undefined, healthKey: string | undefined): void {
    const silent = healthKey !== undefined && this.page.store.isStale(healthKey);
    const ready = state === undefined || state.state === READY;
    const good = ready && (health === undefined || (health.state === HEALTH_OK && !silent));
    setText(this.mark, !ready && state !== undefined ? named("processState", state.state)
      : silent ? text("silent") : health === undefined ? named("processState", READY) : named("health", health.state));
    this.mark.className = good ? "good" : state?.alarm === true || health?.state === 3 ? "bad" : "warn";
  }

  private drawInside(health: Health | undefined, healthKey: string | undefined): void {
    setText(this.why, health === undefined ? "" : health.text !== "" ? health.text : clockText(health));
    setText(this.lost, health === undefined ? "" : `${text("messagesLost")} ${health.messages_lost} · ` +
      `${text("refusedMessages")} ${health.decode_errors} · ${text("exceptions")} ${health.handler_exceptions} · ` +
      `${text("lateTicks")} ${health.loop_overruns} · ${text("age")} ${ageText(this.page.store.age(healthKey ?? ""))}`);
    this.lost.className = "age";
    this.drawButtons();
    const late = this.asked !== undefined && performance.now() - this.asked.ms > PATIENCE_MS;
    const refused = this.outcome !== undefined && this.outcome !== DONE;
    setText(this.answer, !this.supervised ? text("notSupervised") : late ? text("noAnswer")
      : this.asked !== undefined ? text("underWay")
        : refused ? named("processOutcome", this.outcome ?? DONE)
          : this.outcome !== undefined && this.ready ? text("readyAgain") : "");
    this.answer.className = late || refused ? "bad" : "age";
  }

  private drawButtons(): void {
    const waits = this.asked !== undefined && performance.now() - this.asked.ms <= PATIENCE_MS;
    const may = this.supervised && this.page.mayOrder() && !waits;
    this.restart.draw();
    setText(this.log, text("lastLines"));
    setText(this.earlier, text("earlierLines"));
    this.buttons.hidden = !this.supervised;
    this.earlier.hidden = this.lines.hidden || this.begin === 0;
    for (const button of [this.restart.element, this.log, this.earlier]) button.disabled = !may;
  }

  private ask(end: number): void {
    this.more = this.name.startsWith("onboard-") ? 1 : PIECES;
    this.order("log", end);
  }

  private order(what: "restart" | "log", end = 0): void {
    if (!this.page.mayOrder()) return;
    this.asked = { what, ms: performance.now(), end };
    this.outcome = undefined;
    this.page.order(what, this.name, what === "log" ? end : undefined);
  }

  /** Lines go before those that are shown when they end where those begin. */
  private show(report: ProcessReport, end: number): void {
    const before = end === 0 ? "" : this.lines.textContent ?? "";
    this.begin = report.begin_bytes;
    this.lines.hidden = false;
    setText(this.lines, `${report.text}${before}`.slice(0, MOST_TEXT));
  }
}

/** How far the clock of a process's host is off the reference, if it is. */
function clockText(health: Health): string {
  const { clock_ahead_s: ahead = 0, clock_uncertainty_s: uncertainty = 0 } = health;
  if (uncertainty < 0) return text("clockUnknown");
  if (Math.abs(ahead) <= uncertainty) return "";
  return `${text("clock")} ${ahead > 0 ? "+" : "−"}${number(Math.abs(ahead), 4)} s ± ${number(1000 * uncertainty, 1)} ms`;
}
