// The line above everything: which robot, whether it is there, panels to add, layouts, and the token where one is asked for.
import { offeredBy, type Offered } from "../panels/kinds";
import type { Welcome } from "../protocol";
import { read, type Arrangement, type Layout } from "../store/layout";
import { robotColor, robotMark } from "../panels/series";
import type { Robot } from "../store/robot";
import type { Robots } from "../store/robots";
import { isSameRun } from "../store/run";
import { button, complain, download, make, select } from "./dom";
import { renew } from "./renew";

export function header(robots: Robots, arrangement: Arrangement): HTMLElement {
  const robot = robots.own;
  const name = make("h1", {}, "hulkgen");
  const state = make("output", { class: "state", "aria-live": "polite", "data-state": "connecting" });
  const paths = button("Paths", "show or hide the paths of the robot", () => {
    document.body.classList.toggle(matchMedia("(max-width: 720px)").matches ? "with-paths" : "without-paths");
  });
  const showState = (): void => {
    const welcome = robot.welcome.value;
    const isOpen = robot.state.value === "open";
    state.dataset["state"] = isOpen ? "open" : "lost";
    const target = welcome === null ? "" : ` · ${welcome.target}`;
    state.textContent = isOpen ? `connected${target}` : welcome === null ? "looking for the robot …" : "connection lost, trying again …";
    if (welcome !== null) {
      name.textContent = welcome.robot;
      document.title = isOpen ? welcome.robot : `${welcome.robot} (lost)`;
    }
  };
  robot.state.watch(showState);
  robot.welcome.watch(showState);
  return make("header", {}, paths, name, state, token(robot), beside(robots), make("span", { class: "space" }), look("theme", ["system colours", "light", "dark"], "light or dark"), look("size", ["normal text", "large text"], "size of the text: large is read from two metres"), panels(robot, arrangement), layouts(robot, arrangement));
}

/** Robots that the page shows beside its own: whether they are there, and their tokens. They are called when somebody looks. */
function beside(robots: Robots): HTMLElement {
  const rows = make("div", { class: "robots" });
  const element = menu("Robots", [rows]);
  let list = "";
  let stops: (() => void)[] = [];
  const show = (): void => {
    const all = robots.known.value;
    element.hidden = all.length < 2;
    const addresses = all.map(({ address }) => address).join();
    if (!element.open || list === addresses) return;
    list = addresses;
    stops.forEach((stop) => stop());
    stops = [];
    rows.replaceChildren(
      ...all.map(({ address, at, isOwn, robot }) => {
        const mark = make("span", { class: "robot-mark" }, robotMark(at));
        mark.style.setProperty("--robot", robotColor(at));
        const state = make("output", { class: "state of-one" });
        const showState = robot.state.watch((now) => {
          state.dataset["state"] = now === "open" ? "open" : "lost";
          state.textContent = now === "open" ? "connected" : "not there, trying again …";
        });
        stops.push(showState);
        const row = make("div", { class: "robot-row" }, mark, make("span", {}, isOwn ? `${address} (this page's)` : address), state);
        // That of the page's own robot stands in the line above everything.
        if (!isOwn) row.append(token(robot));
        return row;
      }),
    );
  };
  robots.known.watch(() => {
    // The same addresses may be of other connections when it is opened next.
    if (!element.open) list = "";
    show();
  });
  element.addEventListener("toggle", show);
  // It is read and typed into, not chosen from.
  rows.addEventListener("click", (event) => event.stopPropagation());
  return element;
}

function panels(robot: Robot, arrangement: Arrangement): HTMLElement {
  const items = make("div", { class: "offers" });
  whenKnown(robot, ({ kinds }) => {
    renew(items, kinds.map((kind) => keyed(kind.kind, button(kind.name, `add a panel: ${kind.name}`, () => arrangement.add(kind.kind), "item"))));
  });
  return menu("Add", [items]);
}

function layouts(robot: Robot, arrangement: Arrangement): HTMLElement {
  const file = make("input", { type: "file", accept: ".json,application/json", hidden: true, "aria-label": "layout file" });
  file.addEventListener("change", () => {
    void file.files?.[0]?.text().then((text) => {
      const layout = read(text);
      if (layout === null) alert("this file is no layout of this page");
      else arrangement.replace(layout);
      file.value = "";
    });
  });
  const presets = make("div", { class: "offers" });
  let layouts = new Map<string, () => Layout>();
  const begin = (name: string): void => {
    const layout = layouts.get(name);
    if (layout !== undefined) arrangement.replace(layout());
  };
  whenKnown(robot, (offered) => {
    layouts = new Map(offered.presets.map(({ name, layout }) => [name, layout]));
    renew(presets, [...layouts.keys()].map((name) => keyed(name, button(name, `begin with ${name}`, () => begin(name), "item"))));
  });
  const back = button("Back", "the layout that was there before this one", () => arrangement.back(), "item");
  arrangement.before.watch((before) => (back.hidden = before === null));
  return menu("Layout", [
    presets,
    make("hr"),
    back,
    button("Save as file", "for others, or for another browser", () => download("layout.json", arrangement.text()), "item"),
    button("Open file …", "a layout that was saved", () => file.click(), "item"),
    file,
  ]);
}

/** Now and whenever another program is there. Where it does not say what it has, what was offered stays, and it is asked again with the next connection. */
function whenKnown(robot: Robot, deed: (offered: Offered) => void): void {
  /** Whose offers there are; null: nobody's. */
  let run: Welcome | null = null;
  let isOffered = false;
  const offer = async (welcome: Welcome): Promise<void> => {
    if (isSameRun(run, welcome) === true) return;
    const entries = await robot.paths.everything().catch(() => null);
    if (entries !== null || !isOffered) deed(offeredBy(entries ?? []));
    isOffered = true;
    run = entries === null ? null : welcome;
  };
  robot.welcome.watch((welcome) => {
    if (welcome !== null) void offer(welcome);
  });
}

/** By which it is found when the list is made anew. */
function keyed(key: string, element: HTMLElement): HTMLElement {
  element.setAttribute("data-key", key);
  return element;
}

/** How the page looks, as the browser keeps it: the first choice is what the page does by itself. */
function look(name: "theme" | "size", choices: readonly string[], about: string): HTMLElement {
  const root = document.documentElement;
  const show = (choice: string): void => {
    if (choice === choices[0]) delete root.dataset[name];
    else root.dataset[name] = choice.split(" ")[0];
    window.dispatchEvent(new Event("look"));
  };
  const kept = localStorage.getItem(name) ?? choices[0] ?? "";
  show(kept);
  return select(choices, kept, about, (choice) => {
    localStorage.setItem(name, choice);
    show(choice);
  });
}

function menu(name: string, items: readonly HTMLElement[]): HTMLDetailsElement {
  const list = make("div", { class: "items" }, ...items);
  const element = make("details", { class: "menu" }, make("summary", {}, name), list);
  list.addEventListener("click", () => (element.open = false));
  element.addEventListener("keydown", (event) => {
    if (event.key === "Escape") element.open = false;
  });
  document.addEventListener("pointerdown", (event) => {
    if (!element.contains(event.target as Node)) element.open = false;
  });
  return element;
}

/** Asks for the token where the robot wants one before it lets anybody write. */
function token(robot: Robot): HTMLElement {
  const input = make("input", { type: "password", placeholder: "token", "aria-label": "token", autocomplete: "off" });
  const failure = make("span", { class: "failure", hidden: true });
  const form = make("form", { class: "token", hidden: true }, input, make("button", { type: "submit" }, "Unlock"), failure);
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    robot.authenticate(input.value).then(
      () => complain(failure, null),
      (error: unknown) => complain(failure, error),
    );
    input.value = "";
  });
  const readOnly = make("span", { class: "muted", hidden: true }, "read only");
  const show = (): void => {
    const welcome = robot.welcome.value;
    form.hidden = robot.canWrite.value || welcome === null || !welcome.needs_token;
    readOnly.hidden = robot.canWrite.value || welcome === null || welcome.needs_token;
  };
  robot.canWrite.watch(show);
  robot.welcome.watch(show);
  return make("span", { class: "access" }, form, readOnly);
}
