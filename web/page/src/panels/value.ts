// A panel with any value of the robot, as a tree or as text.
import { watchInjected } from "../store/injected";
import type { Sample } from "../store/subscriptions";
import { button, complain, eachFrame, make, select } from "../view/dom";
import { json, seconds } from "../view/format";
import { injection } from "./injection";
import { numberSetting, textSetting, type Context, type Panel, type PanelKind } from "./panel";
import { Branch } from "./tree";

const RATES = ["1 Hz", "5 Hz", "10 Hz", "30 Hz"];

function open(context: Context): Panel {
  let path = textSetting(context.settings, "path");
  let rate = numberSetting(context.settings, "rate", 10);
  let isText = context.settings["text"] === true;
  let stop = (): void => undefined;
  let stopMark = (): void => undefined;
  let sample: Sample | null = null;
  let branch = new Branch("", "", true);
  const input = make("input", { type: "text", value: path, placeholder: "a path, e.g. from the list of paths", "aria-label": "path", spellcheck: "false" });
  const state = make("output", { class: "muted" });
  const mark = make("span", { class: "injected-mark", hidden: true, title: "a client has put this value in place of what the node wrote" }, "injected");
  const failure = make("p", { class: "failure", hidden: true });
  const tree = make("ul", { class: "tree" });
  const text = make("pre", { class: "value-text" });
  const injecting = injection(context.robot, () => ({ path, value: sample?.value ?? null }));
  const content = make("div", { class: "scroll" }, make("div", { class: "bar" }, input, state, mark), failure, injecting.element, tree, text);

  const draw = eachFrame(() => {
    tree.hidden = isText;
    text.hidden = !isText;
    if (sample === null) return;
    state.textContent = `cycle ${sample.cycle}, ${seconds(sample.time)}`;
    if (isText) text.textContent = json(sample.value);
    else branch.show(sample.value);
  });

  const subscribe = (): void => {
    stop();
    stop = (): void => undefined;
    context.save({ path, rate, text: isText });
    complain(failure, null);
    if (path === "") return;
    stop = context.robot.subscriptions.watch(
      // As bytes, since an image as JSON would take seconds; the robot tells parameters as JSON alone.
      { path, rate, encoding: /^parameters(\.|$)/.test(path) ? "json" : "binary" },
      {
        sample: (next) => {
          sample = next;
          draw();
        },
        refused: (reason) => complain(failure, reason),
      },
    );
  };

  const show = (): void => {
    stopMark();
    mark.hidden = true;
    sample = null;
    state.textContent = "";
    text.textContent = "";
    context.title(path);
    injecting.moved();
    branch = new Branch(path.slice(path.lastIndexOf(".") + 1), path, true);
    tree.replaceChildren(branch.element);
    stopMark = (): void => undefined;
    if (path !== "") {
      const shown = path;
      stopMark = watchInjected(context.robot, shown, (isInjected) => {
        mark.hidden = !isInjected;
        injecting.mark(shown, isInjected);
      });
    }
    subscribe();
    draw();
  };
  input.addEventListener("change", () => accept(input.value.trim()));
  const accept = (next: string): void => {
    const isOther = next !== path;
    path = next;
    input.value = next;
    if (isOther) show();
    else subscribe();
  };
  const tools = [
    select(RATES, `${rate} Hz`, "updates per second", (choice) => {
      rate = Number.parseFloat(choice);
      // The same value, more often or less: what is open in it stays open.
      subscribe();
    }),
    button("Text", "tree or text", () => {
      isText = !isText;
      context.save({ path, rate, text: isText });
      draw();
    }),
  ];
  show();
  const close = (): void => {
    stop();
    stopMark();
    injecting.close();
  };
  return { content, tools, accept, close };
}

export const value: PanelKind = { kind: "value", name: "Value", open };
