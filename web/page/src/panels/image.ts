// A panel with an image of the robot: as JPEG where the robot makes one, else as the camera's own bytes.
import type { Decoded } from "../connection/binary";
import type { Encoding } from "../protocol";
import type { Settings } from "../store/layout";
import { isImage } from "../store/paths";
import type { Sample } from "../store/subscriptions";
import { complain, eachFrame, make, select } from "../view/dom";
import { seconds } from "../view/format";
import { numberSetting, textSetting, type Context, type Panel, type PanelKind } from "./panel";

const RATES = ["1 Hz", "5 Hz", "10 Hz", "15 Hz", "30 Hz"];
const QUALITIES = ["quality 40", "quality 70", "quality 90", "raw"];

/** Other panels draw over it: `moved`, `kept` and `drawn` are theirs. */
export class ImagePanel implements Panel {
  readonly content: HTMLElement;
  readonly tools: HTMLElement[];
  protected readonly canvas = make("canvas", { role: "img", "aria-label": "image" });
  /** The image, and whatever lies over it. */
  protected readonly stage = make("div", { class: "stage" }, this.canvas);
  private readonly state = make("output", { class: "muted" });
  private readonly failure = make("p", { class: "failure", hidden: true });
  private readonly input: HTMLInputElement;
  private readonly choices = make("datalist", { id: `images-${Math.random().toString(36).slice(2)}` });
  private readonly draw = eachFrame(() => void this.show());
  protected path: string;
  protected rate: number;
  private quality: string;
  private sample: Sample | null = null;
  private isDrawing = false;
  private stop = (): void => undefined;

  constructor(protected readonly context: Context) {
    this.path = textSetting(context.settings, "path");
    this.rate = numberSetting(context.settings, "rate", 15);
    this.quality = textSetting(context.settings, "quality", "quality 70");
    this.input = make("input", { type: "text", value: this.path, placeholder: "path of an image", "aria-label": "path of an image", list: this.choices.id, spellcheck: "false" });
    this.input.addEventListener("change", () => this.accept(this.input.value.trim()));
    this.input.addEventListener("focus", () => void this.offer());
    this.tools = [
      select(RATES, `${this.rate} Hz`, "images per second", (choice) => {
        this.rate = Number.parseFloat(choice);
        this.subscribe();
      }),
      select(QUALITIES, this.quality, "quality of the images", (choice) => {
        this.quality = choice;
        this.subscribe();
      }),
    ];
    this.content = make("div", { class: "image" }, make("div", { class: "bar" }, this.input, this.choices, this.state), this.failure, this.stage);
    this.subscribe();
  }

  accept(path: string): void {
    this.path = path;
    this.input.value = path;
    this.subscribe();
  }

  close(): void {
    this.stop();
  }

  /** Another image is wanted, or the same more often. */
  protected moved(): void {}

  /** Settings of a panel that draws over it. */
  protected kept(): Settings {
    return {};
  }

  /** This sample is on the canvas. */
  protected drawn(_sample: Sample): void {}

  protected save(): void {
    this.context.save({ path: this.path, rate: this.rate, quality: this.quality, ...this.kept() });
  }

  /** Outputs whose type is an image. */
  private async offer(): Promise<void> {
    const all = await this.context.robot.paths.everything().catch(() => []);
    this.choices.replaceChildren(...all.filter(isImage).map((entry) => make("option", { value: entry.path })));
  }

  private subscribe(): void {
    this.stop();
    this.sample = null;
    this.context.title(this.path);
    this.save();
    this.moved();
    complain(this.failure, null);
    if (this.path === "") return;
    if (this.quality === "raw") this.watch("binary");
    else this.watch({ jpeg: { quality: Number.parseInt(this.quality.slice("quality ".length), 10) } });
  }

  /** Where the robot makes no JPEG of it, its bytes may still be an image. */
  private watch(encoding: Encoding): void {
    this.stop();
    this.stop = this.context.robot.subscriptions.watch(
      { path: this.path, rate: this.rate, encoding },
      {
        sample: (sample) => {
          this.sample = sample;
          this.draw();
        },
        refused: (reason) => {
          if (reason !== null && encoding !== "binary" && this.context.robot.state.value === "open") this.watch("binary");
          else complain(this.failure, reason);
        },
      },
    );
  }

  /** A JPEG takes the browser a while: what came meanwhile is left out, except for the newest. */
  private async show(): Promise<void> {
    const { sample } = this;
    if (sample === null || this.isDrawing) return;
    this.isDrawing = true;
    try {
      if (sample.value instanceof Uint8Array) await drawJpeg(this.canvas, sample.value as Uint8Array<ArrayBuffer>);
      else drawRaw(this.canvas, sample.value);
      this.drawn(sample);
      complain(this.failure, null);
    } catch (error) {
      complain(this.failure, error);
    }
    this.state.textContent = `${this.canvas.width} × ${this.canvas.height}, cycle ${sample.cycle}, ${seconds(sample.time)}`;
    this.isDrawing = false;
    if (this.sample !== sample) this.draw();
  }
}

async function drawJpeg(canvas: HTMLCanvasElement, bytes: Uint8Array<ArrayBuffer>): Promise<void> {
  const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/jpeg" }));
  fit(canvas, bitmap.width, bitmap.height).drawImage(bitmap, 0, 0);
  bitmap.close();
}

/** The absence of an image is no mistake: it leaves the last one. */
function drawRaw(canvas: HTMLCanvasElement, value: Decoded): void {
  if (value === null) return;
  const { width, height, bytes } = parts(value);
  const image = new ImageData(width, height);
  if (bytes.length === width * height * 2) fromYuyv(bytes, image.data);
  else if (bytes.length === width * height) bytes.forEach((byte, at) => image.data.set([byte, byte, byte, 255], at * 4));
  else throw new Error(`${bytes.length} bytes are no image of ${width} × ${height}`);
  fit(canvas, width, height).putImageData(image, 0, 0);
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

function fit(canvas: HTMLCanvasElement, width: number, height: number): CanvasRenderingContext2D {
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  const context = canvas.getContext("2d");
  if (context === null) throw new Error("this browser draws no pictures");
  return context;
}

export const image: PanelKind = { kind: "image", name: "Image", open: (context) => new ImagePanel(context) };
