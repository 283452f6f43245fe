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
  if (bytes.length === width * height * 2) fromYuyv(bytes, image.data);
  else if (bytes.length === width * height) bytes.forEach((byte, at) => image.data.set([byte, byte, byte, 255], at * 4));
  else throw new Error(`${bytes.length} bytes are no image of ${width} × ${height}`);
  return image;
}

function parts(value: Decoded): { width: number; height: number; bytes: Uint8Array } {
  if (value !== null && typeof value === "object" && !Array.isArray(value) && !(value instanceof Uint8Array)) {
    const { width, height } = value as Record<string, Decoded>;
    const bytes = Object.values(value).find((part) => part instanceof Uint8Array);
    if (typeof width === "number" && typeof height === "number" && bytes instanceof Uint8Array && width > 0 && height > 0) {
      return { width, height, bytes };
    }
  }
  throw new Error("this is no image: it has no width, height and bytes");
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
