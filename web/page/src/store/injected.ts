// Owns whether somebody, here or elsewhere, has put a value in place of an output.
import type { Entry } from "../protocol";
import type { Robot } from "./robot";

/** Deeper parts are small enough. */
const DEPTH = 8;

/**
 * Tells whether the output is injected to which this path belongs, until what it returns is called. Values as bytes do
 * not say it: a small part of the output is asked for as JSON, once a second.
 */
export function watchInjected(robot: Pick<Robot, "paths" | "subscriptions" | "welcome">, path: string, tell: (isInjected: boolean) => void): () => void {
  const [output] = /^[^.]+\.main_outputs\.[^.]+/.exec(path) ?? [];
  if (output === undefined) return () => undefined;
  let stop = (): void => undefined;
  let connection = 0;
  const begin = async (): Promise<void> => {
    const own = ++connection;
    const part = await smallPart(robot.paths, output).catch(() => null);
    if (part === null || own !== connection) return;
    stop();
    stop = robot.subscriptions.watch({ path: part, rate: 1 }, { sample: ({ injected }) => tell(injected === true) });
  };
  // Another program may have other parts.
  const stopWelcome = robot.welcome.watch((welcome) => {
    if (welcome !== null) void begin();
  });
  return () => {
    connection = -1;
    stopWelcome();
    stop();
  };
}

async function smallPart(paths: Robot["paths"], output: string): Promise<string> {
  let entry: Entry | undefined = await paths.find(output);
  for (let depth = 0; entry?.has_children === true && depth < DEPTH; depth++) {
    const below: readonly Entry[] = await paths.below(entry.path);
    const next: Entry | undefined = below.find(({ has_children }) => !has_children) ?? below[0];
    // Lists and maps do not name what they have; what is not there has the mark, too.
    if (next === undefined) return `${entry.path}.0`;
    entry = next;
  }
  return entry?.path ?? output;
}
