// What a person does with the page and sees on it, for the steps of the test.
import assert from "node:assert/strict";
import { PATIENCE } from "./robot.mjs";

export const panel = (page, kind) => page.locator(`.panel[data-kind="${kind}"]`);
export const isConnected = (page) => page.locator('header > .state[data-state="open"]').waitFor({ timeout: PATIENCE });

/** Opens a panel for a path as a person does: search, choose, press. */
export async function open(page, path, name) {
  await page.getByLabel("search all paths").fill(path);
  const line = page.locator(`.paths .line[data-path="${path}"]`);
  await line.locator(".name").first().click();
  await line.getByRole("button", { name: `open a panel: ${name}` }).click();
}

/** Adds a panel from the menu. */
export async function add(page, name) {
  await page.locator("summary", { hasText: "Add" }).click();
  await page.getByRole("button", { name: `add a panel: ${name}`, exact: true }).click();
}

export async function begin(page, preset) {
  await page.locator("summary", { hasText: "Layout" }).click();
  await page.getByRole("button", { name: `begin with ${preset}` }).click();
}

export async function clearLayout(page) {
  for (let rest = await page.locator(".panel").count(); rest > 0; rest--) {
    await page.getByLabel("close this panel").first().click();
  }
}

/** Whether a curve is drawn: its colour is in the canvas. */
export function hasCurve(canvas) {
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  for (let at = 0; at < data.length; at += 4) {
    if (data[at] < 40 && Math.abs(data[at + 1] - 114) < 30 && Math.abs(data[at + 2] - 178) < 30 && data[at + 3] > 128) return true;
  }
  return false;
}

/** Whether a picture is more than one colour. */
export function hasPicture(canvas) {
  if (canvas.width < 16 || canvas.height < 16) return false;
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  const colors = new Set();
  for (let at = 0; at < data.length && colors.size < 20; at += 4 * 997) colors.add(`${data[at]} ${data[at + 1]} ${data[at + 2]}`);
  return colors.size >= 20;
}

export async function until(page, locator, judge, what, timeout = PATIENCE) {
  const handle = await locator.elementHandle();
  await page.waitForFunction(judge, handle, { timeout, polling: 250 }).catch(() => assert.fail(`not seen: ${what}`));
}

export async function changes(page, locator, what) {
  const before = await locator.textContent();
  const handle = await locator.elementHandle();
  await page
    .waitForFunction(([element, text]) => element.textContent !== text && element.textContent !== "", [handle, before], { timeout: PATIENCE })
    .catch(() => assert.fail(`${what} stays "${before}"`));
}

/** Waits until the text is like this. */
export async function reads(locator, pattern, what, timeout = PATIENCE) {
  await locator
    .filter({ hasText: pattern })
    .waitFor({ timeout })
    .catch(async () => {
      const failures = await locator.page().locator(".failure:not([hidden])").allTextContents();
      assert.fail(`${what} is "${await locator.first().textContent()}", not ${pattern}; the page says ${JSON.stringify(failures)}`);
    });
}

/** In words, for whoever was not there: the state of the connection and the beginning of what each panel says. */
export async function whatIsSeen(page) {
  const look = page.evaluate(() => {
    const begin = (element, length) => (element?.innerText ?? "").replace(/\s+/g, " ").slice(0, length);
    const panels = [...document.querySelectorAll(".panel")].map((panel) => {
      const parts = [...panel.querySelectorAll(".about, .failure:not([hidden])")].map((part) => begin(part, 400));
      return [`  ${panel.dataset.kind}: ${begin(panel, 200)}`, ...parts.map((part) => `    ${part}`)].join("\n");
    });
    return [document.querySelector("header > .state")?.dataset.state, begin(document.querySelector("header"), 200), ...panels].join("\n");
  });
  const silence = new Promise((resolve) => setTimeout(resolve, 5000, "it does not answer"));
  return `${page.url()} ${await Promise.race([look, silence]).catch((error) => error.message)}`;
}

/** Asks the robot itself, beside the page. */
export function ask(page, request) {
  return page.evaluate(
    (request) =>
      new Promise((resolve, reject) => {
        const socket = new WebSocket(`ws://${location.host}/socket`);
        socket.onopen = () => socket.send(JSON.stringify({ id: 1, ask: request }));
        socket.onclose = () => reject(new Error("the robot ended, or was not there"));
        socket.onmessage = ({ data }) => {
          const { answer } = JSON.parse(data);
          if (answer === undefined) return;
          socket.close();
          if (answer.ok === undefined) reject(new Error(answer.error.message));
          else resolve(answer.ok);
        };
      }),
    request,
  );
}
