// Starts and stops the program of a robot for a test, and says what a patient person waits for.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { createServer } from "node:net";
import { join } from "node:path";

/** A busy machine may take so long for anything. */
export const PATIENCE = 100_000;

export function step(text) {
  console.log(text);
}

export function freePort() {
  return new Promise((resolve) => {
    const server = createServer().listen(0, "127.0.0.1", () => {
      const { port } = server.address();
      server.close(() => resolve(port));
    });
  });
}

/** The first of so many free ports in a row, with equally many digits. */
export async function freePorts(count) {
  const isFree = (port) =>
    new Promise((resolve) => {
      const server = createServer().once("error", () => resolve(false));
      server.listen(port, "127.0.0.1", () => server.close(() => resolve(true)));
    });
  for (;;) {
    const first = await freePort();
    const ports = Array.from({ length: count }, (_, at) => first + at);
    const areLong = ports.every((port) => port < 65536 && String(port).length === String(first).length);
    if (areLong && (await Promise.all(ports.map(isFree))).every(Boolean)) return first;
  }
}

/** One address, and whatever program serves it at the moment; each run has a folder of its own. */
export class Stage {
  runs = 0;

  constructor(program, options, folder, port) {
    Object.assign(this, { program, options, folder, port });
    this.address = `http://127.0.0.1:${port}/`;
  }

  static async at(program, options, folder) {
    return new Stage(program, options, folder, await freePort());
  }

  /** What the program says is shown only if something is wrong. */
  async start(...more) {
    this.run = join(this.folder, `run-${this.port}-${++this.runs}`);
    const robot = spawn(this.program, ["--headless", "--listen", `127.0.0.1:${this.port}`, "--run-folder", this.run, ...more, ...this.options]);
    robot.said = "";
    for (const stream of [robot.stdout, robot.stderr]) stream.on("data", (text) => (robot.said += text));
    robot.ended = new Promise((resolve) => robot.once("close", resolve));
    this.robot = robot;
    for (const begin = Date.now(); ; await new Promise((resolve) => setTimeout(resolve, 200))) {
      if (await fetch(this.address).then((answer) => answer.ok, () => false)) return;
      assert(robot.exitCode === null, `the robot ended:\n${robot.said}`);
      assert(Date.now() - begin < PATIENCE, `the robot serves no page:\n${robot.said}`);
    }
  }

  /** And the end of what it said. */
  howItIs() {
    if (this.robot === undefined) return "was stopped";
    const { exitCode, signalCode, said } = this.robot;
    return `${exitCode === null && signalCode === null ? "runs" : `ended with ${exitCode ?? signalCode}`}:\n${said.slice(-3000)}`;
  }

  async stop() {
    this.robot?.kill("SIGINT");
    await this.robot?.ended;
    this.robot = undefined;
  }
}
