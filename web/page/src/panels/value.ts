// A panel with any value of the robot, as a tree or as text.
import { watchInjected } from "../store/injected";
import type { Sample } from "../store/subscriptions";
import { button, complain, eachFrame, make, select } from "../view/dom";
import { json, seconds } from "../view/format";
import { injection } from "./injection";
import { numberSetting, textSetting, type Context, type Panel, type PanelKind } from "./panel";
import { Branch } from "./tree";

const RATES = ["1 Hz", "5 Hz", "10 Hz", "30 Hz"];

class ValuePanel implements Panel {
  readonly content: HTMLElement;
  readonly tools: HTMLElement[];
  private path: string;
  private rate: number;
  private isText: boolean;
  private sample: Sample | null = null;
  private branch = new Branch("", "", true);
  private readonly input: HTMLInputElement;
  private readonly state = make("output", { class: "muted" });
  private readonly mark = make("span", { class: "injected-mark", hidden: true, title: "a client has put this value in place of what the node wrote" }, "injected");
  private readonly failure = make("p", { class: "failure", hidden: true });
  private readonly tree = make("ul", { class: "tree" });
  private readonly text = make("pre", { class: "value-text" });
  private readonly injecting: ReturnType<typeof injection>;
  private readonly draw = eachFrame(() => this.paint());
  private stop = (): void => undefined;
  private stopMark = (): void => undefined;

  constructor(private readonly context: Context) {
    this.path = textSetting(context.settings, "path");
    this.rate = numberSetting(context.settings, "rate", 10);
    this.isText = context.settings["text"] === true;
    this.input = make("input", { type: "text", value: this.path, placeholder: "a path, e.g. from the list of paths", "aria-label": "path", spellcheck: "false" });
    this.input.addEventListener("change", () => this.accept(this.input.value.trim()));
    this.injecting = injection(context.robot, () => ({ path: this.path, value: this.sample?.value ?? null }));
    this.content = make("div", { class: "scroll" }, make("div", { class: "bar" }, this.input, this.state, this.mark), this.failure, this.injecting.element, this.tree, this.text);
    this.tools = [
      select(RATES, `${this.rate} Hz`, "updates per second", (choice) => {
        this.rate = Number.parseFloat(choice);
        // The same value, more often or less: what is open in it stays open.
        this.subscribe();
      }),
      button("Text", "tree or text", () => {
        this.isText = !this.isText;
        this.save();
        this.draw();
      }),
    ];
    this.show();
  }

  accept(path: string): void {
    const isOther = path !== this.path;
    this.path = path;
    this.input.value = path;
    if (isOther) this.show();
    else this.subscribe();
  }

  close(): void {
    this.stop();
    this.stopMark();
    this.injecting.close();
  }

  private save(): void {
    this.context.save({ path: this.path, rate: this.rate, text: this.isText });
  }

  /** Another value, of which nothing is known yet. */
  private show(): void {
    const { path, context } = this;
    this.stopMark();
    this.mark.hidden = true;
    this.sample = null;
    this.state.textContent = "";
    this.text.textContent = "";
    context.title(path);
    this.injecting.moved();
    this.branch = new Branch(path.slice(path.lastIndexOf(".") + 1), path, true);
    this.tree.replaceChildren(this.branch.element);
    const mark = (isInjected: boolean): void => {
      this.mark.hidden = !isInjected;
      this.injecting.mark(path, isInjected);
    };
    this.stopMark = path === "" ? () => undefined : watchInjected(context.robot, path, mark);
    this.subscribe();
    this.draw();
  }

  private subscribe(): void {
    const { path, rate } = this;
    this.stop();
    this.stop = () => undefined;
    this.save();
    complain(this.failure, null);
    if (path === "") return;
    this.stop = this.context.robot.subscriptions.watch(
      // As bytes, since an image as JSON would take seconds; the robot tells parameters as JSON alone.
      { path, rate, encoding: /^parameters(\.|$)/.test(path) ? "json" : "binary" },
      {
        sample: (next) => {
          this.sample = next;
          this.draw();
        },
        refused: (reason) => complain(this.failure, reason),
      },
    );
  }

  private paint(): void {
    this.tree.hidden = this.isText;
    this.text.hidden = !this.isText;
    if (this.sample === null) return;
    const { cycle, time, value } = this.sample;
    this.state.textContent = `cycle ${cycle}, ${seconds(time)}`;
    if (this.isText) this.text.textContent = json(value);
    else this.branch.show(value);
  }
}

export const value: PanelKind = { kind: "value", name: "Value", open: (context) => new ValuePanel(context) };
