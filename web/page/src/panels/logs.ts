// A panel with what the robot says: newest last, filtered by severity and words.
import { writeJson } from "../connection/exact";
import type { Level, Log, Welcome } from "../protocol";
import { isRemark, type Line } from "../store/logs";
import { isSameRun } from "../store/run";
import { button, complain, eachFrame, make, select } from "../view/dom";
import { seconds } from "../view/format";
import { arrange } from "../view/renew";
import { textSetting, type Context, type Panel, type PanelKind } from "./panel";

const LEVELS: readonly Level[] = ["trace", "debug", "info", "warn", "error"];
/** Of the levels that a robot makes. */
const UNCHANGED = "unchanged";
/** More lines are slower to draw than anybody reads. */
const SHOWN = 500;

function open(context: Context): Panel {
  let level = textSetting(context.settings, "level", "info") as Level;
  let words = textSetting(context.settings, "words");
  let isFollowing = true;
  let isDrawing = false;
  const list = make("div", { class: "log", role: "log" });
  const failure = make("p", { class: "failure", hidden: true });
  const search = make("input", { type: "search", value: words, placeholder: "filter: words, instance, node", "aria-label": "filter" });
  const save = (): void => context.save({ level, words });

  /** A row stays the same element: messages come while somebody clicks. */
  const rows = new WeakMap<Line, HTMLElement>();
  const rowOf = (line: Line): HTMLElement => {
    const found = rows.get(line) ?? row(context, line);
    rows.set(line, found);
    return found;
  };

  const draw = eachFrame(() => {
    const least = LEVELS.indexOf(level);
    const wanted = words.toLowerCase().split(/\s+/).filter((word) => word !== "");
    const isWanted = (line: Line): boolean => isRemark(line) || (LEVELS.indexOf(line.level) >= least && wanted.every((word) => textOf(line).includes(word)));
    const shown = context.robot.logs.value.filter(isWanted).slice(-SHOWN);
    isDrawing = true;
    arrange(list, shown.map(rowOf));
    if (isFollowing) list.scrollTop = list.scrollHeight;
    isDrawing = false;
  });
  list.addEventListener("scroll", () => {
    if (!isDrawing) isFollowing = list.scrollTop + list.clientHeight >= list.scrollHeight - 8;
  });
  search.addEventListener("input", () => {
    words = search.value;
    save();
    draw();
  });
  const made = levelMade(context, failure);
  const tools = [
    select(LEVELS, level, "at least this severe", (choice) => {
      level = choice as Level;
      save();
      draw();
    }),
    button("Newest", "follow the newest message", () => {
      isFollowing = true;
      draw();
    }),
  ];
  context.robot.wantLogs();
  const stops = [context.robot.logs.watch(draw), made.stop];
  const bar = make("div", { class: "bar" }, search, ...made.elements);
  return { content: make("div", { class: "logs" }, bar, failure, list), tools, close: () => stops.forEach((stop) => stop()) };
}

/** Which messages the robot makes: it does not say so, and others may change it, so the list stands for a wish and forgets it. */
function levelMade({ robot }: Context, failure: HTMLElement): { elements: HTMLElement[]; stop(): void } {
  const wished = make("span", { class: "muted" });
  const list = select([UNCHANGED, ...LEVELS], UNCHANGED, "what the robot keeps: less severe messages are not made", (choice) => {
    list.value = UNCHANGED;
    if (choice === UNCHANGED) return;
    wished.textContent = "";
    robot
      .ask({ set_log_level: { level: choice as Level } })
      .then(() => {
        wished.textContent = `${choice}, as was chosen here`;
        complain(failure, null);
      })
      .catch((error: unknown) => complain(failure, error));
  });
  let run: Welcome | null = null;
  const stop = robot.welcome.watch((welcome) => {
    // A robot that was started anew makes what its files say.
    if (isSameRun(run, welcome) !== true) wished.textContent = "";
    run = welcome;
  });
  return { elements: [make("label", { class: "muted" }, "robot makes ", list), wished], stop };
}

function textOf(log: Log): string {
  return `${log.message} ${log.instance ?? ""} ${log.node ?? ""} ${writeJson(log.fields ?? {})}`.toLowerCase();
}

function row({ robot }: Context, log: Line): HTMLElement {
  if (isRemark(log)) return make("div", { class: "entry remark" }, make("span", {}, log.remark));
  const from = [log.instance, log.node].filter((part) => part != null).join(" ");
  const fields = Object.entries(log.fields ?? {}).map(([name, value]) => `${name}=${typeof value === "string" ? value : writeJson(value)}`);
  const { instance, cycle } = log;
  const jump =
    instance == null || cycle == null
      ? null
      : button(`#${cycle}`, `plots and replay show cycle ${cycle} of ${instance}`, () => robot.moment.set({ time: log.time / 1e9, instance, cycle }), "link");
  return make(
    "div",
    { class: `entry ${log.level}` },
    make("time", {}, seconds(log.time)),
    make("b", {}, log.level),
    make("span", { class: "muted" }, `${from} `, jump),
    make("span", {}, [log.message, ...fields].join(" ")),
  );
}

export const logs: PanelKind = { kind: "logs", name: "Logs", open };
