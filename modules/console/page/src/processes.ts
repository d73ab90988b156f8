// The processes of the robot and the workstation: how each is, what it lost, the lines it wrote, and a new start.

import { byId } from "./dom";
import { ProcessRow } from "./process_row";
import { Health, Item, ProcessAction, ProcessReport, ProcessState } from "./protocol";
import { Store } from "./store";

export interface ProcessPage {
  store: Store;
  mayOrder(): boolean;
  order(action: ProcessAction, name: string, end?: number): void;
}

export class Processes {
  private readonly rows = new Map<string, ProcessRow>();
  private readonly list = byId("processes");

  constructor(private readonly page: ProcessPage) {}

  hear(item: Item): void {
    const report = item.message as unknown as ProcessReport;
    if (item.channel === "PROCESS_REPORT") this.rows.get(report.name)?.hear(report);
  }

  draw(): void {
    const healths = this.page.store.all<Health>("HEALTH"), drawn = new Set<string>(), claimed = new Set<string>();
    for (const { key, message } of this.page.store.all<ProcessState>("PROCESS_STATE")) {
      const health = healths.find((item) => isOf(item.message.process, message.process));
      if (health !== undefined) claimed.add(health.message.process);
      this.row(message.process).draw({ state: message, stateKey: key, health: health?.message, healthKey: health?.key });
      drawn.add(message.process);
    }
    // Those that systemd, or a person by hand, has started: nobody takes orders about them.
    for (const { key, message } of healths) {
      if (claimed.has(message.process)) continue;
      this.row(message.process).draw({ health: message, healthKey: key });
      drawn.add(message.process);
    }
    for (const [name, row] of this.rows) if (!drawn.has(name)) this.drawUnknown(name, row, claimed.has(name));
  }

  /** What is not heard of since the station began stays, grey; what goes by its full name now does not. */
  private drawUnknown(name: string, row: ProcessRow, renamed: boolean): void {
    if (!renamed) return row.draw({});
    row.element.remove();
    this.rows.delete(name);
  }

  private row(name: string): ProcessRow {
    const known = this.rows.get(name);
    if (known !== undefined) return known;
    const row = new ProcessRow(name, this.page);
    this.rows.set(name, row);
    const next = [...this.rows.keys()].filter((other) => other > name).sort()[0];
    this.list.insertBefore(row.element, next === undefined ? null : this.rows.get(next)?.element ?? null);
    return row;
  }
}

/** HEALTH says "robot" where the deployment says "onboard-robot". */
function isOf(health: string, process: string): boolean {
  return health === process || `onboard-${health}` === process || `offboard-${health}` === process;
}
