// Owns JSON with all digits of its integers: those that a number of JavaScript cannot hold are `bigint`.
import type { Json } from "../protocol";

/** Something that may be an integer beyond 2^53: a look that costs nothing. */
const LONG = /(?<![\d.])(?:9\d{15}|\d{17,})(?![\d.eE])/;
/** Where a string begins, or a number. */
const TOKENS = /"|-?\d+(?:\.\d+)?(?:[eE][+-]?\d+)?/g;

/** What the text says; throws a `SyntaxError` where it is no JSON. */
export function readJson(text: string): Json {
  if (!LONG.test(text)) return JSON.parse(text) as Json;
  // Strings in their place while the browser reads the rest: a name that no string of the text begins with, however it
  // is escaped.
  const name = `integer ${Math.random()} `;
  return JSON.parse(marked(text, name), (_, part: unknown) => (typeof part === "string" && part.startsWith(name) ? BigInt(part.slice(name.length)) : part)) as Json;
}

function marked(text: string, name: string): string {
  const parts: string[] = [];
  let done = 0;
  const tokens = new RegExp(TOKENS);
  for (let found = tokens.exec(text); found !== null; found = tokens.exec(text)) {
    const [token] = found;
    if (token === '"') {
      // One expression for whole strings would overflow the browser's stack where they have megabytes.
      tokens.lastIndex = behindString(text, found.index);
    } else if (/^-?[1-9]\d{15,}$/.test(token) && !Number.isSafeInteger(Number(token))) {
      parts.push(text.slice(done, found.index), `"${name}${token}"`);
      done = tokens.lastIndex;
    }
  }
  return [...parts, text.slice(done)].join("");
}

/** `begin`: where its quotation mark is. */
function behindString(text: string, begin: number): number {
  for (let end = text.indexOf('"', begin + 1); end >= 0; end = text.indexOf('"', end + 1)) {
    let escapes = 0;
    while (text[end - 1 - escapes] === "\\") escapes++;
    if (escapes % 2 === 0) return end + 1;
  }
  return text.length;
}

/** As `JSON.stringify`; bytes are written as numbers. `indentation`: of each level; 0: everything in one line. */
export function writeJson(value: unknown, indentation = 0): string {
  return written(value, indentation, "\n");
}

function written(value: unknown, indentation: number, line: string): string {
  if (typeof value === "bigint") return String(value);
  if (typeof value !== "object" || value === null) return JSON.stringify(value) ?? "null";
  const inner = indentation === 0 ? "" : line + " ".repeat(indentation);
  const between = `,${inner}`;
  const end = indentation === 0 ? "" : line;
  if (Array.isArray(value) || value instanceof Uint8Array) {
    const items = Array.from(value, (item: unknown) => written(item, indentation, inner));
    return items.length === 0 ? "[]" : `[${inner}${items.join(between)}${end}]`;
  }
  const fields = Object.entries(value).filter(([, field]) => field !== undefined);
  const colon = indentation === 0 ? ":" : ": ";
  const texts = fields.map(([name, field]) => `${JSON.stringify(name)}${colon}${written(field, indentation, inner)}`);
  return texts.length === 0 ? "{}" : `{${inner}${texts.join(between)}${end}}`;
}

/** What a robot says of itself, where all digits matter; everything else in a message is counted, and numbers are enough. */
const VALUES = /^\.(log\.fields|update\.value|answer\.ok\.(value\.value|parameters\.value|called|unstored\.changes\.\d+\.(value|stored)))$/;

/** A message of the robot, or several. */
export function readMessages(text: string): unknown[] {
  const said = readJson(text);
  const messages: Json[] = Array.isArray(said) ? said : [said];
  return LONG.test(text) ? messages.map((message) => counted(message, "")) : messages;
}

function counted(part: Json, path: string): Json {
  if (VALUES.test(path)) return part;
  if (typeof part === "bigint") return Number(part);
  if (typeof part !== "object" || part === null) return part;
  if (Array.isArray(part)) return part.map((item, at) => counted(item, `${path}.${at}`));
  return Object.fromEntries(Object.entries(part).map(([name, inner]) => [name, counted(inner, `${path}.${name}`)]));
}
