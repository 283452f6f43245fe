// What happens to a connection: restarts, replays, tokens, nonsense.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { join } from "node:path";
import { add, ask, begin, changes, clearLayout, hasCurve, hasPicture, isConnected, open, panel, reads, until } from "../page.mjs";
import { PATIENCE, step } from "../robot.mjs";
import { tablesAreWhole } from "./panels.mjs";

export async function restartsAreSurvived(page, stage) {
  await stage.stop();
  await page.locator('header > .state[data-state="lost"]').waitFor({ timeout: PATIENCE });
  assert.match((await panel(page, "value").locator("output").textContent()) ?? "", /cycle/, "what was there stays");
  await stage.start();
  await isConnected(page);
  await changes(page, panel(page, "value").locator("output"), "the cycle number after the restart");
  await until(page, panel(page, "plot").locator("canvas"), hasCurve, "a curve after the restart");
  step("a restart of the robot is survived");
}

export async function layoutsStay(page) {
  const count = await page.locator(".panel").count();
  await page.reload();
  await isConnected(page);
  assert.equal(await page.locator(".panel").count(), count, "the layout is kept");
  step("the layout is kept");
}

/** What the timeline of a recording has to show: parameters change twice, and Control is not recorded between. */
export async function somethingHappens(page) {
  const write = (changes) => ask(page, { write: { changes: Object.entries(changes).map(([path, value]) => ({ path, value })) } });
  const { value } = (await ask(page, { parameters: { path: "recording_switch" } })).parameters;
  await write({ "recording_switch.states": [], "recording_switch.after_fall": 0 });
  await page.waitForTimeout(2000);
  await write({ "recording_switch.states": value.states, "recording_switch.after_fall": value.after_fall });
  await page.waitForTimeout(2000);
}

async function whatHappenedIsMarked(page) {
  const replay = panel(page, "replay");
  const lane = replay.locator(".event-lane", { hasText: /^Control: / });
  await lane.locator(".event.missing").first().waitFor({ timeout: PATIENCE });
  assert((await replay.locator(".event.parameters").count()) >= 2, "both changes of parameters are marked");
  const slider = replay.getByLabel("time of the recording");
  const [begins, ends] = await slider.evaluate((element) => [Number(element.min), Number(element.max)]);
  const marks = await replay.locator(".event-marks .event").evaluateAll((marks) =>
    marks.map((mark) => {
      const [box, lane] = [mark.getBoundingClientRect(), mark.parentElement.getBoundingClientRect()];
      return { label: mark.getAttribute("aria-label"), color: getComputedStyle(mark).backgroundColor, area: box.width * box.height, middle: (box.left + box.right - 2 * lane.left) / (2 * lane.width) };
    }),
  );
  for (const { label, color, area, middle } of marks) {
    assert(area >= 24 && !/^rgba\(.*, 0\)$|transparent/.test(color), `${label} is drawn: ${area} px in ${color}`);
    const times = [...label.matchAll(/(\d+\.\d+) s/g)].map(([, time]) => Number(time));
    const expected = (times[0] + times.at(-1) - 2 * begins) / (2 * (ends - begins));
    assert(Math.abs(middle - expected) < 0.02, `${label} is drawn at ${middle} of the axis, not at ${expected}`);
  }
  assert(new Set(marks.map(({ color }) => color)).size >= 2, "different things look different");
  const gap = lane.locator(".event.missing").last();
  const from = Number(/(\d+\.\d+) s/.exec(await gap.getAttribute("aria-label"))[1]);
  await gap.click();
  await reads(replay.locator("output"), new RegExp(`^${from.toFixed(3)}`), "the time of the mark");
  step("what happened is marked on the time of a recording, and a mark leads there");
}

/** The robot has ended; its recording takes its place. */
export async function aRecordingIsReplayed(page, stage, picture) {
  const file = join(stage.run, "recording.mcap");
  await stage.stop();
  assert(existsSync(file), `no recording at ${file}`);
  await stage.start("--replay", file);
  await isConnected(page);
  await begin(page, "Replay");
  await whatHappenedIsMarked(page);
  await tablesAreWhole(page, "Replay");
  await picture(page, "replay");
  const replay = panel(page, "replay");
  const state = replay.locator("output");
  await replay.getByRole("button", { name: /^play or pause/ }).click();
  await changes(page, state, "the time of the replay");
  await replay.getByRole("button", { name: /^play or pause/ }).click();
  await replay.getByRole("button", { name: /^play or pause/ }).filter({ hasText: "Play" }).waitFor();
  const cycle = replay.locator("tbody tr", { hasText: "VisionTop" }).locator("td").nth(1);
  await replay.getByLabel("whose cycles are stepped").selectOption("VisionTop");
  const slider = replay.getByLabel("time of the recording");
  const half = await slider.evaluate((element) => (Number(element.min) + Number(element.max)) / 2);
  await slider.fill(half.toFixed(3));
  await reads(state, new RegExp(`^${half.toFixed(3)}`), "the time after a jump");
  const before = await cycle.textContent();
  await replay.getByRole("button", { name: /^one cycle on/ }).click();
  await reads(cycle, new RegExp(`^(?!${before}$)\\d+$`), "the cycle after a step on");
  const at = Number(await cycle.textContent());
  await replay.getByRole("button", { name: /^one cycle back/ }).click();
  await reads(cycle, new RegExp(`^${at - 1}$`), "the cycle after a step back");
  await replay.getByRole("button", { name: /^one cycle on/ }).click();
  await reads(cycle, new RegExp(`^${at}$`), "the cycle after another step on");
  await replay.getByLabel(/^speed/).selectOption("-1 ×");
  // The table is made anew with every answer.
  for (const since = Date.now(); Number(await cycle.textContent()) >= at; await page.waitForTimeout(100)) {
    assert(Date.now() - since < PATIENCE, "time does not go backwards");
  }
  await begin(page, "Match");
  await panel(page, "replay").getByLabel(/^speed/).selectOption("1 ×");
  await until(page, panel(page, "camera").locator(".stage canvas").first(), hasPicture, "a recorded image");
  await tablesAreWhole(page, "Match");
  await picture(page, "match");
  step("a recording is played, stepped, and played backwards");
}

export async function tokensAreAskedFor(page, stage) {
  await stage.stop();
  await stage.start("--token", "secret");
  await page.goto(stage.address);
  await isConnected(page);
  await clearLayout(page);
  const token = page.getByLabel("token");
  await token.fill("wrong");
  await token.press("Enter");
  await page.locator(".access .failure").waitFor({ timeout: PATIENCE });
  await add(page, "Parameters");
  await panel(page, "parameters").locator(".read-only").or(page.locator(".panel .read-only")).first().waitFor();
  await token.fill("secret");
  await token.press("Enter");
  await token.waitFor({ state: "hidden", timeout: PATIENCE });
  await page.locator(".read-only").waitFor({ state: "detached", timeout: PATIENCE });
  step("a token is asked for before anything is changed");
}

/** Everything that a broken robot could say, between what a good one says. */
export async function nonsenseDoesNoHarm(browser, stage) {
  const page = await browser.newPage();
  page.setDefaultTimeout(PATIENCE);
  const wrong = [];
  page.on("pageerror", (error) => wrong.push(error.message));
  // As often as it is enough: some of it makes the page ask again.
  let told = 0;
  await page.routeWebSocket(/\/socket$/, (socket) => {
    const robot = socket.connectToServer();
    robot.onMessage((message) => {
      socket.send(message);
      if (typeof message === "string" && message.includes('"welcome"')) return;
      if (told++ > 40) return;
      for (const nonsense of NONSENSE) socket.send(nonsense);
      // A value that ends too early, for a subscription that there is.
      if (typeof message !== "string" && message.length > 30) socket.send(Buffer.from(message).subarray(0, 27));
    });
  });
  await page.goto(stage.address);
  await isConnected(page);
  await clearLayout(page);
  await open(page, "Control.main_outputs.sensor_data", "Value");
  await changes(page, panel(page, "value").locator("output"), "the cycle number between nonsense");
  await page.waitForTimeout(1000);
  await changes(page, panel(page, "value").locator("output"), "the cycle number after nonsense");
  assert(told > 0);
  assert.deepEqual(wrong, [], "nonsense breaks nothing");
  await page.close();
  step("messages that nobody understands do no harm");
}

const NONSENSE = [
  "",
  "no JSON",
  "[]",
  "null",
  "17",
  '{"update":null}',
  // Whichever of them the panel has.
  ...Array.from({ length: 9 }, (_, subscription) => JSON.stringify({ update: { subscription } })),
  '{"answer":null}',
  '{"answer":{"id":999999,"ok":{}}}',
  '{"log":null}',
  '{"lost":{"updates":-1}}',
  '{"parameters_changed":7}',
  '{"something_new":{}}',
  Buffer.from([]),
  Buffer.from("HKG1"),
  Buffer.from(`HKG1${"\u0001".repeat(200)}`),
  Buffer.alloc(64, 0xff),
];

/** Of the same robot the page hears only what every robot has: numbers, and the framework's own procedure. */
export async function otherRobotsHaveNoFootball(browser, stage) {
  const page = await browser.newPage();
  page.setDefaultTimeout(PATIENCE);
  await page.routeWebSocket(/\/socket$/, (socket) => {
    const robot = socket.connectToServer();
    robot.onMessage((message) => {
      const said = typeof message === "string" ? JSON.parse(message) : null;
      const paths = said?.answer?.ok?.paths;
      if (paths === undefined) return socket.send(message);
      said.answer.ok.paths = paths.filter(({ path, type }) => path === "framework.procedures.rearm" || ["f32", "bool"].includes(type));
      socket.send(JSON.stringify(said));
    });
  });
  await page.goto(stage.address);
  await isConnected(page);
  const names = async (menu) => {
    await page.locator("summary", { hasText: menu }).click();
    const texts = await page.locator("details[open] .offers button").allTextContents();
    await page.keyboard.press("Escape");
    return texts;
  };
  await page.locator(".offers button", { hasText: "Plot" }).waitFor({ state: "attached", timeout: PATIENCE });
  const panels = await names("Add");
  for (const general of ["Value", "Plot", "Image", "Parameters", "Timings", "Cycles", "Procedures", "Logs", "Graph"]) assert(panels.includes(general), `${general} is missing: ${panels}`);
  for (const special of ["Field", "Camera", "Pose", "Drive", "Simulator", "Replay"]) assert(!panels.includes(special), `${special} is offered: ${panels}`);
  assert.deepEqual(await names("Layout"), ["Overview", "Tuning", "Graph"]);
  await page.close();
  step("a robot that plays no football has no panels about it");
}

export async function foreignScriptsDoNotRun(page) {
  await page.evaluate(() => {
    const script = document.createElement("script");
    script.textContent = "window.isForeign = true";
    document.body.append(script);
    const handler = document.createElement("div");
    handler.setAttribute("onclick", "window.isForeign = true");
    document.body.append(handler);
    handler.click();
  });
  assert.equal(await page.evaluate(() => window.isForeign), undefined, "an inline script was run");
  const answer = await page.evaluate(() => fetch("http://127.0.0.1:9/").then(() => "answered", (error) => error.name));
  assert.equal(answer, "TypeError");
  step("no script but the page's own runs");
}
