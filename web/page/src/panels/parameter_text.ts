// Owns how a parameter is written in a field, and what a text in the field means: by its type, without the field.
import { readJson, writeJson } from "../connection/exact";
import type { Json, Provenance } from "../protocol";
import type { Draft, Parameter } from "../store/tuning";
import type { Overtaken } from "../store/undone";

/** Of a value within a sentence. */
const LONGEST = 60;

const INTEGER = /^[iu](8|16|32|64|128|size)$/;
const FLOAT = /^f(32|64)$/;
/** JSON has no word for them: the robot says `null`. */
const NOT_FINITE = "inf or NaN";

const LINE_END = /[\r\n]/;

export interface Shape {
  kind: "flag" | "choice" | "number" | "words" | "json";
  /** Of a choice: the texts to choose from; the empty one is none. */
  choices: readonly string[];
  /** Whether there may be none. */
  isOptional: boolean;
  /** What the robot has where the field is empty. */
  empty?: string;
  write(value: Json): string;
  read(text: string): Draft;
}

/** Where two differ, a field of the one is none for the other: a robot that began anew may have other types and ranges. */
export function keyOf(parameter: Parameter): string {
  const { type, range, unit, documentation } = parameter.entry ?? {};
  const { kind, choices, empty } = shapeOf(parameter);
  return JSON.stringify([kind, choices, empty, type, range, unit, documentation]);
}

export function shapeOf({ value, entry }: Parameter): Shape {
  const [, content] = /^Option<(.*)>$/.exec(entry?.type ?? "") ?? [];
  const isOptional = content !== undefined;
  const type = content ?? entry?.type ?? "";
  const choices = entry?.choices ?? [];
  if (choices.length > 0) return choice(isOptional ? ["", ...choices] : choices);
  if (isOptional && type === "bool") return choice(["", "false", "true"], readJson);
  if (typeof value === "boolean") return { kind: "flag", choices: [], isOptional, write: String, read: (text) => ({ text, value: text === "true" }) };
  const isNumber = typeof value === "number" || typeof value === "bigint" || (isOptional && (INTEGER.test(type) || FLOAT.test(type))) || (value === null && FLOAT.test(type));
  if (isNumber) return { ...numeric(entry?.range ?? {}, isOptional, INTEGER.test(type)), ...(isOptional ? { empty: "none" } : value === null ? { empty: NOT_FINITE } : {}) };
  // A field of one line would drop the ends of lines, and what it has left would be written.
  if (typeof value === "string" && !isOptional && LINE_END.test(value)) return { kind: "json", choices: [], isOptional, write: (shown) => writeJson(shown), read: readAny };
  if (typeof value === "string" || (isOptional && type === "String")) return words(isOptional);
  return { kind: "json", choices: [], isOptional, write: (shown) => writeJson(shown), read: readAny };
}

function choice(choices: readonly string[], meaning: (text: string) => Json = (text) => text): Shape {
  return {
    kind: "choice",
    choices,
    isOptional: choices.includes(""),
    write: (value) => (value === null ? "" : String(value)),
    read: (text) => ({ text, value: text === "" ? null : meaning(text) }),
  };
}

function numeric({ minimum, maximum, is_half_open }: NonNullable<NonNullable<Parameter["entry"]>["range"]>, isOptional: boolean, isWhole: boolean): Shape {
  const read = (text: string): Draft => {
    const digits = text.trim();
    if (isOptional && (digits === "" || digits === "null")) return { text, value: null };
    const isInteger = /^[+-]?\d+$/.test(digits) && !Number.isSafeInteger(Number(digits));
    const value = isInteger ? BigInt(digits.replace("+", "")) : Number(digits === "" ? Number.NaN : digits);
    if (!isInteger && !Number.isFinite(value)) return { text, wrong: digits === "" ? "there is no number" : `\`${digits}\` is no number` };
    if (isWhole && typeof value === "number" && Number.isInteger(value) && !Number.isSafeInteger(value)) return { text, wrong: `of \`${digits}\` not all digits would be sent: write them out, without a point and an exponent` };
    const isInside = value >= (minimum ?? -Infinity) && value <= (maximum ?? Infinity) && !(is_half_open === true && value === maximum);
    return isInside ? { text, value } : { text, wrong: `${digits} is not within ${rangeOf({ minimum, maximum, is_half_open })}` };
  };
  return { kind: "number", choices: [], isOptional, write: (value) => (value === null ? "" : String(value)), read };
}

/** Of an optional text, nothing is none; what would be read otherwise stands in quotes. */
function words(isOptional: boolean): Shape {
  const write = (value: Json): string => {
    if (typeof value !== "string") return "";
    return isOptional && (value === "" || value.startsWith('"') || LINE_END.test(value)) ? JSON.stringify(value) : value;
  };
  const read = (text: string): Draft => {
    if (!isOptional) return { text, value: text };
    if (text === "") return { text, value: null };
    return text.startsWith('"') ? readAny(text) : { text, value: text };
  };
  return { kind: "words", choices: [], isOptional, ...(isOptional ? { empty: "none" } : {}), write, read };
}

function readAny(text: string): Draft {
  try {
    return { text, value: readJson(text) };
  } catch (error) {
    return { text, wrong: `this is no JSON: ${error instanceof Error ? error.message : String(error)}` };
  }
}

export function rangeOf(range: { minimum?: number | null | undefined; maximum?: number | null | undefined; is_half_open?: boolean | undefined } | null | undefined): string {
  if (range == null) return "";
  return `${range.minimum ?? "−∞"} … ${range.is_half_open === true ? "< " : ""}${range.maximum ?? "∞"}`;
}

/** One more or less of the last digit that stands there, which goes on to stand there: 0.99 is followed by 1.00 and 1.01. */
export function stepped(text: string, direction: 1 | -1, value: Json): string | null {
  if (typeof value === "bigint") return String(value + BigInt(direction));
  if (typeof value !== "number") return null;
  const [, mantissa, behind, exponent] = /^([+-]?\d*(?:\.(\d*))?)(e[+-]?\d+)?$/i.exec(text.trim()) ?? [];
  const digits = behind?.length ?? 0;
  // More than a browser writes, and more than a number has.
  if (mantissa === undefined || digits > 100) return null;
  return `${(Number(mantissa) + direction * 10 ** -digits).toFixed(digits)}${exponent ?? ""}`;
}

/** Where a value was given last. */
export function originOf(provenance: Provenance): string {
  switch (provenance.from) {
    case "file":
      return `${provenance.file}:${provenance.line}`;
    case "environment":
      return `$${provenance.variable}`;
    case "setting":
      return `--set ${provenance.setting}`;
    case "live":
      return `live, version ${provenance.version}`;
    case "nowhere":
      return "default";
  }
}

/** Why a write is not taken back: what stands there now, and where it comes from. */
export function overtakenText(overtaken: readonly Overtaken[]): string {
  const each = overtaken.map(({ path, now, provenance, written, before }) => `${path} is ${brief(now)} now (${originOf(provenance)}), not ${brief(written)} as it was written here; before that it was ${brief(before)}`);
  return ["not taken back: what was written here is not there any more", ...each].join("\n");
}

/** A list may be longer than anybody reads. */
export function brief(value: Json): string {
  const text = writeJson(value);
  return text.length <= LONGEST ? text : `${text.slice(0, LONGEST)}…`;
}
