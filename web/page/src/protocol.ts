// Written by `npm run protocol` from docs/protocol/*.schema.json. Do not edit.

/** Anything that JSON can say; integers that a number cannot hold are bigints. */
export type Json = null | boolean | number | bigint | string | Json[] | { [key: string]: Json };

/** The answer to one request. */
export type Answer = {
  /** That of the request; absent where the message was so wrong that it could not be read. */
  id?: number | null;
} & ({
  ok: Good;
} | {
  error: Failure;
});

/**
 * What is asked.
 *
 * Paths: `INSTANCE.main_outputs.NAME…`, `INSTANCE.additional_outputs.NAME…`, `INSTANCE.procedures.NAME`, `parameters…`,
 * `framework.procedures.NAME`.
 */
export type Ask = {
  authenticate: {
    /** As the robot was started with. */
    token: string;
  };
} | {
  paths: {
    /** Empty: the root. */
    below?: string;
    /** Levels below it; absent: 1. */
    depth?: number | null;
  };
} | {
  schema: {
    /** An output, a part of one, or parameters. */
    path: string;
  };
} | {
  layout: {
    /** An output, a part of one, parameters, or what a procedure is asked or answers. */
    path: string;
  };
} | {
  read: {
    /** An output, a part of one, or parameters. */
    path: string;
  };
} | {
  subscribe: {
    /** An output, a part of one, or parameters (an update with each change). */
    path: string;
    /** At most so many updates per second; absent: every cycle. */
    rate?: number | null;
    /** How values are written; absent: `json`. */
    encoding?: Encoding;
  };
} | {
  unsubscribe: {
    /** As the answer to `subscribe` said. */
    subscription: number;
  };
} | {
  bundle: Record<string, never>;
} | {
  write: {
    /** In this order, where they lie in each other. */
    changes: Array<Change>;
  };
} | {
  parameters: {
    /** Below the parameters, without `parameters.` in front; empty: all of them. */
    path?: string;
  };
} | {
  unstored: Record<string, never>;
} | {
  store: {
    /** One of those that `unstored` names. */
    layer: string;
    /** Below the parameters; without any: everything that was changed and not stored. */
    paths?: Array<string>;
  };
} | {
  reload: Record<string, never>;
} | {
  inject: {
    /** A whole main output. */
    path: string;
    /** In JSON. */
    value: Json;
  };
} | {
  release: {
    /** As it was injected. */
    path: string;
  };
} | {
  call: {
    /** `INSTANCE.procedures.NAME` or `framework.procedures.NAME`. */
    path: string;
    /** In JSON; absent: null. */
    argument?: Json;
    /** Seconds until the call counts as failed; absent: 5. */
    timeout?: number | null;
  };
} | {
  announce: {
    /** One that another machine runs, of kind `message` in `paths`. */
    instance: string;
    /** When its data was taken, in nanoseconds of the robot's clock: not in the future, after the cycle before. */
    time: number;
  };
} | {
  complete: {
    /** As in `announce`. */
    instance: string;
    /** As in `announce`. */
    time: number;
    /** In JSON: an object of the main outputs that the robot reads; others are ignored. */
    outputs: Json;
  };
} | {
  abandon: {
    /** As in `announce`. */
    instance: string;
    /** As in `announce`. */
    time: number;
  };
} | {
  logs: {
    /** At least this severe; absent: `info`. */
    level?: Level | null;
  };
} | {
  set_log_level: {
    /** `INSTANCE`, `INSTANCE.crate::module` (one node); absent: everything. */
    of?: string | null;
    /** Less severe ones are not made. */
    level: Level;
  };
} | {
  timings: Record<string, never>;
} | {
  trace: {
    /** How many; what is older than the robot keeps is left out. */
    seconds: number;
  };
} | {
  graph: Record<string, never>;
};

/** A parameter with its new value. */
export type Change = {
  /** Below the parameters, without `parameters.` in front. */
  path: string;
  /** In JSON. */
  value: Json;
};

/** Durations in microseconds. */
export type Durations = {
  /** Half are shorter. */
  p50: number;
  /** Of 100, 99 are shorter. */
  p99: number;
  /** The longest. */
  max: number;
};

/** How values of a subscription are written. */
export type Encoding = "json" | "binary" | {
  jpeg: {
    /** 1 (small) to 100 (good). */
    quality: number;
  };
};

/** Something with a path. */
export type Entry = {
  /** Whole, from the root. */
  path: string;
  /** What can be done with it. */
  kind: EntryKind;
  /** Of the value, as people write it; absent where there is no value. */
  type?: string | null;
  /** What its author says about it. */
  documentation?: string | null;
  /** Of its numbers, e.g. `m/s`. */
  unit?: string | null;
  /** Where its numbers must lie. */
  range?: Range | null;
  /** Whether there is something below it. */
  has_children: boolean;
  /** Of a list: how many elements it has, where the type says so. They are named `0`, `1`, …. */
  length?: number | null;
  /** Of an enum whose variants are names alone: all of them. */
  choices?: Array<string>;
  /** Of an image, which can be had as JPEG: its pixels, `gray`, `rgb` or `yuyv`. */
  image?: string | null;
  /** Of a procedure: the type of its argument. */
  request?: string | null;
  /** Of a procedure: the type of what it answers. */
  response?: string | null;
};

/** What can be done with something. */
export type EntryKind = "folder" | "main_output" | "additional_output" | "parameter" | "procedure" | "message";

/** Why something was not done. */
export type Failure = {
  /** For people: what happened and what to do. */
  message: string;
  /** Where several things were asked at once: what is wrong with each that is. */
  refusals?: Array<Refusal>;
};

/** What was asked for. */
export type Good = {
  done: Record<string, never>;
} | {
  paths: Array<Entry>;
} | {
  schema: Json;
} | {
  layout: Json;
} | {
  value: Value;
} | {
  subscribed: Subscribed;
} | {
  written: {
    /** Of the parameters: every instance has them from its next `begin` on. */
    version: number;
  };
} | {
  parameters: Reading;
} | {
  unstored: Unstored;
} | {
  stored: Stored;
} | {
  called: Json;
} | {
  timings: Timings;
} | {
  trace: Json;
} | {
  graph: Json;
};

/** What holds for a thread, as the system says itself. */
export type Granted = {
  /** `other`, `fifo` or `round-robin`; absent: one that no manifest can ask for. */
  policy?: string | null;
  /** 1 to 99 with a real-time policy, else 0. */
  priority: number;
  /** The cores it may run on, counted from 0. */
  cores: Array<number>;
  /** Whether this thread has locked the memory of the process. */
  memory_locked: boolean;
};

/** One instance. */
export type InstanceTimings = {
  /** Its name. */
  name: string;
  /** Finished cycles. */
  cycles: number;
  /** Cycles that took longer than the deadline. */
  overruns: number;
  /** Cycles that failed. */
  failures: number;
  /** How long a cycle may take, in microseconds. */
  deadline?: number | null;
  /** From the capture point to the end; absent where nothing was timed. */
  cycle?: Durations | null;
  /** From the capture time of the data to the begin of the cycle; absent where nothing was timed. */
  lateness?: Durations | null;
  /** Of `cycle`, what was not spent in nodes. */
  framework?: Durations | null;
  /** What the system granted its thread; absent where nothing was asked: by the manifest, or on a simulated target. */
  scheduling?: Granted | null;
  /** In the order in which they run. */
  nodes: Array<NodeTimings>;
  /** Perception instances that it consumes. */
  queues: Array<QueueTimings>;
};

/** A part that layers replace whole. */
export type Leaf = {
  /** From the root of the parameters. */
  path: string;
  /** Where it was given last. */
  provenance: Provenance;
};

/** How severe a log message is. */
export type Level = "trace" | "debug" | "info" | "warn" | "error";

/** A log message. */
export type Log = {
  /** Counts all messages of the run; a gap is a message that was left out. */
  number: number;
  /** In nanoseconds of the robot's clock. */
  time: number;
  /** How severe it is. */
  level: Level;
  /** The instance whose thread said it, if it was one. */
  instance?: string | null;
  /** The node that was running, if there was one. */
  node?: string | null;
  /** The cycle that was running, if there was one. */
  cycle?: number | null;
  /** What was said. */
  message: string;
  /** What was said with it, by name. */
  fields?: Record<string, Json>;
};

/** Updates that a client did not take in time. */
export type Lost = {
  /** Of this subscription; absent: log messages. */
  subscription?: number | null;
  /** How many since the last message of this kind. */
  updates: number;
};

/** One message of a robot. */
export type Message = {
  welcome: Welcome;
} | {
  answer: Answer;
} | {
  update: Update;
} | {
  lost: Lost;
} | {
  log: Log;
} | {
  parameters_changed: ParametersChanged;
};

/** One node of an instance. */
export type NodeTimings = {
  /** Its path in the manifest. */
  node: string;
  /** How often it ran. */
  calls: number;
  /** How often it did not, because a required input was absent. */
  skipped: number;
  /** How often it failed. */
  failures: number;
  /** Of timed calls; absent where nothing was timed. */
  durations?: Durations | null;
};

/** Parameters are not what they were. */
export type ParametersChanged = {
  /** The newest. */
  version: number;
};

/** Where a value was given last. */
export type Provenance = {
  from: "file";
  /** Its path. */
  file: string;
  /** From 1. */
  line: number;
} | {
  from: "environment";
  /** Its name. */
  variable: string;
} | {
  from: "setting";
  /** As it was written. */
  setting: string;
} | {
  from: "live";
  /** The version that brought it. */
  version: number;
} | {
  from: "nowhere";
};

/** Cycles of a perception instance, as far as one consumer is concerned. */
export type QueueTimings = {
  /** The perception instance. */
  from: string;
  /** Cycles that came. */
  delivered: number;
  /** Cycles that came after the consumer had gone on without them. */
  late: number;
  /** Cycles that found no place. */
  dropped: number;
};

/** Numbers from `minimum` to `maximum`; absent: without bound. */
export type Range = {
  /** The least. */
  minimum?: number | null;
  /** The greatest. */
  maximum?: number | null;
  /** Whether `maximum` itself is outside. */
  is_half_open?: boolean;
};

/** Parameters at a path. */
export type Reading = {
  /** What every instance has from its next `begin` on. */
  value: Json;
  /** Of all parameters. */
  version: number;
  /** Everything in it that layers replace whole, by path; the value itself if it is such a part. */
  leaves: Array<Leaf>;
};

/** What became of the frames of one instance in a recording, until now. */
export type RecordingCounts = {
  /** The instance; `INSTANCE.outputs`: values of its outputs; `logs`: log messages. */
  of: string;
  /** Whole frames that were handed over to be written. */
  recorded: number;
  /** Frames for which there was no room. */
  dropped: number;
  /** Frames of which something could not be encoded. */
  failed: number;
  /** Of those recorded: the disk did not take them, or a value could not be written. */
  lost: number;
  /** Of those recorded: older ones that went because the file has no room for more. */
  overwritten: number;
};

/** What is wrong with one of several things. */
export type Refusal = {
  /** Of the thing. */
  path: string;
  /** For people. */
  message: string;
};

/** An instance that another machine runs. Every cycle that began was completed, was abandoned, or is announced. */
export type RemoteTimings = {
  /** Its name. */
  name: string;
  /** Whether a client feeds it. */
  is_fed: boolean;
  /** Cycles that are complete. */
  completed: number;
  /** Of those: never announced, so that nobody waited for them. */
  unannounced: number;
  /** Cycles that were announced and not completed: withdrawn, ended by the next, or left by the client. */
  abandoned: number;
  /** Messages that were refused. */
  refused: number;
};

/** One message of a client. The robot gives exactly one answer to each, in any order. */
export type Request = {
  /** Chosen by the client; the answer has the same. */
  id: number;
  /** What is asked. */
  ask: Ask;
};

/** What was written into a file. */
export type Stored = {
  /** Its path. */
  file: string;
  /** What it now says; a list or an enum is always stored whole. */
  paths: Array<string>;
  /** Values that a later layer gives, too: they have no effect at the next start. */
  warnings: Array<string>;
};

/** A subscription that was made. */
export type Subscribed = {
  /** Updates carry this number. */
  subscription: number;
  /** As it was asked for. */
  encoding: Encoding;
  /** Of binary values: their layout, as docs/protocol/binary.md says. */
  layout?: Json;
};

/** All instances since the start. */
export type Timings = {
  /** The robot's clock, in nanoseconds: what lies between two of these happened between their times. */
  time: number;
  /** In manifest order. */
  instances: Array<InstanceTimings>;
  /** Instances that other machines run, in manifest order. */
  remotes?: Array<RemoteTimings>;
  /**
   * What became of the frames of a recording: by instance in manifest order, then values of outputs, then log messages; absent
   * where nothing is recorded.
   */
  recording?: Array<RecordingCounts>;
};

/** What would be lost at the next start. */
export type Unstored = {
  /** Of the parameters. */
  version: number;
  /** By path. */
  changes: Array<UnstoredChange>;
  /** Where they can be stored; later ones win. */
  layers: Array<string>;
  /** Parameters that nodes read only when they are created: a change waits for that. */
  creation_only: Array<string>;
};

/** A change that no file has. */
export type UnstoredChange = {
  /** From the root of the parameters. */
  path: string;
  /** Now. */
  value: Json;
  /** What the layers say; null where they say nothing. */
  stored: Json;
  /** The version that brought it. */
  version: number;
};

/** A value of a subscription. */
export type Update = {
  /** As the answer to `subscribe` said. */
  subscription: number;
  /** Number of the cycle that wrote it; of parameters their version. */
  cycle: number;
  /** Timestamp of that cycle, in nanoseconds of the robot's clock. */
  time: number;
  /** Null: the part is not there in this cycle. */
  value: Json;
  /** Whether a client has put it in place of what the node wrote. */
  injected?: boolean;
};

/** A value of one cycle. */
export type Value = {
  /** Number of the cycle that wrote it; of parameters their version. */
  cycle: number;
  /** Timestamp of that cycle, in nanoseconds of the robot's clock. */
  time: number;
  /** Null: the part is not there in this cycle. */
  value: Json;
  /** Whether a client has put it in place of what the node wrote. */
  injected?: boolean;
};

/** Who speaks. */
export type Welcome = {
  /** [`crate::VERSION`]. */
  version: number;
  /** The robot's name. */
  robot: string;
  /** The target that runs. */
  target: string;
  /** Its instances, in manifest order. */
  instances: Array<string>;
  /** Whether this connection may write; after `authenticate` if `needs_token`. */
  can_write: boolean;
  /** Whether `authenticate` comes before anything that writes. */
  needs_token: boolean;
  /** The robot's clock now, in nanoseconds. */
  time: number;
  /**
   * Of the robot's run: the same text on each connection as long as it goes on, another one after a restart. Absent: a
   * robot of an earlier version, which does not tell.
   */
  run?: string | null;
  /** Other robots as browsers name them, `HOST:PORT`, which the robot's page may show beside it. */
  peers?: Array<string>;
};
