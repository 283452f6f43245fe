// The panel of an image, with a robot that is only played.
import assert from "node:assert/strict";
import test from "node:test";
import { ofClass, opened, settled } from "../dom.mjs";
import { load } from "../load.mjs";

const { image } = await load("panels/image.ts");

const PATH = "VisionTop.main_outputs.image";

/** `kind`: what the robot says of the path; the page is told of it with each `welcome`. */
async function shown(kind, settings = {}) {
  const wishes = [];
  const watchers = [];
  const world = { kind };
  const subscriptions = {
    watch: (wish, watcher) => {
      wishes.push(wish.encoding);
      watchers.push(watcher);
      if (world.refusal !== undefined) watcher.refused(world.refusal);
      return () => wishes.splice(wishes.indexOf(wish.encoding), 1);
    },
  };
  const paths = { find: async () => (world.kind === undefined ? undefined : { path: PATH, image: world.kind }), everything: async () => [] };
  const { context, robot } = opened(() => ({}), { subscriptions, paths });
  Object.assign(context.settings, { path: PATH, ...settings });
  const panel = image.open(context);
  await settled();
  const welcome = async (next) => {
    world.kind = next;
    robot.welcome.set({ time: 1 });
    await settled();
  };
  return { panel, wishes, watchers, world, welcome };
}

const JPEG = { jpeg: { quality: 70 } };

test("an image is asked for as JPEG, other types and who wants it raw get its bytes", async () => {
  for (const [kind, settings, wanted] of [["yuyv", {}, JPEG], [null, {}, "binary"], ["yuyv", { quality: "raw" }, "binary"], [undefined, {}, JPEG]]) {
    const { wishes, panel } = await shown(kind, settings);
    assert.deepEqual(wishes, [wanted]);
    panel.close();
    assert.deepEqual(wishes, [], "a closed panel wants nothing");
  }
});

test("a refused JPEG is told, and not asked for as bytes", async () => {
  const { panel, wishes, watchers } = await shown("yuyv");
  const [failure] = ofClass(panel.content, "failure");
  watchers[0].refused("this client takes 8 images already");
  await settled();
  assert.deepEqual(wishes, [JPEG]);
  assert.equal(failure.textContent, "this client takes 8 images already");
  watchers[0].refused(null);
  assert(failure.hidden);
  panel.close();
  assert.deepEqual(wishes, []);
});

test("a robot that comes back is asked as what its program makes of the path", async () => {
  const { panel, wishes, welcome } = await shown("yuyv");
  await welcome(null);
  assert.deepEqual(wishes, ["binary"]);
  await welcome("yuyv");
  assert.deepEqual(wishes, [JPEG]);
  panel.close();
});

test("a panel that is closed while the robot is asked wants nothing", async () => {
  const { panel, wishes, world } = await shown("yuyv");
  world.kind = null;
  panel.accept("VisionTop.main_outputs.other");
  panel.close();
  await settled();
  assert.deepEqual(wishes, []);
});
