// Puts the page together.

import { AlarmPanel } from "./alarms";
import { Connection } from "./connection";
import { byId, setText } from "./dom";
import { Hand } from "./drive";
import { HeadAim } from "./head_aim";
import { drawHeadView } from "./head_view";
import { bindCheckBoxes } from "./keys";
import { MissionPanel } from "./mission";
import { Panels } from "./panels";
import { PlanView } from "./plan_view";
import { Processes } from "./processes";
import { Hello, News } from "./protocol";
import { Replay } from "./replay";
import { Store } from "./store";
import { Target } from "./target";
import { currentLanguage, named, number, setLanguage, text } from "./text";
import { Video } from "./video";
import { PageServices, Views } from "./views";
import { Wants } from "./wants";
import { World } from "./world";

const PANEL_PERIOD_MS = 200;

const replay = new Replay({
  act: (action) => connection.replay(action),
  set: (what, value) => connection.setReplay(what, value),
});
const store = new Store(() => replay.now());
const panels = new Panels(store);
const plan = new PlanView(byId<HTMLCanvasElement>("plan"), store);
const target = new Target(plan.port);
plan.target = () => target.place();
const missions = new MissionPanel(store, target, {
  mayOrder: () => panels.mayOrder(),
  order: (order) => connection.mission(order),
  place: (place) => connection.place(place),
});
const headAim = new HeadAim(store, plan.port, {
  mayOrder: () => panels.mayOrder(),
  aim: (aim) => connection.aim(aim),
  hello: () => panels.hello,
});
const alarms = new AlarmPanel(store, {
  mayOrder: () => panels.mayOrder(),
  now: () => replay.now(),
  acknowledge: (alarm) => connection.acknowledge(alarm),
});
plan.patrol = () => missions.patrol;
const video = new Video();
const wants = new Wants((channel, on) => connection.listen(channel, on));
const services: PageServices = {
  store, text, number,
  hello: () => panels.hello,
  floor: () => plan.floor,
  now: () => replay.now(),
  want: (owner, channels, on) => wants.set(owner, channels, on),
  mayOrder: () => panels.mayOrder(),
  parameter: (process, action, key, value) => {
    if (panels.mayOrder()) connection.parameter(process, action, key, value);
  },
  outcomeText: (outcome) => named("outcome", outcome),
};
const processes = new Processes({ store, mayOrder: services.mayOrder,
  order: (action, name, end) => connection.process(action, name, end) });
const world = new World({ store, mayOrder: services.mayOrder,
  order: (action, name) => connection.process(action, name), forget: () => plan.forget() });
const views = new Views({
  values: async (element) => (await import("./values.js")).open(element, services),
  space: async (element) => (await import("./space.js")).open(element, services),
  plots: async (element) => (await import("./plots.js")).open(element, services),
});

const connection: Connection = new Connection({
  hello(hello: Hello): void {
    replay.greet(hello);
    store.greet(hello);
    plan.greet(hello);
    panels.hello = hello;
    missions.greet(hello);
    video.offer(hello.video === true);
    document.body.classList.toggle("any-bus", hello.any_bus === true);
    if (hello.any_bus === true && views.isShown("plan")) views.choose("plots");
    views.each((view) => view.restart());
    wants.tellAll();
  },
  news(news: News): void {
    replay.hear(news.station.replay);
    for (const item of news.items) {
      store.put(item);
      plan.floor.hear(item);
      processes.hear(item);
      world.hear(item);
      views.each((view) => view.hear(item, store.validTime(item)));
    }
    const could = panels.mayOrder();
    panels.station = news.station;
    if (!could && panels.mayOrder()) hand.letGo();  // says that it rests: the station obeys no other
    hand.mode = news.station.mode;
  },
  connected(up: boolean): void {
    panels.connected = up;
    hand.letGo();
    panels.draw();
  },
  picture(message: ArrayBuffer): void {
    video.hear(message);
  },
});

const hand = new Hand(byId<HTMLCanvasElement>("stick"), byId<HTMLInputElement>("turn"), (report) => {
  if (panels.mayOrder()) connection.stick(report);
});

function bindSwitch(id: string, channels: string[], set: (on: boolean) => void): void {
  const box = byId<HTMLInputElement>(id);
  box.addEventListener("change", () => {
    set(box.checked);
    wants.set(id, channels, box.checked);
  });
}

/** What a part of the page shows while it is open. */
function bindOpen(id: string, channels: string[]): void {
  const part = byId<HTMLDetailsElement>(id);
  part.addEventListener("toggle", () => wants.set(id, channels, part.open));
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
  byId("position").setAttribute("aria-label", text("position"));
  byId("pick").title = text("pickHelp");
  byId("look-there").title = text("lookThereHelp");
  byId("stick").setAttribute("aria-label", text("stickHelp"));
  byId("edges").setAttribute("aria-label", text("viewHelp"));
  byId<HTMLImageElement>("picture").alt = text("pictureHelp");
}

function bindButtons(): void {
  byId("stop").addEventListener("click", stop);
  hand.onStop = stop;
  hand.bind(byId("rearm"), "rearm");
  hand.bind(byId("mode"), "mode");
  hand.bind(byId("range"), "range");
  hand.bind(byId("take-over"), "take_over");
  plan.port.onPicked = () => missions.draw();
  byId("zoom-in").addEventListener("click", () => plan.port.zoom(1.25));
  byId("zoom-out").addEventListener("click", () => plan.port.zoom(0.8));
  byId("fit").addEventListener("click", () => plan.fit());
  byId("language").addEventListener("click", () => {
    setLanguage(currentLanguage() === "en" ? "de" : "en");
    label();
    world.label();
    views.each((view) => view.label());
    panels.draw();
  });
}

function bindSwitches(): void {
  bindSwitch("follow", [], (on) => { plan.follows = on; });
  bindSwitch("sonars", ["SONAR_RANGES", "OBSTACLE_LINE"], (on) => { plan.showsSonars = on; });
  bindSwitch("view", ["LANDMARK_VIEW"], () => undefined);
  bindOpen("head-parts", ["HEAD_STATE"]);
  bindSwitch("video", ["VIDEO"], (on) => video.show(on));
  plan.port.onUserMove = () => {
    plan.follows = false;
    byId<HTMLInputElement>("follow").checked = false;
  };
}

function drawFrame(): void {
  plan.remember();
  if (views.isShown("plan")) plan.draw();
  views.draw();
  hand.draw();
  const distance_m = plan.measured();
  setText(byId("measured"), distance_m === undefined ? "" : `${number(distance_m, 2)} m`);
  window.requestAnimationFrame(drawFrame);
}

label();
bindButtons();
bindSwitches();
bindCheckBoxes();
panels.held_ms = () => hand.held_ms();
window.setInterval(() => {
  panels.draw();
  missions.draw();
  alarms.draw();
  headAim.draw();
  processes.draw();
  world.draw();
  replay.draw();
  video.draw(panels.station?.no_video ?? "");
  drawHeadView(byId<HTMLCanvasElement>("edges"), store);
}, PANEL_PERIOD_MS);
drawFrame();
