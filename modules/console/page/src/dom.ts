// Small words for the document.

export function byId<T extends HTMLElement>(id: string): T {
  const element = document.getElementById(id);
  if (element === null) throw new Error(`no element ${id}`);
  return element as T;
}

/** Sets a text only when it changes, so that a screen reader is not told the same again. */
export function setText(element: HTMLElement, value: string): void {
  if (element.textContent !== value) element.textContent = value;
}

export interface Row {
  cells: string[];
  stale?: boolean;
  kind?: "good" | "warn" | "bad";  // of the last cell
}

/** Fills a table; the first cell of a row is its heading. */
export function fillTable(table: HTMLElement, rows: Row[], head: string[] = []): void {
  const lines = rows.map((row) => {
    const tr = document.createElement("tr");
    if (row.stale === true) tr.className = "stale";
    row.cells.forEach((cell, i) => {
      const td = document.createElement(i === 0 ? "th" : "td");
      td.textContent = cell;
      if (i > 1) td.className = "number";
      if (i === row.cells.length - 1 && row.kind !== undefined) td.className = row.kind;
      tr.append(td);
    });
    return tr;
  });
  if (head.length > 0) {
    const tr = document.createElement("tr");
    for (const word of head) {
      const th = document.createElement("th");
      th.textContent = word;
      tr.append(th);
    }
    lines.unshift(tr);
  }
  table.replaceChildren(...lines);
}

export interface ListLine {
  key: string;  // of the line: as long as it stays, so does its button, and the focus on it
  words: string;
  kind?: "soft" | "warn" | "bad";
  button?: { words: string; act: () => void } | undefined;
}

/** Fills a list, and leaves alone what has not changed. */
export function fillList(list: HTMLElement, lines: ListLine[]): void {
  const known = new Map([...list.children].map((li) => [(li as HTMLElement).dataset.key, li as HTMLLIElement]));
  const shown = lines.map((line) => {
    const li = known.get(line.key) ?? newLine(line);
    const span = li.firstElementChild;
    if (span !== null) setText(span as HTMLElement, line.words);
    return li;
  });
  const same = shown.length === list.children.length && shown.every((li, i) => li === list.children[i]);
  if (!same) list.replaceChildren(...shown);
}

function newLine(line: ListLine): HTMLLIElement {
  const li = document.createElement("li");
  li.dataset.key = line.key;
  if (line.kind !== undefined) li.className = line.kind;
  li.append(document.createElement("span"));
  if (line.button !== undefined) {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = line.button.words;
    button.addEventListener("click", line.button.act);
    li.append(" ", button);
  }
  return li;
}

/** A colour of style.css. */
export function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

/** Makes the canvas as many pixels as the screen has there; its context, with one unit per CSS pixel. */
export function prepare(canvas: HTMLCanvasElement): CanvasRenderingContext2D {
  const scale = window.devicePixelRatio;
  const width = Math.max(1, Math.round(canvas.clientWidth * scale));
  const height = Math.max(1, Math.round(canvas.clientHeight * scale));
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  const context = canvas.getContext("2d");
  if (context === null) throw new Error("no canvas");
  context.setTransform(scale, 0, 0, scale, 0, 0);
  context.clearRect(0, 0, canvas.clientWidth, canvas.clientHeight);
  return context;
}
