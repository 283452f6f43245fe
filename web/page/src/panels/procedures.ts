// A panel with the robot's procedures: call them with an argument in JSON and read what their nodes say.
import { readJson, writeJson } from "../connection/exact";
import { expect, Refused } from "../connection/socket";
import type { Entry, Json, Welcome } from "../protocol";
import { isSameRun } from "../store/run";
import { button, complain, make } from "../view/dom";
import { arrange } from "../view/renew";
import type { Context, Panel, PanelKind } from "./panel";

/** A procedure as it is drawn, as long as the robot says the same of it. */
interface Card {
  said: string;
  element: HTMLElement;
  /** Asks what the argument may be, unless that was answered; `isOther`: by another program. */
  explain(isOther: boolean): void;
}

function open(context: Context): Panel {
  const list = make("div", { class: "procedures" });
  const failure = make("p", { class: "failure", hidden: true });
  const none = make("p", { class: "muted" }, "this robot has no procedures");
  let cards = new Map<string, Card>();
  /** Whose procedures are shown; null: nobody's, or they did not come. */
  let run: Welcome | null = null;

  const load = async (): Promise<void> => {
    if (context.robot.state.value !== "open") return;
    const welcome = context.robot.welcome.value;
    // Those of a program do not change.
    const isOther = isSameRun(run, welcome) !== true;
    try {
      if (isOther) {
        const all = await context.robot.paths.everything();
        cards = new Map(all.filter(({ kind }) => kind === "procedure").map((entry) => [entry.path, cardOf(context, entry, cards.get(entry.path))]));
        arrange(list, cards.size === 0 ? [none] : [...cards.values()].map(({ element }) => element));
      }
      run = welcome;
      complain(failure, null);
      for (const card of cards.values()) card.explain(isOther);
    } catch (error) {
      run = null;
      complain(failure, error);
    }
  };
  const stop = context.robot.state.watch(() => void load());
  return { content: make("div", { class: "scroll" }, failure, list), close: stop };
}

/** The card that there is, with what was typed there, where the robot still says the same. */
function cardOf(context: Context, entry: Entry, there: Card | undefined): Card {
  const said = JSON.stringify(entry);
  return there?.said === said ? there : procedure(context, entry, said);
}

function procedure(context: Context, entry: Entry, said: string): Card {
  const argument = make("input", { type: "text", placeholder: "argument in JSON", "aria-label": `argument of ${entry.path}`, spellcheck: "false" });
  const answer = make("pre", { class: "value-text", hidden: true });
  const failure = make("p", { class: "failure", hidden: true });
  const call = async (): Promise<void> => {
    complain(failure, null);
    answer.hidden = true;
    try {
      const text = argument.value.trim();
      const value = text === "" ? null : readJson(text);
      const good = await context.robot.ask({ call: { path: entry.path, argument: value } });
      answer.textContent = writeJson(expect(good, "called"), 2);
      answer.hidden = false;
    } catch (error) {
      complain(failure, error);
    }
  };
  const deed = button("Call", `call ${entry.path}`, () => void call());
  argument.addEventListener("keydown", (event) => {
    if (event.key === "Enter") void call();
  });
  let isExplained = false;
  const explain = (isOther: boolean): void => {
    if (isExplained && !isOther) return;
    context.robot.ask({ schema: { path: `${entry.path}.request` } }).then(
      (good) => {
        const example = JSON.stringify(exampleOf(expect(good, "schema")));
        argument.placeholder = example === "null" ? "no argument" : `argument in JSON, for example ${example}`;
        isExplained = true;
      },
      // Some take anything: they have no schema.
      (error: unknown) => (isExplained = error instanceof Refused),
    );
  };
  const about = [entry.type, entry.documentation].filter((text) => text != null).join(" · ");
  const element = make("section", { class: "card" }, make("h3", {}, entry.path), make("p", { class: "muted" }, about), make("div", { class: "bar" }, argument, deed), failure, answer);
  return { said, element, explain };
}

/** A value that a schema lets pass: the simplest of each type. */
function exampleOf(schema: Json): Json {
  if (typeof schema !== "object" || schema === null || Array.isArray(schema)) return null;
  const first = [schema["enum"], schema["oneOf"], schema["anyOf"]].find((all) => Array.isArray(all) && all.length > 0) as Json[] | undefined;
  if (first !== undefined) return schema["enum"] === first ? first[0]! : exampleOf(first[0]!);
  if (schema["const"] !== undefined) return schema["const"];
  switch (schema["type"]) {
    case "object": {
      const properties = (schema["properties"] ?? {}) as Record<string, Json>;
      return Object.fromEntries(Object.entries(properties).map(([name, inner]) => [name, exampleOf(inner)]));
    }
    case "array":
      return Array.isArray(schema["items"]) ? schema["items"].map(exampleOf) : [];
    case "string":
      return "";
    case "boolean":
      return false;
    case "number":
    case "integer":
      return typeof schema["minimum"] === "number" ? Math.max(0, schema["minimum"]) : 0;
    default:
      return null;
  }
}

export const procedures: PanelKind = { kind: "procedures", name: "Procedures", open };
