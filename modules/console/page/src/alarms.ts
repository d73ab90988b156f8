// The alarms: those that nobody has taken note of first, and who has taken note of the others.

import { byId, fillList, ListLine, setText } from "./dom";
import { Alarm, AlarmAck } from "./protocol";
import { Store } from "./store";
import { ageText, named, text } from "./text";

const MOST_ALARMS = 50;
const SECOND_US = 1e6;

export interface AlarmMeans {
  mayOrder(): boolean;
  now(): number;  // s, of the clock in which messages age
  acknowledge(alarm: Alarm): void;
}

export class AlarmPanel {
  private readonly mark = byId("alarm-mark");

  constructor(private readonly store: Store, private readonly means: AlarmMeans) {
    this.mark.addEventListener("click", () => byId("alarm-title").scrollIntoView());
  }

  draw(): void {
    const acks = this.store.all<AlarmAck>("ALARM_ACK").map((item) => item.message);
    const alarms = this.store.all<Alarm>("ALARM").map((item) => ({ alarm: item.message,
      ack: acks.find((a) => a.source === item.message.source && a.utime_alarm === item.message.utime) }));
    alarms.sort((a, b) => Number(a.ack !== undefined) - Number(b.ack !== undefined) || b.alarm.utime - a.alarm.utime);
    const lines = alarms.slice(0, MOST_ALARMS).map(({ alarm, ack }) => this.line(alarm, ack));
    fillList(byId("alarms"), lines.length > 0 ? lines : [{ key: "none", words: text("noAlarms") }]);
    this.drawMark(alarms.filter(({ ack }) => ack === undefined).length);
  }

  /** In the head of the page: what nobody has taken note of is seen wherever one looks. */
  private drawMark(open: number): void {
    this.mark.hidden = open === 0;
    setText(this.mark, open === 1 ? text("oneOpenAlarm") : `${open} ${text("openAlarms")}`);
  }

  private line(alarm: Alarm, ack: AlarmAck | undefined): ListLine {
    const may = this.means.mayOrder();
    const words = `${named("severity", alarm.severity)}: ${alarm.source}: ${alarm.text}`;
    const when = ageText(this.means.now() - alarm.utime / SECOND_US);
    if (ack !== undefined)
      return { key: `${alarm.source} ${alarm.utime} seen`, words: `${words} (${text("acknowledgedBy")} ${ack.by})`, kind: "soft" };
    return { key: `${alarm.source} ${alarm.utime} ${may}`, words: `${words} (${when})`,
      kind: alarm.severity > 0 ? "bad" : "warn",
      button: may ? { words: text("acknowledge"), act: () => this.means.acknowledge(alarm) } : undefined };
  }
}
