// All words of the page, in English and German.

export type Language = "en" | "de";

const WORDS = {
  stop: ["STOP", "HALT"],
  stopKey: ["space bar", "Leertaste"],
  stopped: ["Emergency stop: the robot stands until it is re-armed.", "Not-Halt: der Roboter steht, bis er freigegeben wird."],
  rearm: ["Hold to re-arm", "Halten zum Freigeben"],
  plan: ["Ground plan", "Grundriss"],
  space: ["3-D", "3-D"],
  plots: ["Plots", "Verläufe"],
  values: ["Parameters", "Parameter"],
  holdChart: ["Hold", "Festhalten"],
  goOn: ["Go on", "Weiter"],
  moreCharts: ["Another chart", "Weiteres Diagramm"],
  clearCharts: ["Clear", "Leeren"],
  timeSpan: ["time span", "Zeitspanne"],
  filter: ["Filter: channel, field", "Filter: Kanal, Feld"],
  spaceHelp: [
    "3-D view of plan, robot, path, what the head looks at and the edges it found. Drag to turn, shift and drag to move, wheel to zoom.",
    "3-D-Ansicht von Plan, Roboter, Pfad, Blick des Kopfes und gefundenen Kanten. Ziehen dreht, Umschalt und Ziehen verschiebt, Mausrad zoomt."],
  noSpace: ["This browser has no WebGL.", "Dieser Browser hat kein WebGL."],
  turnLeft: ["turn left", "links drehen"],
  turnRight: ["turn right", "rechts drehen"],
  higher: ["look from higher", "von weiter oben"],
  lower: ["look from lower", "von weiter unten"],
  nearer: ["nearer", "näher"],
  farther: ["farther", "weiter weg"],
  filterValues: ["Filter: name, meaning", "Filter: Name, Bedeutung"],
  noValues: ["No process has told its parameters.", "Kein Prozess hat seine Parameter genannt."],
  valuesNote: [
    "All, as the files of this deployment on the workstation have them. Changed there, they hold after a restart.",
    "Alle, wie sie in den Dateien dieser Anlage am Arbeitsplatz stehen. Dort geändert gelten sie nach einem Neustart."],
  liveParameter: ["to be changed now", "jetzt zu ändern"],
  inForce: ["in force", "gilt"],
  newValue: ["new value", "neuer Wert"],
  state: ["state", "Stand"],
  set: ["Set", "Setzen"],
  saveValues: ["Save for the next start", "Für den nächsten Start sichern"],
  resetValues: ["All as in the file", "Alle wie in der Datei"],
  unsaved: ["not saved: the next start takes other values", "nicht gesichert: der nächste Start nimmt andere Werte"],
  allSaved: ["the next start takes the same values", "der nächste Start nimmt dieselben Werte"],
  ofFile: ["file", "Datei"],
  atMostFile: ["at most the file's", "höchstens der der Datei"],
  atLeastFile: ["at least the file's", "mindestens der der Datei"],
  underWay: ["under way ...", "unterwegs ..."],
  noAnswer: ["no answer", "keine Antwort"],
  parameter: ["parameter", "Parameter"],
  value: ["value", "Wert"],
  allowed: ["allowed", "erlaubt"],
  meaning: ["meaning", "Bedeutung"],
  takeAway: ["take away", "entfernen:"],
  chartHint: ["Choose numbers in the list.", "Werte in der Liste wählen."],
  chartHelp: [
    "Chart over time. Choose numbers in the list beside it, or drag them here.",
    "Diagramm über der Zeit. Werte in der Liste daneben wählen oder hierher ziehen."],
  planHelp: [
    "Ground plan with the robot. Drag to move, wheel or + and - to zoom, shift and drag to measure.",
    "Grundriss mit Roboter. Ziehen verschiebt, Mausrad oder + und - vergrößert, Umschalt und Ziehen misst."],
  follow: ["follow the robot", "dem Roboter folgen"],
  sonars: ["sonars", "Ultraschall"],
  fit: ["Whole plan", "Ganzer Plan"],
  drive: ["Drive", "Fahren"],
  turn: ["Turn", "Drehen"],
  driveKeys: [
    "Hold W A S D or the arrows to drive, Q E to turn; or drag the stick. Let go: it stands.",
    "W A S D oder Pfeile halten zum Fahren, Q E zum Drehen; oder den Knüppel ziehen. Loslassen: er steht."],
  stickHelp: ["Stick: drag to drive", "Knüppel: ziehen zum Fahren"],
  moveBase: ["moves: base", "bewegt: Fahrwerk"],
  moveHead: ["moves: head", "bewegt: Kopf"],
  slow: ["range: slow", "Bereich: langsam"],
  fast: ["range: fast", "Bereich: schnell"],
  takeOver: ["Take over", "Übernehmen"],
  mission: ["Mission", "Auftrag"],
  door: ["Door", "Tür"],
  pass: ["Pass the door", "Tür durchfahren"],
  abort: ["Abort", "Abbrechen"],
  keysInField: ["keys go to the field that you type in", "Tasten gehen in das Feld, in dem Sie tippen"],
  wholeNumber: ["a whole number", "eine ganze Zahl"],
  aNumber: ["a number", "eine Zahl"],
  moreMissions: ["Other missions", "Andere Aufträge"],
  corridor: ["Follow the corridor", "Dem Flur folgen"],
  corridorFor: ["m; 0: to its end", "m; 0: bis zum Ende"],
  explore: ["Explore the floor", "Stockwerk erkunden"],
  locate: ["Find out where it is", "Ort herausfinden"],
  addPlace: ["Add the place", "Ort hinzufügen"],
  noPlaces: ["no places yet", "noch keine Orte"],
  rounds: ["rounds (0: until cancelled)", "Runden (0: bis zum Abbruch)"],
  patrol: ["Patrol", "Streife fahren"],
  clearPlaces: ["Clear", "Leeren"],
  pauseMission: ["Pause", "Anhalten"],
  resumeMission: ["Resume", "Fortsetzen"],
  paused: ["paused", "angehalten"],
  missionStep: ["step", "Schritt"],
  round: ["round", "Runde"],
  timeLeft: ["about", "noch etwa"],
  timeLeftUnknown: ["time left not known", "Restzeit unbekannt"],
  waits: ["waits:", "wartet:"],
  cancel: ["Cancel", "Streichen"],
  acknowledge: ["Acknowledge", "Quittieren"],
  acknowledgedBy: ["acknowledged by", "quittiert von"],
  pick: ["Choose on the plan", "Im Plan wählen"],
  pickHelp: [
    "Press on the plan where the robot is to be, and drag to where it is to look. A click chooses the place alone.",
    "Im Plan drücken, wo der Roboter stehen soll, und dorthin ziehen, wohin er blicken soll. Ein Klick wählt nur den Ort."],
  heading: ["heading", "Richtung"],
  goTo: ["Drive there", "Dorthin fahren"],
  place: ["It stands there", "Er steht dort"],
  placed: ["The robot knows its new pose.", "Der Roboter kennt seine neue Pose."],
  notPlaced: ["The pose is not set: the robot was moving.", "Pose nicht gesetzt: der Roboter fuhr gerade."],
  robot: ["Robot", "Roboter"],
  link: ["Radio link", "Funkstrecke"],
  channels: ["Channels", "Kanäle"],
  head: ["What the head sees", "Was der Kopf sieht"],
  showVideo: ["show the third camera (video link, not the radio)", "dritte Kamera zeigen (Videostrecke, nicht Funk)"],
  pictureHelp: ["Picture of the third camera, live", "Bild der dritten Kamera, live"],
  pictureAge: ["picture", "Bild"],
  noPicture: ["No picture yet.", "Noch kein Bild."],
  pointHead: ["Point the head", "Kopf richten"],
  pan: ["pan", "Schwenk"],
  tilt: ["tilt", "Neigung"],
  zoom: ["zoom", "Zoom"],
  focus: ["focus", "Fokus"],
  lookAhead: ["Straight ahead", "Geradeaus"],
  lookThere: ["Look there", "Dorthin blicken"],
  lookThereHelp: ["Click a place on the plan: the head turns to it.", "Einen Ort im Plan anklicken: der Kopf wendet sich ihm zu."],
  showView: ["show edges (asks the radio for them)", "Kanten zeigen (fordert sie über Funk an)"],
  viewHelp: ["Edges of the last look: expected, used, rejected", "Kanten des letzten Blicks: erwartet, verwendet, verworfen"],
  alarms: ["Alarms", "Alarme"],
  noAlarms: ["none", "keine"],
  oneOpenAlarm: ["1 alarm", "1 Alarm"],
  openAlarms: ["alarms", "Alarme"],
  processes: ["Processes", "Prozesse"],
  restart: ["Restart", "Neu starten"],
  readyAgain: ["ready again", "wieder bereit"],
  restartNow: ["Really restart now", "Wirklich neu starten"],
  restartRobotNow: ["Really: it stops, forgets its pose, stays stopped", "Wirklich: er hält, vergisst seine Pose, bleibt im Not-Halt"],
  lastLines: ["Last lines", "Letzte Zeilen"],
  earlierLines: ["Earlier lines", "Frühere Zeilen"],
  startedAgain: ["started again", "neu gestartet"],
  lostSoFar: ["lost", "verloren"],
  failsAgain: ["fails again and again", "scheitert immer wieder"],
  messagesLost: ["messages lost", "Meldungen verloren"],
  refusedMessages: ["unreadable", "unlesbar"],
  exceptions: ["exceptions", "Ausnahmen"],
  lateTicks: ["late steps", "späte Schritte"],
  silent: ["silent", "stumm"],
  notSupervised: [
    "No supervisor takes orders about it: systemd or a person started it.",
    "Kein Überwacher nimmt Aufträge dafür an: systemd oder ein Mensch hat ihn gestartet."],
  simulation: ["Simulation", "Simulation"],
  scenario: ["scenario", "Szenario"],
  newWorld: ["Begin anew", "Neu beginnen"],
  newWorldNow: ["Really begin anew", "Wirklich neu beginnen"],
  worldArmed: [
    "Robot and world go back to the start; missions and what was learned are gone.",
    "Roboter und Welt gehen an den Anfang zurück; Aufträge und Gelerntes sind weg."],
  worldBegins: ["A new world begins; the station is back in a few seconds ...", "Eine neue Welt beginnt; die Station ist in wenigen Sekunden wieder da ..."],
  worldLate: ["The new world does not come; see the processes.", "Die neue Welt kommt nicht; siehe Prozesse."],
  scenario_door: ["two rooms and a 90 cm door", "zwei Räume und eine 90-cm-Tür"],
  scenario_detour: ["the same, with things in the way", "ebenso, mit Dingen im Weg"],
  scenario_corridor: ["a corridor of 22 m", "ein Flur von 22 m"],
  scenario_explore: ["a floor without a plan", "ein Stockwerk ohne Plan"],
  scenario_kidnapped: ["the robot was carried somewhere", "der Roboter wurde woandershin getragen"],
  scenario_teleop: ["a carton and a 1.2 m passage", "ein Karton und ein Durchgang von 1,2 m"],
  clock: ["clock", "Uhr"],
  clockUnknown: ["clock not compared with other hosts", "Uhr nicht mit anderen Rechnern verglichen"],
  connected: ["station connected", "Station verbunden"],
  lost: ["no connection to the station", "keine Verbindung zur Station"],
  viewer: ["you watch only", "nur Zuschauer"],
  linkUp: ["radio up", "Funk steht"],
  linkDown: ["radio down", "Funk unterbrochen"],
  linkMismatch: ["the two ends of the radio have different channel tables", "die Enden der Funkstrecke haben verschiedene Kanaltabellen"],
  down: ["to robot", "zum Roboter"],
  up: ["from robot", "vom Roboter"],
  roundTrip: ["round trip", "Umlaufzeit"],
  loss: ["frames lost", "Rahmen verloren"],
  rejected: ["frames refused", "Rahmen abgelehnt"],
  pages: ["pages open", "offene Seiten"],
  refusedPages: ["requests refused", "Anfragen abgelehnt"],
  pose: ["pose", "Pose"],
  sigma: ["uncertainty (1 σ)", "Unsicherheit (1 σ)"],
  speed: ["speed", "Tempo"],
  doing: ["does", "tut"],
  limit: ["held back by", "gebremst durch"],
  nearest: ["free ahead", "frei voraus"],
  driver: ["driver", "Fahrer"],
  refusal: ["last refusal", "zuletzt abgelehnt"],
  age: ["age", "Alter"],
  replay: ["A log is shown, no robot.", "Eine Aufzeichnung, kein Roboter."],
  play: ["Play", "Abspielen"],
  pause: ["Pause", "Anhalten"],
  step: ["Step", "Schritt"],
  back: ["− 5 s", "− 5 s"],
  ahead: ["+ 5 s", "+ 5 s"],
  position: ["Position in the log", "Stelle der Aufzeichnung"],
  speedOfLog: ["speed", "Tempo"],
  never: ["not heard yet", "noch nichts gehört"],
  message: ["messages", "Meldungen"],
  bytes: ["bytes", "Bytes"],
  dropped: ["dropped", "verworfen"],
  expired: ["expired", "abgelaufen"],
  waiting: ["waiting", "wartet"],
  yours: ["you", "Sie"],
  otherPage: ["another page drives", "eine andere Seite fährt"],
  looked: ["look at", "Blick auf"],
  edgesUsed: ["edges used", "Kanten verwendet"],
} as const;

const LISTS = {
  doing: [["idle", "follows a path", "arrived", "holds", "blocked", "driven by hand"],
    ["ruht", "folgt einem Pfad", "angekommen", "hält", "blockiert", "von Hand gefahren"]],
  limit: [["nothing", "sonars", "pose too old", "encoders silent", "sonars silent", "wheels stuck", "head silent",
    "radio link lost", "operator silent", "lease lost", "emergency stop", "touched something", "bumper silent"],
  ["nichts", "Ultraschall", "Pose zu alt", "Radgeber stumm", "Ultraschall stumm", "Räder blockiert", "Kopf stumm",
    "Funk unterbrochen", "Bediener stumm", "Fahrrecht verloren", "Not-Halt", "Berührung", "Stoßleiste stumm"]],
  refusal: [["nothing", "no lease", "out of order", "too old", "out of range", "let the stick go first"],
    ["nichts", "kein Fahrrecht", "falsche Reihenfolge", "zu alt", "außerhalb des Bereichs", "erst den Knüppel loslassen"]],
  driver: [["nobody", "planner", "console", "teleop"], ["niemand", "Planer", "Station", "Teleoperation"]],
  phase: [["waiting", "approaching", "looking left", "looking right", "passing", "done", "failed", "retreating", "driving"],
    ["wartet", "nähert sich", "blickt links", "blickt rechts", "durchfährt", "fertig", "gescheitert", "zieht sich zurück", "fährt"]],
  missionOutcome: [["done", "failed", "cancelled", "refused"], ["erledigt", "gescheitert", "gestrichen", "abgelehnt"]],
  health: [["starting", "good", "degraded", "failed"], ["startet", "gut", "eingeschränkt", "ausgefallen"]],
  verdict: [["found", "no model of it", "no pose", "no image", "not visible", "too few edges", "ambiguous",
    "residual too large", "elsewhere"],
  ["gefunden", "kein Modell", "keine Pose", "kein Bild", "nicht sichtbar", "zu wenige Kanten", "mehrdeutig",
    "Abweichung zu groß", "woanders"]],
  outcome: [["in force", "unknown key", "out of range", "less careful than the file", "contradicts another key",
    "the process has other parameters: another version", "came too late", "cannot be saved", "unknown order"],
  ["gilt", "unbekannter Schlüssel", "außerhalb des Bereichs", "weniger vorsichtig als die Datei",
    "widerspricht einem anderen Schlüssel", "der Prozess hat andere Parameter: andere Version", "kam zu spät",
    "kann nicht gesichert werden", "unbekannter Auftrag"]],
  processState: [["waits", "starting", "runs", "ended, starts again soon", "is ending", "ended"],
    ["wartet", "startet", "läuft", "beendet, startet bald wieder", "wird beendet", "beendet"]],
  processOutcome: [["done", "came too late", "just done: wait a few seconds", "no such scenario", "unknown order", "no console"],
    ["erledigt", "kam zu spät", "eben erst geschehen: einige Sekunden warten", "kein solches Szenario", "unbekannter Auftrag",
      "keine Ausgabe"]],
  severity: [["caution", "warning", "critical"], ["Vorsicht", "Warnung", "kritisch"]],
} as const;

const PHASES = {
  no_device: ["stick is free", "Knüppel ist frei"],
  idle: ["stick is free", "Knüppel ist frei"],
  must_let_go: ["let go of stick and keys first", "erst Knüppel und Tasten loslassen"],
  asking: ["asks for the robot ...", "fordert den Roboter an ..."],
  driving: ["you drive", "Sie fahren"],
} as const;

let language: Language = navigator.language.startsWith("de") ? "de" : "en";

function index(): 0 | 1 {
  return language === "en" ? 0 : 1;
}

export function currentLanguage(): Language {
  return language;
}

export function setLanguage(next: Language): void {
  language = next;
  document.documentElement.lang = next;
  for (const element of document.querySelectorAll<HTMLElement>("[data-text]"))
    element.textContent = text(element.dataset.text as keyof typeof WORDS);
}

export function text(word: keyof typeof WORDS): string {
  return WORDS[word][index()];
}

export function hasText(word: string): word is keyof typeof WORDS {
  return word in WORDS;
}

/** The word for a constant of a message; its number when nobody has named it yet. */
export function named(list: keyof typeof LISTS, code: number): string {
  return LISTS[list][index()][code] ?? String(code);
}

export function phaseText(phase: keyof typeof PHASES): string {
  return PHASES[phase][index()];
}

/** A number with the decimal sign of the language. */
export function number(value: number, digits: number): string {
  return value.toLocaleString(language, { minimumFractionDigits: digits, maximumFractionDigits: digits });
}

export function ageText(age_s: number): string {
  if (age_s === Infinity) return text("never");
  return age_s < 10 ? `${number(age_s, 1)} s` : age_s < 120 ? `${number(age_s, 0)} s` : `${number(age_s / 60, 0)} min`;
}
