// A value in place of an output, until it is released or this page goes away.
import type { Decoded } from "../connection/binary";
import { readJson } from "../connection/exact";
import { Injection } from "../store/injection";
import type { Robot } from "../store/robot";
import { button, complain, make } from "../view/dom";
import { json } from "../view/format";

/** `shown`: the path that the panel shows, and its newest value to begin with. */
export function injection(robot: Robot, shown: () => { path: string; value: Decoded }): { element: HTMLElement; close(): void; moved(): void; mark(path: string, isInjected: boolean): void } {
  const injection = new Injection(robot);
  const text = make("textarea", { rows: 4, spellcheck: "false", "aria-label": "value to inject" });
  const failure = make("p", { class: "failure", hidden: true });
  const state = make("span", { class: "muted" });
  const attempt = async (deed: () => Promise<void>): Promise<void> => {
    try {
      await deed();
      complain(failure, null);
    } catch (error) {
      complain(failure, error);
    }
  };
  const inject = async (): Promise<void> => injection.inject(shown().path, readJson(text.value));
  const bar = make(
    "div",
    { class: "bar" },
    button("Inject", "every reader gets this value in place of the node's", () => void attempt(inject), "deed"),
    button("Release", "give the output back to its node", () => void attempt(() => injection.release(shown().path))),
    button("Take current", "begin with the newest value", () => (text.value = json(shown().value))),
    state,
  );
  const element = make("details", { class: "injection" }, make("summary", {}, "Inject"), text, bar, failure);
  // Only whole main outputs can be replaced.
  const moved = (): void => void (element.hidden = !/^[^.]+\.main_outputs\.[^.]+$/.test(shown().path));
  const stops = [
    injection.path.watch((path) => {
      state.textContent = path === null ? "" : `${path} is injected`;
      element.classList.toggle("injected", path !== null);
    }),
    // The robot releases what a lost connection had injected.
    robot.state.watch((now) => {
      if (now !== "waiting" || injection.path.value === null) return;
      injection.forget();
      complain(failure, "the connection was lost: the robot ends the injection once it notices, within a minute");
    }),
  ];
  const close = (): void => {
    for (const stop of stops) stop();
    injection.close();
  };
  /** What the robot shows: somebody else may have released it. */
  const mark = (path: string, isInjected: boolean): void => {
    if (injection.mark(path, isInjected)) complain(failure, "somebody else has released it: nothing is injected any more");
  };
  return { element, close, moved, mark };
}
