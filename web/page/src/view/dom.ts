// Owns how elements are made.

type Child = Node | string | null;
type Attributes = Record<string, string | number | boolean | null | ((event: never) => void)>;

/** An element; attributes that are functions are listeners, `null` and `false` are left out. */
export function make<N extends keyof HTMLElementTagNameMap>(
  name: N,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[N] {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(key, value as EventListener);
    else if (value === true) element.setAttribute(key, "");
    else if (value !== null && value !== false) element.setAttribute(key, String(value));
  }
  element.append(...children.filter((child): child is Node | string => child !== null));
  return element;
}

export function button(text: string, title: string, deed: () => void, name = ""): HTMLButtonElement {
  return make("button", { type: "button", title, class: name, "aria-label": title, click: deed }, text);
}

/** A list to choose from; `deed` gets what was chosen. */
export function select(choices: readonly string[], chosen: string, title: string, deed: (choice: string) => void): HTMLSelectElement {
  const element = make("select", { title, "aria-label": title, change: () => deed(element.value) });
  element.append(...choices.map((choice) => make("option", { value: choice, selected: choice === chosen }, choice)));
  return element;
}

/** A name that may be broken behind underscores and colons. */
export function wrapping(name: string): (string | HTMLElement)[] {
  return name.split(/(?<=_|::)/).flatMap((part, at) => (at === 0 ? [part] : [make("wbr"), part]));
}

/** A line where something failed; empty: nothing did. */
export function complain(element: HTMLElement, reason: unknown): void {
  const text = reason === null ? "" : reason instanceof Error ? reason.message : String(reason);
  if (element.textContent !== text) element.textContent = text;
  element.hidden = text === "";
}

/** Calls at most once per drawn frame, and not while nobody sees the page. */
export function eachFrame(deed: () => void): () => void {
  let isAsked = false;
  return () => {
    if (isAsked) return;
    isAsked = true;
    requestAnimationFrame(() => {
      isAsked = false;
      deed();
    });
  };
}

/** Calls unless what was called last still goes on: questions would only wait behind each other. */
export function alone(deed: () => Promise<void>): () => void {
  let isGoingOn = false;
  return () => {
    if (isGoingOn) return;
    isGoingOn = true;
    void deed().finally(() => (isGoingOn = false));
  };
}

/** A canvas as sharp as the screen, in units of the page; null while it has no place. */
export function sharp(canvas: HTMLCanvasElement): CanvasRenderingContext2D | null {
  const ratio = window.devicePixelRatio;
  const [width, height] = [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
  if (width === 0 || height === 0) return null;
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  const context = canvas.getContext("2d");
  context?.setTransform(ratio, 0, 0, ratio, 0, 0);
  return context;
}

/** Some browsers read a file only after somebody has said where to put it. */
const READ_MILLISECONDS = 40_000;

/** Hands a text to the user as a file. */
export function download(name: string, text: string, type = "application/json"): void {
  const address = URL.createObjectURL(new Blob([text], { type }));
  make("a", { href: address, download: name }).click();
  window.setTimeout(() => URL.revokeObjectURL(address), READ_MILLISECONDS);
}
