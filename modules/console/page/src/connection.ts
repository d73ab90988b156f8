// The WebSocket to the station: opened again when it breaks. Nothing is ever queued: what cannot be sent now is not sent.

import { Hello, News, ParameterAction, ProcessAction, StickReport } from "./protocol";
import { ReplayAction } from "./replay";
import { Place } from "./target";

const RETRY_MS = 500;
const SILENCE_MS = 1000;  // the station sends 20 times a second
const MOST_WAITING = 2000;  // bytes that the browser has not handed on: then the network stands still

export interface Listener {
  hello(hello: Hello): void;
  news(news: News): void;
  connected(up: boolean): void;
  picture(message: ArrayBuffer): void;
}

export class Connection {
  private socket: WebSocket | undefined;
  private beat = 0;
  private heard_ms = 0;
  private up = false;

  constructor(private readonly listener: Listener) {
    this.open();
    window.setInterval(() => this.watch(), 200);
  }

  isUp(): boolean {
    return this.up;
  }

  stick(report: StickReport): void {
    if (this.up) this.send({ type: "stick", beat: this.beat, ...report });
  }

  stop(): void {
    this.send({ type: "stop" });
  }

  passDoor(landmark: number): void {
    this.send({ type: "mission", order: "pass_door", landmark });
  }

  goTo(place: Place): void {
    this.send({ type: "mission", order: "goto", x_m: place.x, y_m: place.y, yaw_rad: place.yaw ?? 0,
      turn: place.yaw !== undefined });
  }

  /** The robot stands there. */
  place(place: Place): void {
    this.send({ type: "place", x_m: place.x, y_m: place.y, yaw_rad: place.yaw ?? 0 });
  }

  parameter(process: string, action: ParameterAction, key?: string, value?: number): void {
    this.send({ type: "parameter", process, action, key, value });
  }

  /** Of whoever supervises a process; `end`: where in its console the lines end. */
  process(action: ProcessAction, name: string, end?: number): void {
    this.send({ type: "process", action, name, end });
  }

  replay(action: ReplayAction): void {
    this.send({ type: "replay", action });
  }

  setReplay(action: "seek" | "speed", value: number): void {
    this.send({ type: "replay", action, value });
  }

  abort(): void {
    this.send({ type: "mission", order: "abort" });
  }

  listen(channel: string, on: boolean): void {
    this.send({ type: "listen", channel, on });
  }

  private send(message: object): void {
    const socket = this.socket;
    if (socket === undefined || socket.readyState !== WebSocket.OPEN) return;
    if (socket.bufferedAmount <= MOST_WAITING) socket.send(JSON.stringify(message));
  }

  private open(): void {
    const token = new URLSearchParams(location.search).get("token");
    const query = token === null ? "" : `?token=${encodeURIComponent(token)}`;
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    const socket = new WebSocket(`${scheme}://${location.host}/socket${query}`);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    this.heard_ms = performance.now();
    socket.onmessage = (event) => {
      if (this.socket !== socket) return;
      if (event.data instanceof ArrayBuffer) this.listener.picture(event.data);
      else this.take(JSON.parse(String(event.data)) as Hello | News);
    };
    socket.onclose = () => {
      if (this.socket !== socket) return;
      this.socket = undefined;
      this.setUp(false);
      window.setTimeout(() => this.open(), RETRY_MS);
    };
  }

  private take(text: Hello | News): void {
    this.heard_ms = performance.now();
    if (text.type === "hello") {
      this.beat = 0;
      this.listener.hello(text);
      this.setUp(true);
    } else {
      this.beat = text.beat;
      this.listener.news(text);
    }
  }

  private watch(): void {
    const silent = performance.now() - this.heard_ms > SILENCE_MS;
    if (this.up && silent) this.setUp(false);
    else if (!this.up && !silent && this.beat > 0 && this.socket?.readyState === WebSocket.OPEN) this.setUp(true);
    if (silent && performance.now() - this.heard_ms > 5 * SILENCE_MS) this.socket?.close();
  }

  private setUp(up: boolean): void {
    if (up === this.up) return;
    this.up = up;
    this.listener.connected(up);
  }
}
