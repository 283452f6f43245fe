// As much of a browser as panels need to be made and looked at without one. Loaded before what is tested.

class Node_ {
  parentElement = null;

  replaceWith(other) {
    this.parentElement.insertBefore(other, this);
    this.remove();
  }

  remove() {
    if (this.parentElement === null) return;
    const { childNodes } = this.parentElement;
    childNodes.splice(childNodes.indexOf(this), 1);
    this.parentElement = null;
  }
}

Node_.ELEMENT_NODE = 1;

class Text_ extends Node_ {
  nodeType = 3;
  nodeName = "#text";

  constructor(text) {
    super();
    this.nodeValue = String(text);
  }

  get textContent() {
    return this.nodeValue;
  }
}

class Element_ extends Node_ {
  nodeType = 1;
  childNodes = [];
  listeners = new Map();
  attributesByName = new Map();
  style = { setProperty: () => undefined };
  dataset = {};
  [Symbol.toStringTag] = "Element";

  constructor(name) {
    super();
    this.nodeName = name.toUpperCase();
    this.hidden = false;
    this.value = "";
    this.scrollTop = this.scrollHeight = this.clientHeight = this.clientWidth = 0;
    const names = () => (this.getAttribute("class") ?? "").split(" ").filter((one) => one !== "");
    this.classList = {
      contains: (one) => names().includes(one),
      add: (one) => this.setAttribute("class", [...new Set([...names(), one])].join(" ")),
      remove: (one) => this.setAttribute("class", names().filter((other) => other !== one).join(" ")),
      toggle: (one, isThere = !names().includes(one)) => this.classList[isThere ? "add" : "remove"](one),
    };
  }

  get children() {
    return this.childNodes.filter((one) => one.nodeType === 1);
  }

  get attributes() {
    return [...this.attributesByName].map(([name, value]) => ({ name, value }));
  }

  get textContent() {
    return this.childNodes.map((one) => one.textContent).join("");
  }

  set textContent(text) {
    this.replaceChildren(...(text === "" ? [] : [String(text)]));
  }

  /** Of a list to choose from: as a browser does, the first choice where none is chosen. */
  get options() {
    return this.children.filter((one) => one.nodeName === "OPTION");
  }

  getAttribute(name) {
    return this.attributesByName.get(name) ?? null;
  }

  setAttribute(name, value) {
    this.attributesByName.set(name, String(value));
    if (name === "hidden") this.hidden = true;
    if (name === "value") this.value = String(value);
  }

  removeAttribute(name) {
    this.attributesByName.delete(name);
  }

  append(...children) {
    for (const child of children) this.insertBefore(child, null);
  }

  insertBefore(child, before) {
    const node = child instanceof Node_ ? child : new Text_(child);
    node.remove();
    const at = before === null || before === undefined ? this.childNodes.length : this.childNodes.indexOf(before);
    this.childNodes.splice(at, 0, node);
    node.parentElement = this;
    if (this.nodeName === "SELECT" && (this.options.length === 1 || node.getAttribute?.("selected") !== null)) this.value = node.getAttribute("value") ?? node.textContent;
  }

  replaceChildren(...children) {
    for (const child of [...this.childNodes]) child.remove();
    this.append(...children);
  }

  addEventListener(name, listener) {
    this.listeners.set(name, [...(this.listeners.get(name) ?? []), listener]);
  }

  removeEventListener(name, listener) {
    this.listeners.set(name, (this.listeners.get(name) ?? []).filter((one) => one !== listener));
  }

  /** What a person does. */
  tell(name, event = {}) {
    for (const listener of this.listeners.get(name) ?? []) listener({ target: this, preventDefault: () => undefined, ...event });
  }

  click() {
    this.tell("click");
  }

  setPointerCapture() {}

  getContext() {
    return null;
  }

  /** Nothing has been laid out. */
  querySelector() {
    return null;
  }

  querySelectorAll() {
    return [];
  }

  contains(other) {
    return other === this || this.children.some((one) => one.contains(other));
  }
}

/** The elements below one for which this holds. */
export function all(element, holds) {
  return element.children.flatMap((one) => [...(holds(one) ? [one] : []), ...all(one, holds)]);
}

export const labelled = (element, label) => all(element, (one) => (one.getAttribute("aria-label") ?? "").startsWith(label))[0];
export const ofClass = (element, name) => all(element, (one) => one.classList.contains(name));

const periods = new Map();
let nextTimer = 1;

/** Every timer's next turn comes. */
export function tick() {
  for (const deed of [...periods.values()]) deed();
}

export const settled = () => new Promise((resolve) => setTimeout(resolve, 5));

Object.assign(globalThis, { Node: Node_, Text: Text_, HTMLElement: Element_ });
for (const name of ["Input", "Select", "Button", "TextArea"]) globalThis[`HTML${name}Element`] = class extends Element_ {};
globalThis.document = { createElement: (name) => new Element_(name), createTextNode: (text) => new Text_(text), hidden: false, activeElement: null, body: new Element_("body"), documentElement: new Element_("html"), addEventListener: () => undefined, removeEventListener: () => undefined };
globalThis.getComputedStyle = () => ({ getPropertyValue: () => "" });
globalThis.requestAnimationFrame = (deed) => setTimeout(deed);
globalThis.window = {
  devicePixelRatio: 1,
  setInterval: (deed) => (periods.set(nextTimer, deed), nextTimer++),
  clearInterval: (timer) => periods.delete(timer),
  setTimeout: (deed) => (periods.set(nextTimer, () => deed()), nextTimer++),
  addEventListener: () => undefined,
  removeEventListener: () => undefined,
};

/** A signal as panels watch it. */
export function signal(value) {
  const listeners = new Set();
  const made = {
    get value() {
      return value;
    },
    set: (next) => {
      value = next;
      for (const listener of [...listeners]) listener(next);
    },
    watch: (listener) => (listeners.add(listener), listener(value), () => listeners.delete(listener)),
    changed: (listener) => (listeners.add(listener), () => listeners.delete(listener)),
  };
  return made;
}

/** What a panel is opened with; `answer` is what the robot says to what it is asked, or a promise of it. */
export function opened(answer, more = {}) {
  const asked = [];
  const robot = {
    state: signal("open"),
    welcome: signal({ time: 0 }),
    moment: signal(null),
    canWrite: signal(true),
    ask: async (ask) => (asked.push(ask), answer(ask)),
    ...more,
  };
  const known = { at: 0, address: "robot:1", isOwn: true, robot };
  const context = { robot, known, robots: [known], settings: {}, arrangement: {}, save: () => undefined, title: () => undefined };
  return { context, robot, asked };
}
