// A panel with the robot's procedures: call them with an argument in JSON and read what their nodes say.
import { readJson, writeJson } from "../connection/exact";
import { expect } from "../connection/socket";
import type { Entry, Json } from "../protocol";
import { button, complain, make } from "../view/dom";
import type { Context, Panel, PanelKind } from "./panel";

function open(context: Context): Panel {
  const list = make("div", { class: "procedures" });
  const failure = make("p", { class: "failure", hidden: true });
  const kept = new Map<string, HTMLElement>();

  const load = async (): Promise<void> => {
    if (context.robot.state.value !== "open") return;
    try {
      const all = await context.robot.paths.everything();
      const found = all.filter((entry) => entry.kind === "procedure");
      list.replaceChildren(...found.map((entry) => {
        const card = kept.get(entry.path) ?? procedure(context, entry);
        kept.set(entry.path, card);
        return card;
      }));
      if (found.length === 0) list.append(make("p", { class: "muted" }, "this robot has no procedures"));
      complain(failure, null);
    } catch (error) {
      complain(failure, error);
    }
  };
  const stop = context.robot.state.watch(() => void load());
  return { content: make("div", { class: "scroll" }, failure, list), close: stop };
}

function procedure(context: Context, entry: Entry): HTMLElement {
  const argument = make("input", { type: "text", placeholder: "argument in JSON", "aria-label": `argument of ${entry.path}`, spellcheck: "false" });
  const said = make("pre", { class: "value-text", hidden: true });
  const failure = make("p", { class: "failure", hidden: true });
  const call = async (): Promise<void> => {
    complain(failure, null);
    said.hidden = true;
    try {
      const text = argument.value.trim();
      const value = text === "" ? null : readJson(text);
      const good = await context.robot.ask({ call: { path: entry.path, argument: value } });
      said.textContent = writeJson(expect(good, "called"), 2);
      said.hidden = false;
    } catch (error) {
      complain(failure, error);
    }
  };
  const deed = button("Call", `call ${entry.path}`, () => void call());
  argument.addEventListener("keydown", (event) => {
    if (event.key === "Enter") void call();
  });
  void context.robot.ask({ schema: { path: `${entry.path}.request` } }).then(
    (good) => {
      const example = JSON.stringify(exampleOf(expect(good, "schema")));
      argument.placeholder = example === "null" ? "no argument" : `argument in JSON, for example ${example}`;
    },
    // Some take anything: they have no schema.
    () => undefined,
  );
  const about = [entry.type, entry.documentation].filter((text) => text != null).join(" · ");
  return make("section", { class: "card" }, make("h3", {}, entry.path), make("p", { class: "muted" }, about), make("div", { class: "bar" }, argument, deed), failure, said);
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
