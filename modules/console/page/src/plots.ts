// The view of plots: any number of any channel, on charts. Loaded when it is opened first.

import { Chart, Frame, lineColour } from "./chart";
import { setText } from "./dom";
import { describe, Json, numberAt, TypeSchema, unitOf } from "./fields";
import { FieldList } from "./field_list";
import { Item } from "./protocol";
import { Series } from "./series";
import type { PageServices, View } from "./views";

const MOST_CHARTS = 4, MOST_LINES = 12;
const WINDOWS_S = [10, 30, 60, 300];

export function open(element: HTMLElement, page: PageServices): View {
  return new Plots(element, page);
}

/** What is one line: a channel, or one of several processes or radios that speak on it. Alarms are one after the other. */
function nameOf(item: Item): string {
  return item.channel === "ALARM" ? item.channel : item.key;
}

interface Panel { chart: Chart; root: HTMLElement; legend: HTMLElement }

class Plots implements View {
  private readonly panels: Panel[] = [];
  private readonly schemas = new Map<string, TypeSchema>();  // by type
  private readonly types = new Map<string, string>();  // type by channel
  private readonly list: FieldList;
  private readonly charts = document.createElement("div");
  private readonly pause = document.createElement("button");
  private readonly more = document.createElement("button");
  private readonly clear = document.createElement("button");
  private readonly span = document.createElement("select");
  private pausedAt: number | undefined;
  private cursor: { chart: Chart; u: number } | undefined;
  private active = 0;

  constructor(element: HTMLElement, private readonly page: PageServices) {
    this.list = new FieldList(page, (channel, path) => this.add(this.active, channel, path));
    const tools = document.createElement("div");
    tools.className = "tools";
    for (const s of WINDOWS_S) this.span.add(new Option(`${s} s`, String(s), s === 30, s === 30));
    this.pause.addEventListener("click", () => this.setPaused(this.pausedAt === undefined));
    this.more.addEventListener("click", () => this.addChart());
    this.clear.addEventListener("click", () => this.removeAll());
    for (const button of [this.pause, this.more, this.clear]) button.type = "button";
    tools.append(this.pause, this.span, this.more, this.clear);
    this.charts.className = "charts";
    const right = document.createElement("div");
    right.className = "plots-right";
    right.append(tools, this.charts);
    element.classList.add("plots");
    element.append(this.list.element, right);
    page.store.each((item, valid_s) => this.hear(item, valid_s));
    this.addChart();
    this.label();
  }

  show(on: boolean): void {
    if (on) this.list.update(true);
  }

  hear(item: Item, valid_s: number): void {
    const name = nameOf(item);
    this.types.set(name, item.type);
    this.list.hear(name, item.message as Json);
    for (const { chart } of this.panels)
      for (const series of chart.series) {
        if (series.channel !== name) continue;
        const value = numberAt(item.message as Json, series.path);
        if (value !== undefined) series.add(valid_s, value);
      }
  }

  restart(): void {
    if (this.page.hello()?.replay === undefined) return;  // what was heard stays true
    for (const { chart } of this.panels) for (const series of chart.series) series.clear();
    if (this.pausedAt !== undefined) this.setPaused(false);
  }

  label(): void {
    const { text } = this.page;
    setText(this.pause, text(this.pausedAt === undefined ? "holdChart" : "goOn"));
    setText(this.more, text("moreCharts"));
    setText(this.clear, text("clearCharts"));
    this.span.setAttribute("aria-label", text("timeSpan"));
    this.list.label();
    for (const panel of this.panels) panel.chart.canvas.setAttribute("aria-label", text("chartHelp"));
  }

  draw(): void {
    this.list.update(false);
    for (const panel of this.panels) {
      const frame = this.frame(panel.chart);
      panel.chart.draw(frame);
      this.drawLegend(panel, frame);
    }
  }

  private frame(chart: Chart): Frame {
    const to = this.pausedAt ?? this.page.now();
    const frame: Frame = { from: to - Number(this.span.value), to, cursor: undefined, unit: this.commonUnit(chart),
      hint: chart.series.length === 0 ? this.page.text("chartHint") : "" };
    if (this.cursor?.chart === chart) frame.cursor = chart.timeAt(this.cursor.u, frame);
    return frame;
  }

  private commonUnit(chart: Chart): string {
    const units = new Set(chart.series.map((series) => unitOf(this.descriptionOf(series))));
    return units.size === 1 ? [...units].join("") : "";
  }

  private descriptionOf(series: Series): string {
    const type = this.types.get(series.channel) ?? "";
    if (type !== "" && !this.schemas.has(type)) {
      this.schemas.set(type, {});
      void fetch(`/types/${type}.json`).then((answer) => answer.ok ? answer.json() : {})
        .then((schema: TypeSchema) => this.schemas.set(type, schema)).catch(() => this.schemas.delete(type));
    }
    return describe(this.schemas.get(type), series.path);
  }

  private setPaused(on: boolean): void {
    this.pausedAt = on ? this.page.now() : undefined;
    this.pause.setAttribute("aria-pressed", String(on));
    this.label();
  }

  private addChart(): void {
    if (this.panels.length >= MOST_CHARTS) return;
    const root = document.createElement("div"), legend = document.createElement("ul"), canvas = document.createElement("canvas");
    root.className = "chart";
    canvas.setAttribute("role", "img");
    root.append(canvas, legend);
    this.charts.append(root);
    const panel = { chart: new Chart(canvas, (v, digits) => this.page.number(v, digits)), root, legend };
    this.panels.push(panel);
    this.choose(panel);
    root.addEventListener("pointerdown", () => this.choose(panel));
    root.addEventListener("dragover", (event) => event.preventDefault());
    root.addEventListener("drop", (event) => this.drop(event, panel));
    canvas.addEventListener("pointermove", (event) => { this.cursor = { chart: panel.chart, u: event.offsetX }; });
    canvas.addEventListener("pointerleave", () => { this.cursor = undefined; });
    this.more.disabled = this.panels.length >= MOST_CHARTS;
    this.label();
  }

  private choose(panel: Panel): void {
    this.active = this.panels.indexOf(panel);
    for (const one of this.panels) one.root.classList.toggle("active", one === panel && this.panels.length > 1);
  }

  private drop(event: DragEvent, panel: Panel): void {
    event.preventDefault();
    const words = /^(.+) (\S+)$/.exec(event.dataTransfer?.getData("text/plain") ?? "");
    if (words?.[1] !== undefined && words[2] !== undefined) this.add(this.panels.indexOf(panel), words[1], words[2]);
  }

  private add(index: number, channel: string, path: string): void {
    const panel = this.panels[index];
    if (panel === undefined || panel.chart.series.length >= MOST_LINES) return;
    if (panel.chart.series.some((series) => series.channel === channel && series.path === path)) return;
    const series = new Series(channel, path);
    const kept = this.page.store.newest(channel);
    const value = kept === undefined ? undefined : numberAt(kept.item.message as Json, path);
    if (kept !== undefined && value !== undefined) series.add(kept.valid_s, value);
    panel.chart.series.push(series);
    this.want(series, true);
    this.fillLegend(panel);
  }

  private remove(panel: Panel, series: Series): void {
    panel.chart.series.splice(panel.chart.series.indexOf(series), 1);
    const left = this.panels.some(({ chart }) => chart.series.some((s) => s.channel === series.channel));
    if (!left) this.want(series, false);
    this.fillLegend(panel);
  }

  private removeAll(): void {
    for (const panel of this.panels) for (const series of [...panel.chart.series]) this.remove(panel, series);
    for (const panel of this.panels.splice(1)) panel.root.remove();
    if (this.panels[0] !== undefined) this.choose(this.panels[0]);
    this.more.disabled = false;
  }

  /** What the radio carries only on request. */
  private want(series: Series, on: boolean): void {
    if (this.page.hello()?.channels[series.channel]?.on_request === true)
      this.page.want("plots", [series.channel], on);
  }

  private fillLegend(panel: Panel): void {
    panel.legend.replaceChildren(...panel.chart.series.map((series, i) => {
      const line = document.createElement("li"), name = document.createElement("span"), value = document.createElement("output");
      const away = document.createElement("button");
      const mark = document.createElement("i");
      mark.style.background = lineColour(i);
      name.textContent = series.name;
      away.type = "button";
      away.textContent = "×";
      away.setAttribute("aria-label", `${this.page.text("takeAway")} ${series.name}`);
      away.addEventListener("click", () => this.remove(panel, series));
      line.append(mark, name, value, away);
      return line;
    }));
  }

  private drawLegend(panel: Panel, frame: Frame): void {
    panel.chart.series.forEach((series, i) => {
      const line = panel.legend.children[i] as HTMLElement | undefined;
      const value = line?.querySelector("output"), mark = line?.querySelector("i");
      if (line === undefined || value === null || value === undefined) return;
      const description = this.descriptionOf(series), sample = series.at(frame.cursor ?? frame.to);
      if (mark !== null && mark !== undefined) mark.style.background = lineColour(i);
      line.title = description;
      setText(value, sample === undefined ? "–" : `${this.page.number(sample.v, Math.abs(sample.v) < 100 ? 3 : 1)} ${unitOf(description)}`);
    });
  }
}
