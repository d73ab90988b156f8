// Puts the page together.

import { Connection } from "./connection";
import { byId, setText } from "./dom";
import { Hand } from "./drive";
import { drawHeadView } from "./head_view";
import { Panels } from "./panels";
import { PlanView } from "./plan_view";
import { Hello, News } from "./protocol";
import { Store } from "./store";
import { currentLanguage, number, setLanguage, text } from "./text";

const PANEL_PERIOD_MS = 200;

const store = new Store();
const panels = new Panels(store);
const plan = new PlanView(byId<HTMLCanvasElement>("plan"), store);
const wanted = new Map<string, boolean>();

const connection: Connection = new Connection({
  hello(hello: Hello): void {
    store.greet(hello);
    plan.greet(hello);
    panels.hello = hello;
    showDoors(hello);
    for (const [channel, on] of wanted) if (on) connection.listen(channel, true);
  },
  news(news: News): void {
    const now_ms = performance.now();
    for (const item of news.items) store.put(item, now_ms);
    panels.station = news.station;
    hand.mode = news.station.mode;
  },
  connected(up: boolean): void {
    panels.connected = up;
    hand.letGo();
    panels.draw();
  },
});

const hand = new Hand(byId<HTMLCanvasElement>("stick"), byId<HTMLInputElement>("turn"), (report) => connection.stick(report));

function showDoors(hello: Hello): void {
  byId<HTMLSelectElement>("door").replaceChildren(...hello.plan.doors.map((door) => {
    const option = document.createElement("option");
    option.value = String(door.id);
    option.textContent = door.name;
    return option;
  }));
}

/** A channel that the radio carries only on request is wanted while it is shown. */
function want(channels: string[], on: boolean): void {
  for (const channel of channels) {
    wanted.set(channel, on);
    connection.listen(channel, on && document.visibilityState === "visible");
  }
}

function bindSwitch(id: string, channels: string[], set: (on: boolean) => void): void {
  const box = byId<HTMLInputElement>(id);
  box.addEventListener("change", () => {
    set(box.checked);
    want(channels, box.checked);
  });
}

function stop(): void {
  connection.stop();
  hand.letGo();
}

function label(): void {
  setLanguage(currentLanguage());
  setText(byId("language"), currentLanguage() === "en" ? "Deutsch" : "English");
  byId("plan").setAttribute("aria-label", text("planHelp"));
  byId("plan").title = text("planHelp");
  byId("stick").setAttribute("aria-label", text("stickHelp"));
  byId("edges").setAttribute("aria-label", text("viewHelp"));
}

function bindButtons(): void {
  byId("stop").addEventListener("click", stop);
  hand.onStop = stop;
  hand.bind(byId("rearm"), "rearm");
  hand.bind(byId("mode"), "mode");
  hand.bind(byId("range"), "range");
  hand.bind(byId("take-over"), "take_over");
  byId("pass").addEventListener("click", () => connection.passDoor(Number(byId<HTMLSelectElement>("door").value)));
  byId("abort").addEventListener("click", () => connection.abort());
  byId("zoom-in").addEventListener("click", () => plan.port.zoom(1.25));
  byId("zoom-out").addEventListener("click", () => plan.port.zoom(0.8));
  byId("fit").addEventListener("click", () => plan.fit());
  byId("language").addEventListener("click", () => {
    setLanguage(currentLanguage() === "en" ? "de" : "en");
    label();
    panels.draw();
  });
}

function bindSwitches(): void {
  bindSwitch("follow", [], (on) => { plan.follows = on; });
  bindSwitch("sonars", ["SONAR_RANGES", "OBSTACLE_LINE"], (on) => { plan.showsSonars = on; });
  bindSwitch("view", ["LANDMARK_VIEW"], () => undefined);
  plan.port.onUserMove = () => {
    plan.follows = false;
    byId<HTMLInputElement>("follow").checked = false;
  };
  document.addEventListener("visibilitychange", () => {
    for (const [channel, on] of wanted)
      if (on) connection.listen(channel, document.visibilityState === "visible");
  });
}

function drawFrame(): void {
  plan.draw();
  hand.draw();
  const distance_m = plan.measured();
  setText(byId("measured"), distance_m === undefined ? "" : `${number(distance_m, 2)} m`);
  window.requestAnimationFrame(drawFrame);
}

label();
bindButtons();
bindSwitches();
window.setInterval(() => {
  panels.draw();
  drawHeadView(byId<HTMLCanvasElement>("edges"), store);
}, PANEL_PERIOD_MS);
drawFrame();
