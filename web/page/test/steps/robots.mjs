// Several robots on one page: each in its colour, each panel one of them, and nobody else.
import assert from "node:assert/strict";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { add, ask, clearLayout, isConnected, open, panel, reads, until } from "../page.mjs";
import { freePorts, PATIENCE, Stage, step } from "../robot.mjs";

const SCENARIO = join(fileURLToPath(import.meta.url), "../../three_robots.toml");
const COUNT = 3;
/** As the page has them, in order of the robots' addresses. */
const COLORS = [[0x00, 0x72, 0xb2], [0xcc, 0x79, 0xa7], [0x56, 0xb4, 0xe9]];
const TOKEN = "secret";

/** How many pixels of each colour there are; `apart`: by how much each part of one may differ. */
function areaOf(page, canvas, apart = 0) {
  return canvas.evaluate(
    (canvas, [colors, apart]) => {
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      const areas = colors.map(() => 0);
      for (let at = 0; at < data.length; at += 4) {
        const color = colors.findIndex((color) => color.every((part, offset) => Math.abs(data[at + offset] - part) <= apart));
        if (color >= 0 && data[at + 3] > 128) areas[color] += 1;
      }
      return areas;
    },
    [COLORS, apart],
  );
}

/** Waits until there is so much of each colour. */
async function showsAll(page, canvas, least, what, apart) {
  const since = Date.now();
  for (let areas = []; ; await page.waitForTimeout(250)) {
    areas = await areaOf(page, canvas, apart);
    if (areas.every((area) => area > least)) break;
    assert(Date.now() - since < PATIENCE, `${what}, by colour: ${areas}`);
  }
}

async function choose(page, panel, address) {
  const list = panel.getByLabel("which robot this panel shows");
  const names = await list.locator("option").allTextContents();
  await list.selectOption(names.find((name) => name.endsWith(address)));
}

export async function severalRobotsAreShown(browser, program, options, folder, picture) {
  // Ports follow each other, and so do the robots' colours: as texts they must, too.
  const port = await freePorts(COUNT);
  const addresses = Array.from({ length: COUNT }, (_, at) => `127.0.0.1:${port + at}`);
  const stage = new Stage(program, options, folder, port);
  await stage.start("--scenario", SCENARIO, "--token", TOKEN);
  const page = await browser.newPage({ viewport: { width: 1600, height: 900 } });
  page.setDefaultTimeout(PATIENCE);
  const wrong = [];
  page.on("pageerror", (error) => wrong.push(error.message));
  try {
    await page.goto(stage.address);
    await isConnected(page);
    await everyRobotHasItsColour(page);
    await panelsChoose(page, addresses);
    await curvesShareAPlot(page, addresses);
    await picture(page, "robots");
    await tokensStayApart(page, addresses);
    await theWorldIsHeld(page, addresses);
    await strangersStayOutside(page, port + COUNT);
    assert.deepEqual(wrong, []);
  } finally {
    await page.close();
    await stage.stop();
  }
}

async function everyRobotHasItsColour(page) {
  await clearLayout(page);
  await add(page, "Field");
  const canvas = panel(page, "map").locator("canvas");
  await showsAll(page, canvas, 40, "robots on the field");
  await panel(page, "map").getByLabel("robots").uncheck();
  for (const begin = Date.now(); ; await page.waitForTimeout(100)) {
    const [own, ...others] = await areaOf(page, canvas);
    if (own > 40 && others.every((area) => area === 0)) break;
    assert(Date.now() - begin < PATIENCE, `robots that nobody wants to see: ${others}`);
  }
  await panel(page, "map").getByLabel("robots").check();
  step("every robot of a scenario is on the field, in its colour");
}

/** The number of the shirt tells who answers. */
async function panelsChoose(page, addresses) {
  await open(page, "parameters.player.number", "Value");
  const reading = panel(page, "value").locator(".reading");
  await reads(reading, /^1$/, "the number of the first robot");
  await choose(page, panel(page, "value"), addresses[1]);
  await reads(reading, /^2$/, "the number of the second robot");
  await page.reload();
  await isConnected(page);
  await reads(reading, /^2$/, "the number of the second robot, from a layout that was kept");
  // One from another place, with a robot that this page may not show, and with one from before there were several.
  const places = ["10.255.255.1:4857", undefined].map((robot) => ({ kind: "value", size: 1, settings: { path: "parameters.player.number" }, robot }));
  const file = { version: 1, columns: [{ size: 1, panels: places }] };
  const kept = await page.evaluate(() => localStorage.getItem("layout"));
  await page.evaluate((text) => localStorage.setItem("layout", text), JSON.stringify(file));
  await page.reload();
  await isConnected(page);
  await page.getByText(/^10\.255\.255\.1:4857 is not among the robots/).waitFor();
  await reads(panel(page, "value").nth(1).locator(".reading"), /^1$/, "what an older layout shows");
  await choose(page, panel(page, "value").first(), addresses[1]);
  await reads(panel(page, "value").first().locator(".reading"), /^2$/, "the number of the robot in place of the one that is missing");
  await page.evaluate((text) => localStorage.setItem("layout", text), kept);
  await page.reload();
  await isConnected(page);
  await until(page, panel(page, "map").locator("canvas"), (canvas) => canvas.width > 16, "a field");
  step("every panel chooses whose value it shows, and layouts keep it");
}

/** Where everybody stands along the field, and the second robot across it, too: two strokes in one colour. */
async function curvesShareAPlot(page, addresses) {
  const [path, further] = [0, 1].map((axis) => `Control.main_outputs.ground_to_field.translation.${axis}`);
  await add(page, "Plot");
  const plot = panel(page, "plot");
  const draw = async (whose, path) => {
    const list = plot.getByLabel("whose numbers are added");
    const names = await list.locator("option").allTextContents();
    await list.selectOption(names.find((name) => name.endsWith(whose)));
    await plot.getByLabel("add a path").fill(path);
    await plot.getByLabel("add a path").press("Enter");
    assert(await plot.getByLabel("add a path").evaluate((element) => element === document.activeElement), "the next path can be typed at once");
  };
  await draw("robots", path);
  await draw(addresses[1], further);
  const names = ["A translation.0", "B translation.0", "C translation.0", "B translation.1"];
  const looks = async () => {
    assert.deepEqual(await plot.locator(".u-series .u-label").allTextContents(), ["time", ...names]);
    await showsAll(page, plot.locator("canvas"), 20, "curves in the plot", 8);
    const strokes = await plot.locator(".u-series .u-marker").evaluateAll((markers) => markers.slice(1).map((marker) => getComputedStyle(marker).background));
    assert.equal(new Set(strokes).size, names.length, `every curve looks otherwise: ${strokes}`);
    COLORS.forEach((color, at) => assert(strokes[at].includes(`rgb(${color.join(", ")})`), `${names[at]} is drawn as ${strokes[at]}`));
    assert(strokes[3].includes(`rgb(${COLORS[1].join(", ")})`), `${names[3]} is drawn as ${strokes[3]}`);
  };
  await looks();
  await page.reload();
  await isConnected(page);
  await looks();
  step("one plot has curves of several robots, in their colours, and layouts keep it");
}

async function tokensStayApart(page, addresses) {
  await page.locator("summary", { hasText: "Robots" }).click();
  await page.waitForFunction((count) => document.querySelectorAll('.robot-row .state[data-state="open"]').length === count, COUNT, { timeout: PATIENCE });
  const row = page.locator(".robot-row", { hasText: addresses[1] });
  const token = row.getByLabel("token");
  await token.fill(TOKEN);
  await token.press("Enter");
  await token.waitFor({ state: "hidden" });
  assert(await page.locator("header > .access").getByLabel("token").isVisible(), "the page's own robot has its own token");
  assert.deepEqual(await page.evaluate(() => Object.keys(sessionStorage)), [`token ${addresses[1]}`]);
  await page.keyboard.press("Escape");
  step("a token is told to the robot alone for which it was typed");
}

/** Neither robots that were not named, nor anybody else. */
async function strangersStayOutside(page, port) {
  const violated = await page.evaluate(
    (address) =>
      new Promise((resolve) => {
        document.addEventListener("securitypolicyviolation", (event) => resolve(`${event.effectiveDirective} ${event.blockedURI}`));
        const socket = new WebSocket(address);
        socket.onopen = () => resolve("it was let in");
        window.setTimeout(() => resolve("nothing was violated"), 5000);
      }),
    `ws://127.0.0.1:${port}/socket`,
  );
  assert.equal(violated, `connect-src ws://127.0.0.1:${port}/socket`);
  step("the page asks no robot that was not named");
}

/** Those of a scenario share a world, which goes on as somebody wishes who has the token of one of them, and begins anew. */
async function theWorldIsHeld(page, addresses) {
  await page.reload();
  await isConnected(page);
  await clearLayout(page);
  await add(page, "Simulator");
  await choose(page, panel(page, "simulator"), addresses[1]);
  const simulator = panel(page, "simulator");
  const speed = simulator.getByLabel("how fast the world goes on");
  // Who reads an output waits for the next cycle.
  const goesOn = () => ask(page, { read: { path: "Control.main_outputs.primary_state" } }).then(() => true, () => false);
  const comes = async (isWanted, what) => {
    const begin = Date.now();
    while ((await goesOn()) !== isWanted) assert(Date.now() - begin < PATIENCE, what);
  };
  await speed.selectOption("hold");
  await comes(false, "a world that is held stands still");
  await speed.selectOption("at full speed");
  await comes(true, "and goes on");
  step("the world of a scenario is held, and goes on");
  await speed.selectOption("hold");
  await comes(false, "a world that is held stands still");
  assert.equal(await simulator.getByLabel("which scenario is played").inputValue(), "three_robots");
  await simulator.getByRole("button", { name: "Play" }).click();
  await comes(true, "another world goes on in place of the one that was held");
  await until(page, speed, (element) => element.value === "1 ×", "the speed of the world that began anew");
  step("a scenario is played from its beginning");
}
