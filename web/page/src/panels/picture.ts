// Owns how the value of an image becomes a picture: a JPEG file, or the bytes of a camera.
import type { Decoded } from "../connection/binary";

/** Whoever has it closes it: it is the browser's memory. */
export type Picture = ImageBitmap;

/** `null` where there is no image. */
export async function decode(value: Decoded): Promise<Picture | null> {
  if (value === null) return null;
  const file = value instanceof Uint8Array ? new Blob([value as Uint8Array<ArrayBuffer>], { type: "image/jpeg" }) : raw(value);
  return createImageBitmap(file);
}

export function draw(canvas: HTMLCanvasElement, picture: Picture): void {
  const { width, height } = picture;
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  const context = canvas.getContext("2d");
  if (context === null) throw new Error("this browser draws no pictures");
  context.drawImage(picture, 0, 0);
}

function raw(value: Decoded): ImageData {
  const { width, height, bytes } = parts(value);
  const image = new ImageData(width, height);
  const perPixel = bytes.length / (width * height);
  if (perPixel === 1) fromGray(bytes, image.data);
  else if (perPixel === 2) fromYuyv(bytes, image.data);
  else if (perPixel === 3) fromRgb(bytes, image.data);
  else throw new Error(`${bytes.length} bytes are no image of ${width} × ${height}`);
  return image;
}

function parts(value: Decoded): { width: number; height: number; bytes: Uint8Array } {
  if (value !== null && typeof value === "object" && !Array.isArray(value) && !(value instanceof Uint8Array)) {
    const { width, height } = value as Record<string, Decoded>;
    const lists = Object.values(value).map(bytesOf).filter((part) => part !== null);
    if (typeof width === "number" && typeof height === "number" && width > 0 && height > 0) {
      // Beside its pixels it may have lists of other numbers.
      const bytes = lists.find(({ length }) => [1, 2, 3].includes(length / (width * height))) ?? lists[0];
      if (bytes !== undefined) return { width, height, bytes };
    }
  }
  throw new Error("this is no image: it has no width, height and bytes");
}

/** Short lists of bytes come as numbers. */
function bytesOf(value: Decoded): Uint8Array | null {
  if (value instanceof Uint8Array) return value;
  const isBytes = Array.isArray(value) && value.length > 0 && value.every((one) => typeof one === "number");
  return isBytes ? Uint8Array.from(value as number[]) : null;
}

function fromGray(bytes: Uint8Array, pixels: Uint8ClampedArray): void {
  for (let at = 0, to = 0; at < bytes.length; at++) {
    const luminance = bytes[at] as number;
    pixels[to++] = luminance;
    pixels[to++] = luminance;
    pixels[to++] = luminance;
    pixels[to++] = 255;
  }
}

function fromRgb(bytes: Uint8Array, pixels: Uint8ClampedArray): void {
  for (let at = 0, to = 0; at < bytes.length; ) {
    pixels[to++] = bytes[at++] as number;
    pixels[to++] = bytes[at++] as number;
    pixels[to++] = bytes[at++] as number;
    pixels[to++] = 255;
  }
}

/** Full-range BT.601, bytes Y0 Cb Y1 Cr for two neighbouring pixels. */
function fromYuyv(bytes: Uint8Array, pixels: Uint8ClampedArray): void {
  for (let at = 0, to = 0; at + 3 < bytes.length; at += 4) {
    const blue = (bytes[at + 1] as number) - 128;
    const red = (bytes[at + 3] as number) - 128;
    for (const luminance of [bytes[at] as number, bytes[at + 2] as number]) {
      pixels[to++] = luminance + 1.402 * red;
      pixels[to++] = luminance - 0.344136 * blue - 0.714136 * red;
      pixels[to++] = luminance + 1.772 * blue;
      pixels[to++] = 255;
    }
  }
}
