// Measures how smoothly the page draws, and whether its memory stays: `node test/smoothness.mjs [--minutes N] ADDRESS` of a
// running robot. Two images at 30 Hz, ten plots of every cycle and the map; prints JSON.
import { existsSync } from "node:fs";
import { chromium } from "playwright-core";
import { isConnected } from "./page.mjs";

const words = process.argv.slice(2);
const minutes = words[0] === "--minutes" ? Number(words.splice(0, 2)[1]) : 1;
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

async function memory() {
  await devtools.send("HeapProfiler.collectGarbage");
  const { metrics } = await devtools.send("Performance.getMetrics");
  const of = (name) => metrics.find((metric) => metric.name === name).value;
  return { megabytes: Math.round(of("JSHeapUsedSize") / 1e5) / 10, nodes: of("Nodes") };
}

/** Frames of the display, and different images and curves, per second. */
function rates(seconds) {
  return page.evaluate(
    (seconds) =>
      new Promise((resolve) => {
        let frames = 0;
        let longest = 0;
        let last = performance.now();
        const begin = last;
        const outputs = [...document.querySelectorAll('[data-kind="camera"] output, [data-kind="map"] output')];
        const changes = outputs.map(() => 0);
        const texts = outputs.map((output) => output.textContent);
        const count = (now) => {
          frames += 1;
          longest = Math.max(longest, now - last);
          last = now;
          outputs.forEach((output, at) => {
            if (output.textContent !== texts[at]) changes[at] += 1;
            texts[at] = output.textContent;
          });
          if (now - begin < seconds * 1000) requestAnimationFrame(count);
          else resolve({ frames: Math.round(frames / seconds), longest: Math.round(longest), images: changes.slice(0, 2).map((one) => Math.round((10 * one) / seconds) / 10) });
        };
        requestAnimationFrame(count);
      }),
    seconds,
  );
}

// Until the plots are as full as they get in the window that they show.
await page.waitForTimeout(15_000);
const before = await memory();
const first = await rates(20);
await page.waitForTimeout(minutes * 60_000);
const last = await rates(20);
const after = await memory();
console.log(JSON.stringify({ minutes, first, last, before, after }, null, 1));
await browser.close();
