// Uses the page in a real browser, with a real robot: `node test/browser.mjs [--screenshots FOLDER] PROGRAM [OPTIONS]`.
// PROGRAM is that of the simulated NAO. Ends with 0 if everything was seen, else it says what was not.
import assert from "node:assert/strict";
import { cpSync, existsSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium } from "playwright-core";
import { ask, begin, isConnected, whatIsSeen } from "./page.mjs";
import { PATIENCE, Stage, step } from "./robot.mjs";
import { aRecordingIsReplayed, foreignScriptsDoNotRun, layoutsStay, nonsenseDoesNoHarm, otherRobotsHaveNoFootball, restartsAreSurvived, somethingHappens, tokensAreAskedFor } from "./steps/life.mjs";
import { additionalOutputsFlow, cyclesAreLookedAt, keysAndLooksAreThere, logsAreFiltered, panelsAreMoved, parametersAreStored, plotsAreHeld, tablesAreWhole, theGraphIsRead } from "./steps/panels.mjs";
import { severalRobotsAreShown } from "./steps/robots.mjs";
import { theRobotIsDriven, theWorldIsChanged } from "./steps/robotics.mjs";
import { aParameterChangesAnOutput, curvesAndImagesMove, injectionsReplaceOutputs, parametersComeBack, valuesChange } from "./steps/values.mjs";

const CHROMIUM = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(existsSync);
const OPTIONS = [
  "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
  "--disable-background-networking", "--disable-component-update", "--disable-sync",
];
const PRESETS = ["Overview", "Tuning", "Graph", "Vision", "Motion", "Game"];

const words = process.argv.slice(2);
const screenshots = words[0] === "--screenshots" ? words.splice(0, 2)[1] : null;
const [program, ...options] = words;
const folder = mkdtempSync(join(tmpdir(), "hulkgen-page-"));
// What is stored from the page goes into a copy.
const parameters = join(folder, "parameters");
cpSync(new URL("../../../robotics/parameters", import.meta.url), parameters, { recursive: true });
const stage = await Stage.at(program, ["--parameters", parameters, ...options], folder);

/** Small enough to be checked in: the browser itself writes WebP. */
async function picture(page, name) {
  if (screenshots === null) return;
  const png = await page.screenshot();
  const blank = await page.context().browser().newPage();
  const webp = await blank.evaluate(async (address) => {
    const image = await createImageBitmap(await (await fetch(address)).blob());
    const canvas = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height });
    canvas.getContext("2d").drawImage(image, 0, 0);
    return canvas.toDataURL("image/webp", 0.8);
  }, `data:image/png;base64,${png.toString("base64")}`);
  await blank.close();
  writeFileSync(join(screenshots, `${name}.webp`), Buffer.from(webp.slice(webp.indexOf(",") + 1), "base64"));
}

/** Who wakes the robot at its start may have been too quick for a busy machine; and pictures show one that stands. */
async function theRobotIsAwake(page) {
  const disturb = (argument) => ask(page, { call: { path: "framework.procedures.disturb", argument } });
  const state = async () => (await ask(page, { read: { path: "Control.main_outputs.primary_state" } })).value.value;
  for (const since = Date.now(); (await state()) === "Unstiff"; await page.waitForTimeout(3000)) {
    assert(Date.now() - since < PATIENCE, "the robot does not wake up");
    await disturb({ press: { button: "chest", lasts: 1 } });
  }
  await disturb({ kidnap: [2.0, 0.0, 0.0], ball: [3.0, 0.3] });
  await page.waitForTimeout(3000);
}

async function everyPresetIsShown(page) {
  await theRobotIsAwake(page);
  await page.getByLabel("search all paths").fill("");
  for (const preset of PRESETS) {
    await begin(page, preset);
    await page.waitForTimeout(screenshots === null ? 2500 : 6000);
    const failures = await page.locator(".failure:not([hidden])").allTextContents();
    assert.deepEqual(failures, [], preset);
    await tablesAreWhole(page, preset);
    await picture(page, preset.toLowerCase());
  }
  step("every preset is shown");
}

async function aPhoneShowsIt(browser) {
  const context = await browser.newContext({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, colorScheme: "dark" });
  context.setDefaultTimeout(PATIENCE);
  const page = await context.newPage();
  await page.goto(stage.address);
  await isConnected(page);
  await begin(page, "Overview");
  await page.waitForTimeout(2500);
  await tablesAreWhole(page, "on a phone");
  await begin(page, "Game");
  await page.waitForTimeout(3000);
  const { wide, screen } = await page.evaluate(() => ({ wide: document.documentElement.scrollWidth, screen: innerWidth }));
  assert(wide <= screen, `the page is ${wide} px wide on a phone of ${screen} px`);
  await picture(page, "phone");
  await context.close();
  step("a phone shows it, in the dark");
}

await stage.start();
const browser = await chromium.launch({ executablePath: CHROMIUM, args: OPTIONS });
try {
  const page = await browser.newPage({ viewport: { width: 1600, height: 900 } });
  page.setDefaultTimeout(PATIENCE);
  const wrong = [];
  page.on("pageerror", (error) => wrong.push(error.message));
  page.on("request", (request) => {
    const { host } = new URL(request.url());
    if (host !== "" && host !== `127.0.0.1:${stage.port}`) wrong.push(`asked ${request.url()}`);
  });
  await page.goto(stage.address);
  await isConnected(page);
  step("connected");
  await valuesChange(page);
  await curvesAndImagesMove(page);
  await parametersComeBack(page, await (await browser.newContext()).newPage(), stage.address);
  await aParameterChangesAnOutput(page);
  await injectionsReplaceOutputs(page);
  await restartsAreSurvived(page, stage);
  await layoutsStay(page);
  await keysAndLooksAreThere(page);
  await panelsAreMoved(page);
  await plotsAreHeld(page);
  await cyclesAreLookedAt(page);
  await theGraphIsRead(page);
  await logsAreFiltered(page);
  await additionalOutputsFlow(page);
  await parametersAreStored(page, parameters);
  await everyPresetIsShown(page);
  await theRobotIsDriven(page);
  await theWorldIsChanged(page);
  await aPhoneShowsIt(browser);
  await nonsenseDoesNoHarm(browser, stage);
  await otherRobotsHaveNoFootball(browser, stage);
  await somethingHappens(page);
  await aRecordingIsReplayed(page, stage, picture);
  await tokensAreAskedFor(page, stage);
  assert.deepEqual(wrong, []);
  await foreignScriptsDoNotRun(page);
  await stage.stop();
  await severalRobotsAreShown(browser, program, options, folder, picture);
} catch (error) {
  for (const page of browser.contexts().flatMap((context) => context.pages())) console.error(await whatIsSeen(page));
  console.error(`the robot ${stage.howItIs()}`);
  throw error;
} finally {
  await browser.close();
  await stage.stop();
  rmSync(folder, { recursive: true, force: true });
}
