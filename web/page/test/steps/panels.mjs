// What panels offer beside what they show: where they stand, plots that are held, one cycle, the graph, logs.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { add, begin, changes, clearLayout, hasCurve, isConnected, open, panel, reads, until } from "../page.mjs";
import { PATIENCE, step } from "../robot.mjs";

const NUMBER = "Control.main_outputs.sensor_data.positions.head_pitch";

/** The kinds of panels, column by column. */
const arrangement = (page) => page.locator(".column").evaluateAll((columns) => columns.map((column) => [...column.querySelectorAll(".panel")].map((one) => one.dataset.kind)));

/** What the browser saves as a file. */
async function saved(page, deed) {
  const [download] = await Promise.all([page.waitForEvent("download", { timeout: PATIENCE }), deed()]);
  return { name: download.suggestedFilename(), file: await download.path() };
}

export async function panelsAreMoved(page) {
  await begin(page, "Overview");
  assert.deepEqual(await arrangement(page), [["timings", "logs"], ["parameters"]]);
  const head = (kind) => panel(page, kind).locator("> .head");
  // Letters that most of them have.
  await panel(page, "parameters").getByLabel("search a parameter").fill("a");
  const list = panel(page, "parameters").locator("> .scroll");
  const scroll = (element) => ((element.scrollTop = 200), element.scrollTop === 200);
  await until(page, list, scroll, "so many parameters that one scrolls");
  const stays = async (what) => assert.equal(await list.evaluate((element) => element.scrollTop), 200, `what is scrolled ${what}`);
  await head("logs").dragTo(panel(page, "parameters"), { targetPosition: { x: 200, y: 200 } });
  assert.deepEqual(await arrangement(page), [["timings"], ["logs", "parameters"]], "the panel lies where it was dropped");
  await stays("beside a panel that is dropped");
  await head("logs").focus();
  await page.keyboard.press("Alt+ArrowDown");
  assert.deepEqual(await arrangement(page), [["timings"], ["parameters", "logs"]], "keys move it within its column");
  await stays("and moved");
  assert(await head("logs").evaluate((element) => element === document.activeElement), "the panel that was moved keeps the focus");
  await page.keyboard.press("Alt+ArrowLeft");
  assert.deepEqual(await arrangement(page), [["logs", "timings"], ["parameters"]], "and into the next one");
  await stays("beside a panel that goes");
  const line = page.locator(".divider").first();
  await line.focus();
  await page.keyboard.press("ArrowDown");
  assert(await line.evaluate((element) => element === document.activeElement), "the line that was moved keeps the focus");

  const layout = page.locator("summary", { hasText: "Layout" });
  await layout.click();
  const { name, file } = await saved(page, () => page.getByRole("button", { name: "for others, or for another browser" }).click());
  assert.equal(name, "layout.json");
  await clearLayout(page);
  await layout.click();
  await page.getByLabel("layout file").setInputFiles(file);
  await panel(page, "logs").waitFor();
  assert.deepEqual(await arrangement(page), [["logs", "timings"], ["parameters"]], "the file brings it back");
  await page.keyboard.press("Escape");
  await layout.press("Escape");
  step("panels are moved by hand and by keys, and layouts are files");
}

export async function plotsAreHeld(page) {
  await clearLayout(page);
  await open(page, NUMBER, "Plot");
  const plot = panel(page, "plot");
  await until(page, plot.locator("canvas"), hasCurve, "a curve");
  await page.waitForTimeout(2000);
  const over = await plot.locator(".u-over").boundingBox();
  const ticks = () => plot.locator("canvas").evaluate((canvas) => canvas.toDataURL());
  // Parts of a picture, from the middle to the right.
  await page.mouse.move(over.x + 0.9 * over.width, over.y + 40);
  await page.mouse.down();
  await page.mouse.move(over.x + 0.98 * over.width, over.y + 40, { steps: 4 });
  await page.mouse.up();
  const pause = plot.getByRole("button", { name: /^hold the picture/ });
  await reads(pause, /^Go on$/, "the button of a plot that is held");
  const held = await ticks();
  await page.waitForTimeout(500);
  assert.equal(await ticks(), held, "a part that was chosen stays");
  const { file } = await saved(page, () => plot.getByRole("button", { name: "save what is shown" }).click());
  const [titles, ...rows] = readFileSync(file, "utf8").trim().split("\n");
  assert.equal(titles, `time,${NUMBER}`);
  const times = rows.map((row) => Number(row.split(",")[0]));
  assert(times.length > 1 && times.at(-1) - times[0] < 2.5, `a part of 20 s has its own times alone: ${times[0]} to ${times.at(-1)}`);
  await plot.getByLabel("curves of another run", { exact: true }).setInputFiles(file);
  await plot.locator(".u-label", { hasText: "of the other run" }).waitFor({ timeout: PATIENCE });
  await plot.locator(".u-over").dblclick();
  await reads(pause, /^Pause$/, "the button of a plot that goes on");
  step("a plot is held, shows a part, is saved, and compared with another run");
}

export async function cyclesAreLookedAt(page) {
  await begin(page, "Graph");
  const timings = panel(page, "timings");
  await reads(timings.locator(".recorded").first(), /^recording: [1-9]\d* recorded, \d+ dropped/, "what became of the recording");
  await timings.getByRole("button", { name: "one cycle with its nodes" }).click();
  await reads(timings.locator(".flames output"), /^cycle \d+: .*s, of which .*s framework$/, "what a flame tells of its cycle");
  assert((await timings.locator(".flame-row").nth(1).locator(".block").count()) > 5, "a flame has the nodes of a cycle");
  const { name, file } = await saved(page, () => timings.getByRole("button", { name: /ui\.perfetto\.dev$/ }).click());
  assert.equal(name, "trace.json");
  assert(JSON.parse(readFileSync(file, "utf8")).traceEvents.length > 20, "a trace has cycles and nodes");

  const cycles = panel(page, "cycles");
  const about = cycles.locator("output");
  await reads(about, /Control #\d+: \d+ persistent, \d+ transient/, "what the consumer's cycle takes");
  await cycles.locator("canvas").focus();
  await page.keyboard.press("ArrowLeft");
  await reads(cycles.getByRole("button", { name: "hold the picture" }), /^Go on$/, "the button of a picture that is held");
  const chosen = await about.textContent();
  await page.keyboard.press("ArrowLeft");
  await reads(about, new RegExp(`^(?!${chosen.slice(0, chosen.indexOf(":"))}:)Control #`), "the cycle before");
  step("one cycle is shown with its nodes, and chosen by keys");
}

export async function theGraphIsRead(page) {
  const graph = panel(page, "graph");
  const node = (name) => graph.locator(`.node[title="${name}"]`);
  await node("control::ball_filter").click();
  await graph.locator('.about p', { hasText: /^Control: \d+ runs, \d+ skipped, \d+ failed/ }).waitFor({ timeout: PATIENCE });
  await changes(page, graph.locator(".about > div.muted"), "what the chosen node takes");
  const has = async (name, what) => assert((await node(name).getAttribute("class")).split(" ").includes(what), `${name} is ${what}`);
  await has("control::ball_filter", "chosen");
  await has("vision::ball_detection", "read");
  await has("control::world_state_composer", "reader");
  await graph.getByLabel("search a node or value").fill("camera_matrix");
  await has("vision::camera_matrix_extractor", "found");
  await graph.locator(".about").getByRole("button", { name: "show Control.main_outputs.ball" }).click();
  await panel(page, "value").waitFor();
  step("a node of the graph tells who is read and who reads, and opens its values");
}

/** `folder` is that of the robot's parameter files, a copy. */
export async function parametersAreStored(page, folder) {
  await clearLayout(page);
  await add(page, "Parameters");
  const parameters = panel(page, "parameters");
  await parameters.getByLabel("search a parameter").fill("ball_filter.validity_time");
  const input = parameters.locator('input[data-path="ball_filter.validity_time"]');
  const [before, file] = [await input.inputValue(), join(folder, "default.toml")];
  const stored = () => /^validity_time = .*$/m.exec(readFileSync(file, "utf8"))[0];
  const line = stored();
  await input.fill(String(Number(before) + 1));
  await input.press("Enter");
  await parameters.getByText("1 parameter in no file").waitFor({ timeout: PATIENCE });
  assert.equal(stored(), line, "nothing is stored before somebody says so");
  await parameters.getByLabel("layer", { exact: true }).selectOption("default");
  await parameters.getByRole("button", { name: "write them into the file of this layer" }).click();
  await parameters.getByText("1 parameter in no file").waitFor({ state: "hidden", timeout: PATIENCE });
  assert.match(stored(), new RegExp(`^validity_time = ${Number(before) + 1}(\\.0)?\\b`), "the file has the new value");
  assert.equal(stored().replace(/^[^#]*/, ""), line.replace(/^[^#]*/, ""), "and its comment");
  step("a parameter is stored into the file of a layer");
}

/** Offered before anybody listens, and computed from the moment at which somebody does. */
export async function additionalOutputsFlow(page) {
  await clearLayout(page);
  await open(page, "Control.additional_outputs.ball_filter.delivered", "Value");
  await changes(page, panel(page, "value").locator("output"), "the cycle number of an additional output");
  step("an additional output flows once it is chosen");
}

export async function logsAreFiltered(page) {
  await clearLayout(page);
  await add(page, "Logs");
  const logs = panel(page, "logs");
  await logs.getByLabel(/^what the robot keeps/).selectOption("debug");
  await logs.getByLabel("at least this severe").selectOption("debug");
  await logs.getByLabel("filter").fill("no robot says this");
  await logs.locator(".entry").first().waitFor({ state: "detached", timeout: PATIENCE });
  const empty = () => logs.locator(".log").evaluate((list) => getComputedStyle(list, "::before").content);
  assert.match(await empty(), /said nothing/, "an empty list says why");
  step("logs are filtered, and an empty list says so");
}

/** No column of a table lies where only those find it who scroll. */
export async function tablesAreWhole(page, about) {
  const cut = await page.locator(".panel table").evaluateAll((tables) =>
    tables.filter((table) => table.offsetWidth > table.closest(".panel").clientWidth + 1).map((table) => `${table.closest(".panel").dataset.kind}: ${table.offsetWidth} px in ${table.closest(".panel").clientWidth} px`),
  );
  assert.deepEqual(cut, [], about);
}

export async function keysAndLooksAreThere(page) {
  await page.locator("body").click({ position: { x: 5, y: 5 } });
  await page.keyboard.press("/");
  assert.equal(await page.evaluate(() => document.activeElement?.getAttribute("aria-label")), "search all paths", "/ searches");
  const paper = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const size = () => page.evaluate(() => getComputedStyle(document.body).fontSize);
  const [light, normal] = [await paper(), await size()];
  await page.getByLabel("light or dark").selectOption("dark");
  await page.getByLabel(/^size of the text/).selectOption("large text");
  assert.notEqual(await paper(), light, "it is dark");
  assert(Number.parseFloat(await size()) > 1.4 * Number.parseFloat(normal), "text is large");
  await page.reload();
  await isConnected(page);
  assert.notEqual(await paper(), light, "the browser keeps it");
  await page.getByLabel("light or dark").selectOption("system colours");
  await page.getByLabel(/^size of the text/).selectOption("normal text");
  step("one key searches; dark and large are kept");
}
