// Which element of the page a key belongs to. The space bar is nobody's: it stops the robot.

/** A letter that is pressed there belongs to it, not to the stick: fields to type in, and lists. */
function takesLetters(element: Element | null): boolean {
  return element instanceof HTMLSelectElement ||
    (element instanceof HTMLInputElement && element.type !== "checkbox" && element.type !== "range");
}

function takesArrows(element: Element | null): boolean {
  return takesLetters(element) || (element instanceof HTMLInputElement && element.type === "range");
}

/** Whether a key that would drive is taken by the element that has the focus. */
export function isTakenByField(event: KeyboardEvent): boolean {
  const element = event.target instanceof Element ? event.target : null;
  return event.code.startsWith("Arrow") ? takesArrows(element) : takesLetters(element);
}

/** Whether the keys that drive go to a field now. */
export function doFieldsTakeKeys(): boolean {
  return takesLetters(document.activeElement);
}

/** Check boxes are ticked by Enter, since the space bar stops. */
export function bindCheckBoxes(): void {
  document.addEventListener("keydown", (event) => {
    const box = event.target;
    if (event.key !== "Enter" || event.repeat || !(box instanceof HTMLInputElement) || box.type !== "checkbox") return;
    event.preventDefault();
    box.click();
  });
}
