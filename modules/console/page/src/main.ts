// Puts the page together.

import { Connection } from "./connection";
import { byId, setText } from "./dom";
import { Hand } from "./drive";
import { drawHeadView } from "./head_view";
import { Panels } from "./panels";
import { PlanView } from "./plan_view";
import { Processes } from "./processes";
import { Hello, News } from "./protocol";
import { Replay } from "./replay";
import { Store } from "./store";
import { Place, Target } from "./target";
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
const video = new Video();
const wants = new Wants((channel, on) => connection.listen(channel, on));
const services: PageServices = {
  store, text, number,
  hello: () => panels.hello,
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
    showDoors(hello);
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

function showDoors(hello: Hello): void {
  byId<HTMLSelectElement>("door").replaceChildren(...hello.plan.doors.map((door) => {
    const option = document.createElement("option");
    option.value = String(door.id);
    option.textContent = door.name;
    return option;
  }));
}

function bindSwitch(id: string, channels: string[], set: (on: boolean) => void): void {
  const box = byId<HTMLInputElement>(id);
  box.addEventListener("change", () => {
    set(box.checked);
    wants.set(id, channels, box.checked);
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
  byId("position").setAttribute("aria-label", text("position"));
  byId("pick").title = text("pickHelp");
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
  byId("pass").addEventListener("click", () => connection.passDoor(Number(byId<HTMLSelectElement>("door").value)));
  byId("abort").addEventListener("click", () => connection.abort());
  plan.port.onPicked = enableTarget;
  byId("orders").addEventListener("input", enableTarget);
  bindTarget("goto", (place) => connection.goTo(place));
  bindTarget("place", (place) => connection.place(place));
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

function bindTarget(id: string, order: (place: Place) => void): void {
  byId(id).addEventListener("click", () => {
    const place = target.place();
    if (place !== undefined) order(place);
  });
}

/** To say where the robot stands, its heading has to be said, too. */
function enableTarget(): void {
  const place = target.place(), may = panels.mayOrder();
  byId<HTMLButtonElement>("goto").disabled = !may || place === undefined;
  byId<HTMLButtonElement>("place").disabled = !may || place?.yaw === undefined;
}

function bindSwitches(): void {
  bindSwitch("follow", [], (on) => { plan.follows = on; });
  bindSwitch("sonars", ["SONAR_RANGES", "OBSTACLE_LINE"], (on) => { plan.showsSonars = on; });
  bindSwitch("view", ["LANDMARK_VIEW"], () => undefined);
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
window.setInterval(() => {
  panels.draw();
  processes.draw();
  world.draw();
  enableTarget();
  replay.draw();
  video.draw(panels.station?.no_video ?? "");
  drawHeadView(byId<HTMLCanvasElement>("edges"), store);
}, PANEL_PERIOD_MS);
drawFrame();
