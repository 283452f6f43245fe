// Measures how smoothly the page draws, and whether its memory stays: `node test/smoothness.mjs [--minutes N] ADDRESS` of a
// running robot. Two images at 30 Hz, ten plots of every cycle and the map; prints a line of JSON each minute, and how it went.
// Ends with 1 where the page takes more memory than the points of its plots do, or still takes more once they are full.
import { existsSync } from "node:fs";
import { chromium } from "playwright-core";
import { ask, isConnected } from "./page.mjs";

/** So many points a curve keeps at most: at 83 Hz it is full after seven minutes. */
const POINTS = 33_000;
/** What one cycle may take until then, bytes: a time and a value of 8 bytes in each of ten curves, in lists with room for as many again. */
const POINT_BYTES = 10 * 2 * 8 * 2;
/** What a full page may gain in an hour before somebody calls it growth, MB. */
const STEADY = 5;

const words = process.argv.slice(2);
const minutes = words[0] === "--minutes" ? Number(words.splice(0, 2)[1]) : 15;
const [address] = words;

const panel = (kind, settings, size = 1) => ({ id: kind, kind, settings, size });
const JOINTS = ["head_yaw", "head_pitch", "left_hip_pitch", "left_knee_pitch", "left_ankle_pitch", "right_hip_pitch", "right_knee_pitch", "right_ankle_pitch", "left_shoulder_pitch", "right_shoulder_pitch"];
const plots = JOINTS.map((joint) => panel("plot", { paths: [`Control.main_outputs.sensor_data.positions.${joint}`], window: 10 }));
const images = ["Top", "Bottom"].map((camera) => panel("camera", { path: `Vision${camera}.main_outputs.image`, rate: 30 }));
const layout = { version: 1, columns: [{ size: 2, panels: [...images, panel("map", {})] }, { size: 1, panels: plots.slice(0, 5) }, { size: 1, panels: plots.slice(5) }] };

const executablePath = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(existsSync);
const browser = await chromium.launch({ executablePath, args: ["--headless", "--no-sandbox", "--disable-gpu"] });
const page = await browser.newPage({ viewport: { width: 1600, height: 1000 } });
await page.addInitScript((text) => localStorage.setItem("layout", text), JSON.stringify(layout));
await page.goto(address);
await isConnected(page);
const devtools = await page.context().newCDPSession(page);
await devtools.send("Performance.enable");

/** What is left after a collection. */
async function memory() {
  await devtools.send("HeapProfiler.collectGarbage");
  const { metrics } = await devtools.send("Performance.getMetrics");
  const of = (name) => metrics.find((metric) => metric.name === name).value;
  return { megabytes: Math.round(of("JSHeapUsedSize") / 1e4) / 100, nodes: of("Nodes"), listeners: of("JSEventListeners") };
}

/** Frames of the display, and different images and plots, per second; the longest times between two frames in ms. */
function rates(seconds) {
  return page.evaluate(
    (seconds) =>
      new Promise((resolve) => {
        const gaps = [];
        const begin = performance.now();
        let last = begin;
        const outputs = [...document.querySelectorAll('[data-kind="camera"] output')];
        const changes = outputs.map(() => 0);
        const texts = outputs.map((output) => output.textContent);
        const round = (value) => Math.round(10 * value) / 10;
        const count = (now) => {
          gaps.push(now - last);
          last = now;
          outputs.forEach((output, at) => {
            if (output.textContent !== texts[at]) changes[at] += 1;
            texts[at] = output.textContent;
          });
          if (now - begin < seconds * 1000) return requestAnimationFrame(count);
          gaps.sort((one, other) => one - other);
          const part = (share) => round(gaps[Math.min(Math.floor(share * gaps.length), gaps.length - 1)]);
          resolve({ frames: round(gaps.length / seconds), p50: part(0.5), p99: part(0.99), longest: part(1), images: changes.map((one) => round(one / seconds)) });
        };
        requestAnimationFrame(count);
      }),
    seconds,
  );
}

/** The slope of a line through what was measured. */
function slope(samples, along, name) {
  const mean = (of) => samples.reduce((sum, sample) => sum + sample[of], 0) / samples.length;
  const [middle, value] = [mean(along), mean(name)];
  const over = samples.reduce((sum, sample) => sum + (sample[along] - middle) * (sample[name] - value), 0);
  return over / samples.reduce((sum, sample) => sum + (sample[along] - middle) ** 2, 0);
}

const cycle = async () => (await ask(page, { read: { path: plots[0].settings.paths[0] } })).value.cycle;

const samples = [];
const [begin, first] = [Date.now(), await cycle()];
for (let minute = 1; minute <= minutes; minute++) {
  await page.waitForTimeout(Math.max(begin + minute * 60_000 - 20_000 - Date.now(), 0));
  const sample = { minute, ...(await rates(20)), ...(await memory()), cycles: (await cycle()) - first };
  samples.push(sample);
  console.log(JSON.stringify(sample));
}
const judge = (about, value, most) => {
  console.log(`${about}: ${value.toFixed(1)}, at most ${most}`);
  if (value > most) process.exitCode = 1;
};
// What is loaded and compiled once comes first.
const filling = samples.filter(({ minute, cycles }) => minute > 1 && cycles < POINTS);
if (filling.length >= 3) judge("bytes for each cycle, until the plots are full", slope(filling, "cycles", "megabytes") * 1e6, POINT_BYTES);
const full = samples.filter(({ cycles }) => cycles >= POINTS);
if (full.length >= 3) judge("megabytes in an hour, with full plots", 60 * slope(full, "minute", "megabytes"), STEADY);
await browser.close();
