// Owns what binary frames mean: their header, and values by their layout. Written from docs/protocol/binary.md.
import type { Json } from "../protocol";

/** A binary frame of a subscription. */
export interface Frame {
  subscription: number;
  cycle: number;
  /** In nanoseconds of the robot's clock. */
  time: number;
  bytes: Uint8Array<ArrayBuffer>;
}

const MAGIC = 0x31474b48; // "HKG1", little-endian
const HEADER = 24;
const SEVERAL = 0x53474b48; // "HKGS"

/** What a binary message has; what is no frame is left out. */
export function readFrames(buffer: ArrayBuffer): Frame[] {
  const view = new DataView(buffer);
  if (buffer.byteLength < 4) return [];
  if (view.getUint32(0, true) !== SEVERAL) return frame(buffer, 0, buffer.byteLength);
  const frames: Frame[] = [];
  for (let at = 4; at + 4 <= buffer.byteLength; ) {
    const length = view.getUint32(at, true);
    at += 4;
    if (length > buffer.byteLength - at) break;
    frames.push(...frame(buffer, at, length));
    at += length;
  }
  return frames;
}

function frame(buffer: ArrayBuffer, at: number, length: number): Frame[] {
  if (length < HEADER) return [];
  const view = new DataView(buffer, at);
  if (view.getUint32(0, true) !== MAGIC) return [];
  return [
    {
      subscription: view.getUint32(4, true),
      cycle: Number(view.getBigUint64(8, true)),
      time: Number(view.getBigUint64(16, true)),
      bytes: new Uint8Array(buffer, at + HEADER, length - HEADER),
    },
  ];
}

export type Layout =
  | { kind: "unit" | "bool" | "character" | "text" | "any" }
  | { kind: "float" | "signed" | "unsigned"; bits: number }
  | { kind: "option"; content: Layout }
  | { kind: "list"; item: Layout }
  | { kind: "array"; item: Layout; length: number }
  | { kind: "map"; value: Layout }
  | { kind: "struct"; fields: { name: string; layout: Layout; optional?: boolean }[] }
  | { kind: "tuple"; items: Layout[] }
  | { kind: "enum"; variants: { name: string; content?: Layout }[] }
  | { kind: "reference"; name: string };

export interface Described {
  root: Layout;
  definitions?: Record<string, Layout>;
}

/** Long lists of bytes stay bytes: an image as an array of numbers would be a hundred times as large. */
export type Decoded = Json | Uint8Array | Decoded[] | { [key: string]: Decoded };

/** Deeper than any type of a robot, shallower than the stack of a browser. */
const DEPTH = 128;
/** Parts of a value without bytes of their own: a count that lies may not take the browser's memory. */
const EMPTY_PARTS = 65536;

export class Malformed extends Error {}

/**
 * The value that the bytes are; lists of bytes of at least `keepBytes` items are not copied.
 * Throws `Malformed` where bytes and layout do not fit each other.
 */
export function decode(described: Described, bytes: Uint8Array, keepBytes = 1024): Decoded {
  const reader = new Reader(bytes, described.definitions ?? {}, keepBytes);
  const value = reader.value(described.root, 0);
  if (reader.position !== bytes.length) throw new Malformed("there are bytes behind the value");
  return value;
}

class Reader {
  position = 0;
  private parts: number;
  private readonly view: DataView;
  private readonly text = new TextDecoder("utf-8", { fatal: true, ignoreBOM: true });

  constructor(
    private readonly bytes: Uint8Array,
    private readonly definitions: Record<string, Layout>,
    private readonly keepBytes: number,
  ) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    this.parts = EMPTY_PARTS + 64 * bytes.length;
  }

  value(layout: Layout, depth: number): Decoded {
    if (depth > DEPTH) throw new Malformed("parts lie too deep in each other");
    if (this.parts-- === 0) throw new Malformed("there are too many parts");
    switch (layout.kind) {
      case "unit":
        return null;
      case "bool":
        return this.flag();
      case "character":
        return this.character();
      case "float":
        return this.float(layout.bits);
      case "signed":
      case "unsigned":
        return this.integer(layout.bits, layout.kind === "signed");
      case "text":
        return this.string();
      case "option":
        return this.flag() ? this.value(layout.content, depth + 1) : null;
      case "list":
        return this.items(layout.item, this.count(), depth);
      case "array":
        return this.items(layout.item, layout.length, depth);
      case "tuple":
        return layout.items.map((item) => this.value(item, depth + 1));
      case "map":
        return this.entries(() => this.value(layout.value, depth + 1));
      case "struct":
        return this.struct(layout.fields, depth);
      case "enum":
        return this.variant(layout.variants, depth);
      case "any":
        return this.any(depth);
      case "reference": {
        const definition = this.definitions[layout.name];
        if (definition === undefined) throw new Malformed(`the layout does not define ${layout.name}`);
        return this.value(definition, depth + 1);
      }
      default:
        throw new Malformed(`a layout of an unknown kind: ${JSON.stringify(layout)}`);
    }
  }

  private take(length: number): number {
    const start = this.position;
    if (start + length > this.bytes.length) throw new Malformed("the bytes end early");
    this.position += length;
    return start;
  }

  private count(): number {
    return this.view.getUint32(this.take(4), true);
  }

  private flag(): boolean {
    const byte = this.bytes[this.take(1)];
    if (byte !== 0 && byte !== 1) throw new Malformed("a byte is neither 0 nor 1");
    return byte === 1;
  }

  /** Also those that JSON does not have: an infinity is not nothing. */
  private float(bits: number): number {
    const start = this.take(bits / 8);
    return bits === 32 ? this.view.getFloat32(start, true) : this.view.getFloat64(start, true);
  }

  private integer(bits: number, isSigned: boolean): number | bigint | string {
    const start = this.take(bits / 8);
    const { view } = this;
    if (bits === 8) return isSigned ? view.getInt8(start) : view.getUint8(start);
    if (bits === 16) return isSigned ? view.getInt16(start, true) : view.getUint16(start, true);
    if (bits === 32) return isSigned ? view.getInt32(start, true) : view.getUint32(start, true);
    const high = start + bits / 8 - 8;
    let value = isSigned ? view.getBigInt64(high, true) : view.getBigUint64(high, true);
    if (bits === 64) return exact(value);
    value = (value << 64n) | view.getBigUint64(start, true);
    const fits = isSigned ? BigInt.asIntN(64, value) === value : BigInt.asUintN(64, value) === value;
    return fits ? exact(value) : value.toString();
  }

  private string(): string {
    const length = this.count();
    const start = this.take(length);
    try {
      return this.text.decode(this.bytes.subarray(start, start + length));
    } catch {
      throw new Malformed("a text is not UTF-8");
    }
  }

  private character(): string {
    const number = this.count();
    if (number > 0x10ffff || (number >= 0xd800 && number < 0xe000)) throw new Malformed("a number is no character");
    return String.fromCodePoint(number);
  }

  private items(item: Layout, length: number, depth: number): Decoded {
    if (item.kind === "unsigned" && item.bits === 8 && length >= this.keepBytes) {
      const start = this.take(length);
      return this.bytes.subarray(start, start + length);
    }
    const items: Decoded[] = [];
    for (let index = 0; index < length; index++) items.push(this.value(item, depth + 1));
    return items;
  }

  private entries(read: () => Decoded): Decoded {
    const count = this.count();
    const entries: [string, Decoded][] = [];
    for (let index = 0; index < count; index++) entries.push([this.string(), read()]);
    return Object.fromEntries(entries);
  }

  private struct(fields: { name: string; layout: Layout; optional?: boolean }[], depth: number): Decoded {
    const entries: [string, Decoded][] = [];
    for (const field of fields) {
      if (field.optional === true && !this.flag()) continue;
      entries.push([field.name, this.value(field.layout, depth + 1)]);
    }
    return Object.fromEntries(entries);
  }

  private variant(variants: { name: string; content?: Layout }[], depth: number): Decoded {
    const variant = variants[this.count()];
    if (variant === undefined) throw new Malformed("a variant that the layout does not list");
    if (variant.content === undefined) return variant.name;
    return Object.fromEntries([[variant.name, this.value(variant.content, depth + 1)]]);
  }

  private any(depth: number): Decoded {
    const next = (): Decoded => this.value({ kind: "any" }, depth + 1);
    const kind = this.bytes[this.take(1)];
    switch (kind) {
      case 0:
        return null;
      case 1:
      case 2:
        return kind === 2;
      case 3:
      case 4:
        return this.integer(64, kind === 3);
      case 5:
        return this.float(64);
      case 6:
        return this.string();
      case 7: {
        const count = this.count();
        const items: Decoded[] = [];
        for (let index = 0; index < count; index++) items.push(next());
        return items;
      }
      case 8:
        return this.entries(next);
      default:
        throw new Malformed("a kind that is not listed");
    }
  }
}

/** A number where it has all digits. */
function exact(value: bigint): number | bigint {
  const number = Number(value);
  return Number.isSafeInteger(number) ? number : value;
}
