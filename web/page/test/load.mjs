// Gives a test what a file of the page's sources exports, without a browser.
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "rolldown";

const here = dirname(fileURLToPath(import.meta.url));

/** `source`: below `src`. */
export async function load(source) {
  const folder = mkdtempSync(join(tmpdir(), "hulkgen-source-"));
  const file = join(folder, "source.mjs");
  await build({ input: join(here, "../src", source), output: { file, format: "esm" }, logLevel: "warn" });
  const exports = await import(file);
  rmSync(folder, { recursive: true });
  return exports;
}
