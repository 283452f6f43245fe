// Pictures from the bytes of a camera, without a browser.
import assert from "node:assert/strict";
import test from "node:test";
import { load } from "../load.mjs";

globalThis.ImageData = class {
  constructor(width, height) {
    Object.assign(this, { width, height, data: new Uint8ClampedArray(4 * width * height) });
  }
};
globalThis.createImageBitmap = async (image) => image;
const { decode } = await load("panels/picture.ts");

const pixels = async (value) => [...(await decode(value)).data];

test("an image has one, two or three bytes for a pixel", async () => {
  assert.deepEqual(await pixels({ width: 2, height: 1, data: Uint8Array.of(9, 200) }), [9, 9, 9, 255, 200, 200, 200, 255]);
  assert.deepEqual(await pixels({ width: 2, height: 1, data: Uint8Array.of(1, 2, 3, 250, 251, 252) }), [1, 2, 3, 255, 250, 251, 252, 255]);
  assert.deepEqual(await pixels({ width: 2, height: 1, data: Uint8Array.of(10, 128, 20, 128) }), [10, 10, 10, 255, 20, 20, 20, 255]);
});

test("a small image is one, too", async () => {
  assert.deepEqual(await pixels({ width: 1, height: 2, data: [7, 8] }), [7, 7, 7, 255, 8, 8, 8, 255]);
  assert.deepEqual(await pixels({ width: 1, height: 2, center: [0.5, 0.5, 1, 1, 1], data: [7, 8] }), [7, 7, 7, 255, 8, 8, 8, 255]);
});

test("what is no image is told", async () => {
  await assert.rejects(decode({ width: 2, height: 2, data: Uint8Array.of(1) }), /1 bytes are no image of 2 × 2/);
  await assert.rejects(decode({ width: 2, height: 2, data: "text" }), /no image/);
  assert.equal(await decode(null), null);
});
