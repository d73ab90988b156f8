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
