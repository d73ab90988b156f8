// The texts and tables beside the plan.

import { byId, fillTable, Row, setText } from "./dom";
import { doFieldsTakeKeys } from "./keys";
import { DriveStatus, Hello, LandmarkFix, LinkStatus, Pose, StationState } from "./protocol";
import { Store } from "./store";
import { ageText, named, number, phaseText, text } from "./text";

const CONSOLE = 2;
const OBEYED_WITHIN_MS = 700;  // a hand that drives, by then

function degrees(rad: number): string {
  return `${number(rad * 180 / Math.PI, 1)}°`;
}

export class Panels {
  hello: Hello | undefined;
  station: StationState | undefined;
  connected = false;
  /** For how long this page's hand has held something [ms]. */
  held_ms: () => number = () => 0;

  constructor(private readonly store: Store) {}

  draw(): void {
    this.drawHeader();
    this.drawDrive();
    this.drawRobot();
    this.drawLink();
    this.drawLook();
  }

  /** Whether this page may give orders now. */
  mayOrder(): boolean {
    return this.connected && this.station?.role === "driver";
  }

  private offboardLink(): LinkStatus | undefined {
    return this.store.all<LinkStatus>("LINK_STATUS").map((item) => item.message).find((m) => !m.onboard);
  }

  private linkKey(): string {
    return this.store.all<LinkStatus>("LINK_STATUS").find((item) => !item.message.onboard)?.key ?? "";
  }

  private drawHeader(): void {
    const where = byId("connection");
    setText(where, text(this.connected ? "connected" : "lost"));
    where.className = this.connected ? "good" : "bad";
    const link = this.offboardLink();
    const up = link !== undefined && link.up && !this.store.isStale(this.linkKey());
    const words = [text(up ? "linkUp" : "linkDown")];
    if (link?.table_mismatch === true) words.push(text("linkMismatch"));
    if (up && this.hello !== undefined) {
      const rate = this.hello.link.bytes_per_s;
      words.push(`${number(link.utilisation_in * rate, 0)} ↓ ${number(link.utilisation * rate, 0)} ↑ / ${number(rate, 0)} B/s`);
    }
    words.push(`${text("pose")}: ${ageText(this.store.age("POSE"))}`);
    if (this.station?.role === "viewer") words.push(text("viewer"));
    setText(byId("summary"), words.join(" · "));
    byId("summary").className = up ? "" : "bad";
    const status = this.store.get<DriveStatus>("DRIVE_STATUS");
    byId("stopped").hidden = status?.estop !== true;
  }

  private drawDrive(): void {
    const station = this.station;
    if (station === undefined) return;
    const other = station.seat === "other";
    setText(byId("phase"), other ? text("otherPage") : this.phaseWords(station.phase));
    setText(byId("mode"), text(station.mode === "base" ? "moveBase" : "moveHead"));
    setText(byId("range"), text(station.fast ? "fast" : "slow"));
    byId("mode").setAttribute("aria-pressed", String(station.mode === "head"));
    byId("range").setAttribute("aria-pressed", String(station.fast));
    for (const id of ["mode", "range", "take-over", "rearm"])
      byId<HTMLButtonElement>(id).disabled = !this.mayOrder();
  }

  /** A hand that is held and not obeyed is told so, and one whose keys go elsewhere. */
  private phaseWords(phase: StationState["phase"]): string {
    const free = phase === "no_device" || phase === "idle";
    if (free && this.mayOrder() && this.held_ms() > OBEYED_WITHIN_MS) return phaseText("must_let_go");
    if (free && doFieldsTakeKeys()) return `${phaseText(phase)}; ${text("keysInField")}`;
    return phaseText(phase);
  }

  private drawRobot(): void {
    const rows: Row[] = [];
    const pose = this.store.get<Pose>("POSE"), status = this.store.get<DriveStatus>("DRIVE_STATUS");
    if (pose !== undefined) {
      const stale = this.store.isStale("POSE");
      rows.push({ cells: [text("pose"), `${number(pose.x_m, 2)} m, ${number(pose.y_m, 2)} m, ${degrees(pose.yaw_rad)}`], stale });
      rows.push({ cells: [text("sigma"), `${number(100 * Math.hypot(pose.sigma_x_m, pose.sigma_y_m), 1)} cm, ${degrees(pose.sigma_yaw_rad)}`], stale });
    }
    rows.push({ cells: [`${text("pose")}: ${text("age")}`, ageText(this.store.age("POSE"))], stale: this.store.isStale("POSE") });
    if (status !== undefined) rows.push(...this.statusRows(status));
    fillTable(byId("robot"), rows);
  }

  private statusRows(status: DriveStatus): Row[] {
    const stale = this.store.isStale("DRIVE_STATUS");
    const mine = status.driver === CONSOLE && status.session === this.station?.session;
    const rows: Row[] = [
      { cells: [text("doing"), named("doing", status.mode)], stale },
      { cells: [text("speed"), `${number(status.speed_m_s, 2)} m/s`], stale },
      { cells: [text("limit"), `${named("limit", status.limit)} (${number(100 * status.allowed, 0)} %)`], stale,
        kind: status.limit === 0 ? "good" : "warn" },
      { cells: [text("nearest"), status.nearest_m < 0 ? "> 5 m" : `${number(status.nearest_m, 2)} m`], stale },
      { cells: [text("driver"), mine ? text("yours") : named("driver", status.driver)], stale },
    ];
    if (status.refused > 0)
      rows.push({ cells: [text("refusal"), `${named("refusal", status.refusal)} (${status.refused})`], stale });
    rows.push({ cells: [text("age"), ageText(this.store.age("DRIVE_STATUS"))], stale });
    return rows;
  }

  private drawLink(): void {
    const link = this.offboardLink();
    const bars = byId("bars");
    if (link === undefined || this.hello === undefined) return setText(bars, text("never"));
    const rate = this.hello.link.bytes_per_s;
    const stale = this.store.isStale(this.linkKey());
    bars.replaceChildren(this.bar(text("down"), link.utilisation, rate), this.bar(text("up"), link.utilisation_in, rate),
      this.line(`${text("roundTrip")} ${link.round_trip_s < 0 ? "–" : `${number(1000 * link.round_trip_s, 0)} ms`} · ` +
        `${text("loss")} ${number(100 * Math.max(link.loss, link.peer_loss), 0)} % · ` +
        `${text("rejected")} ${link.frames_rejected} · ${text("age")} ${ageText(this.store.age(this.linkKey()))}`),
      this.line(`${text("pages")} ${this.station?.pages ?? 0} · ${text("refusedPages")} ${this.station?.refused ?? 0}`));
    bars.classList.toggle("stale", stale);
    this.drawChannels();
  }

  private bar(name: string, share: number, rate: number): HTMLElement {
    const row = document.createElement("div");
    row.className = "bar";
    const label = document.createElement("span"), meter = document.createElement("meter"), value = document.createElement("span");
    label.textContent = name;
    meter.max = 1;
    meter.high = 0.9;
    meter.value = share;
    meter.setAttribute("aria-label", name);
    value.textContent = `${number(share * rate, 0)} / ${number(rate, 0)} B/s`;
    row.append(label, meter, value);
    return row;
  }

  private line(words: string): HTMLElement {
    const p = document.createElement("p");
    p.className = "age";
    p.textContent = words;
    return p;
  }

  private drawChannels(): void {
    const rows: Row[] = [];
    for (const item of this.store.all<LinkStatus>("LINK_STATUS")) {
      if (item.message.onboard) continue;
      for (const c of item.message.channels)
        rows.push({ cells: [`${c.outgoing ? "↑" : "↓"} ${c.channel}`, String(c.messages), String(c.bytes),
          String(c.dropped), String(c.late), `${number(c.queue_age_s, 1)} s`] });
    }
    fillTable(byId("channels"), rows,
      ["", text("message"), text("bytes"), text("dropped"), text("expired"), text("waiting")]);
  }

  private drawLook(): void {
    const fix = this.store.get<LandmarkFix>("LANDMARK_FIX");
    if (fix === undefined) return setText(byId("look"), text("never"));
    const door = this.hello?.plan.doors.find((d) => d.id === fix.landmark_id)?.name ?? String(fix.landmark_id);
    const details = fix.verdict === 0 ?
      ` · ${fix.n_matched} ${text("edgesUsed")} · ${number(fix.residual_px, 2)} px` : "";
    setText(byId("look"),
      `${text("looked")} ${door}: ${named("verdict", fix.verdict)}${details} (${ageText(this.store.age("LANDMARK_FIX"))})`);
  }
}
