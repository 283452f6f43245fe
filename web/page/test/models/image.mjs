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
      if (world.refusal !== undefined && wish.encoding !== "binary") watcher.refused(world.refusal);
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

test("an image that is in no list of paths is asked for as bytes once its JPEG is refused for its type", async () => {
  const { panel, wishes, watchers, welcome } = await shown(undefined);
  const [failure] = ofClass(panel.content, "failure");
  const refusal = `\`${PATH}\` is no image: types that are say so with \`#[reflect(image = …)]\``;
  watchers[0].refused(refusal);
  await settled();
  assert.deepEqual(wishes, ["binary"]);
  assert(failure.hidden);
  watchers[1].refused("there is no such path");
  await settled();
  assert.deepEqual([wishes, failure.textContent], [["binary"], "there is no such path"]);
  // Another program may make one of it.
  await welcome(undefined);
  assert.deepEqual(wishes, [JPEG]);
  watchers[2].refused("this client takes 8 images already");
  await settled();
  assert.deepEqual([wishes, failure.textContent], [[JPEG], "this client takes 8 images already"]);
  panel.close();
});

test("a JPEG that was refused before is not asked for in turn with its bytes", async () => {
  const { panel, wishes, watchers, world } = await shown("yuyv");
  world.kind = undefined;
  world.refusal = "`x` is no image";
  panel.accept("VisionTop.main_outputs.crops.0");
  await settled();
  assert.deepEqual([wishes, watchers.length], [["binary"], 3]);
  panel.close();
  assert.deepEqual(wishes, []);
});

test("a panel that is closed while the robot is asked wants nothing", async () => {
  const { panel, wishes, world } = await shown("yuyv");
  world.kind = null;
  panel.accept("VisionTop.main_outputs.other");
  panel.close();
  await settled();
  assert.deepEqual(wishes, []);
});
