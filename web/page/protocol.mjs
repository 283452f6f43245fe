// Writes src/protocol.ts from the JSON schemas of the protocol. `--check` compares instead, and ends with 1 if it differs.
import { readFileSync, writeFileSync } from "node:fs";

const folder = new URL("../../docs/protocol/", import.meta.url);
const written = new URL("src/protocol.ts", import.meta.url);

function read(name) {
  return JSON.parse(readFileSync(new URL(`${name}.schema.json`, folder), "utf8"));
}

function comment(schema, indentation) {
  const text = schema?.description;
  if (!text) return "";
  const lines = text.split("\n").map((line) => `${indentation} * ${line}`.trimEnd());
  return lines.length === 1
    ? `${indentation}/** ${text} */\n`
    : `${indentation}/**\n${lines.join("\n")}\n${indentation} */\n`;
}

function object(schema, indentation) {
  const properties = Object.entries(schema.properties ?? {});
  if (properties.length === 0) return schema.additionalProperties === true ? "Record<string, Json>" : "Record<string, never>";
  const inner = `${indentation}  `;
  const fields = properties.map(([name, value]) => {
    const optional = (schema.required ?? []).includes(name) ? "" : "?";
    return `${comment(value, inner)}${inner}${name}${optional}: ${type(value, inner)};`;
  });
  return `{\n${fields.join("\n")}\n${indentation}}`;
}

const PLAIN = { string: "string", integer: "number", number: "number", boolean: "boolean", null: "null" };

/** The type that a schema describes, as an expression. */
function type(schema, indentation) {
  if (schema === true || schema === undefined) return "Json";
  if (schema.$ref) return schema.$ref.replace("#/$defs/", "");
  if ("const" in schema) return JSON.stringify(schema.const);
  if (schema.enum) return schema.enum.map((value) => JSON.stringify(value)).join(" | ");
  const choices = schema.oneOf ?? schema.anyOf;
  if (choices) {
    const either = choices.map((choice) => type(choice, indentation)).join(" | ");
    return schema.properties ? `${object(schema, indentation)} & (${either})` : either;
  }
  if (Array.isArray(schema.type)) return schema.type.map((name) => type({ ...schema, type: name }, indentation)).join(" | ");
  if (schema.type === "array") return `Array<${type(schema.items, indentation)}>`;
  if (schema.type === "object") return object(schema, indentation);
  if (schema.type in PLAIN) return PLAIN[schema.type];
  if (schema.type === undefined) return "Json";
  throw new Error(`a schema that this script does not know: ${JSON.stringify(schema)}`);
}

const types = new Map();
for (const root of ["request", "message"].map(read)) {
  const { $defs, ...self } = root;
  for (const [name, schema] of [...Object.entries($defs), [root.title, self]]) {
    types.set(name, `${comment(schema, "")}export type ${name} = ${type(schema, "")};\n`);
  }
}
const text = `// Written by \`npm run protocol\` from docs/protocol/*.schema.json. Do not edit.

/** Anything that JSON can say; integers that a number cannot hold are bigints. */
export type Json = null | boolean | number | bigint | string | Json[] | { [key: string]: Json };

${[...types.keys()].sort().map((name) => types.get(name)).join("\n")}`;

if (!process.argv.includes("--check")) writeFileSync(written, text);
else if (readFileSync(written, "utf8") !== text) {
  console.error("src/protocol.ts is not what docs/protocol says: run `npm run protocol`");
  process.exit(1);
}
