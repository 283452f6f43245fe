// Gives a test what files of the page's sources export, without a browser.
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "rolldown";

const here = dirname(fileURLToPath(import.meta.url));

/** `sources`: below `src`; what they share is the same to all of them. */
export async function load(...sources) {
  const folder = mkdtempSync(join(tmpdir(), "hulkgen-source-"));
  const input = sources.map((source) => join(here, "../src", source));
  await build({ input, plugins: [withoutPicture], output: { dir: folder, entryFileNames: "[name].mjs", chunkFileNames: "shared-[name].mjs", format: "esm" }, logLevel: "warn" });
  const exports = await Promise.all(sources.map((source) => import(join(folder, `${basename(source, ".ts")}.mjs`))));
  rmSync(folder, { recursive: true });
  return Object.assign({}, ...exports);
}

/** A chart draws nothing here, and style sheets are for browsers. */
const withoutPicture = {
  name: "without picture",
  resolveId: (id) => (id === "uplot" ? join(here, "chart.mjs") : id.endsWith(".css") ? `\0${id}` : null),
  load: (id) => (id.startsWith("\0") && id.endsWith(".css") ? { code: "", moduleType: "js" } : null),
};
