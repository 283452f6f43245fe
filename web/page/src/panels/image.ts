// A panel with an image of the robot: as JPEG where the robot says that it is one, else as the camera's own bytes.
import type { Encoding } from "../protocol";
import type { Settings } from "../store/layout";
import { isImage } from "../store/paths";
import type { Sample } from "../store/subscriptions";
import { complain, eachFrame, make, select } from "../view/dom";
import { seconds } from "../view/format";
import { numberSetting, textSetting, type Context, type Panel, type PanelKind } from "./panel";
import { decode, draw, type Picture } from "./picture";

const RATES = ["1 Hz", "5 Hz", "10 Hz", "15 Hz", "30 Hz"];
const QUALITIES = ["quality 40", "quality 70", "quality 90", "raw"];
/** Pictures that are decoded at a time: one that takes longer than the display does not hold the next one back. */
const DECODERS = 2;
/** What was decoded within one frame of the display is shown in this and the next one, as smoothly as it was taken. */
const READY = 2;

interface Ready {
  sample: Sample;
  picture: Picture | null;
}

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
  private readonly draw = eachFrame(() => this.show());
  protected path: string;
  protected rate: number;
  private quality: string;
  private decoding = 0;
  /** Numbers of samples in the order in which they came: of the last one, and of the last one that is shown or not wanted any more. */
  private taken = 0;
  private settled = 0;
  /** The newest that no decoder was free for. */
  private waiting: Sample | null = null;
  /** Oldest first. */
  private ready: Ready[] = [];
  private stop = (): void => undefined;
  /** As what the image is asked for. */
  private chosen: Encoding | null = null;
  private turn = 0;
  private readonly stopChoosing: () => void;

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
    this.stopChoosing = context.robot.welcome.watch((welcome) => {
      if (welcome !== null && this.path !== "") void this.choose();
    });
  }

  accept(path: string): void {
    this.path = path;
    this.input.value = path;
    this.subscribe();
  }

  close(): void {
    this.turn++;
    this.stopChoosing();
    this.stop();
    this.forget();
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
    this.chosen = null;
    this.forget();
    this.context.title(this.path);
    this.save();
    this.moved();
    complain(this.failure, null);
    if (this.path === "") return;
    void this.choose();
  }

  /**
   * Asks anew where another encoding is right: a robot that was built anew may have made another type of it. Items of
   * lists, values of maps are in no list of paths; what they are, the robot says where it refuses a JPEG of them.
   */
  private async choose(isNoImage = false): Promise<void> {
    const turn = ++this.turn;
    const entry = this.quality === "raw" ? undefined : await this.context.robot.paths.find(this.path).catch(() => undefined);
    const encoding = this.encoding(entry === undefined ? !isNoImage : isImage(entry));
    const isSame = JSON.stringify(encoding) === JSON.stringify(this.chosen);
    if (turn !== this.turn || this.path === "" || isSame) return;
    this.stop();
    this.chosen = encoding;
    this.stop = this.context.robot.subscriptions.watch(
      { path: this.path, rate: this.rate, encoding },
      {
        sample: (sample) => void this.take(sample),
        refused: (reason) => {
          const isWrong = entry === undefined && encoding !== "binary" && reason?.includes("is no image") === true;
          if (isWrong && turn === this.turn) void this.choose(true);
          else complain(this.failure, reason);
        },
      },
    );
  }

  /** What the robot does not call an image may still have the bytes of one. */
  private encoding(hasJpeg: boolean): Encoding {
    if (this.quality === "raw" || !hasJpeg) return "binary";
    return { jpeg: { quality: Number.parseInt(this.quality.slice("quality ".length), 10) } };
  }

  /** Decodes at once: the display comes before a JPEG is decoded. What comes while all decoders are busy is left out but for the newest. */
  private async take(sample: Sample): Promise<void> {
    if (this.decoding === DECODERS) {
      this.waiting = sample;
      return;
    }
    const order = ++this.taken;
    this.decoding += 1;
    try {
      this.settle(order, { sample, picture: await decode(sample.value) });
    } catch (error) {
      if (order > this.settled) complain(this.failure, error);
    }
    this.decoding -= 1;
    const { waiting } = this;
    this.waiting = null;
    if (waiting !== null) void this.take(waiting);
  }

  /** One that was decoded behind a later one is left out. */
  private settle(order: number, decoded: Ready): void {
    if (order <= this.settled) {
      decoded.picture?.close();
      return;
    }
    this.settled = order;
    this.ready.push(decoded);
    if (this.ready.length > READY) this.ready.shift()?.picture?.close();
    this.draw();
  }

  /** Whatever was asked for until now. */
  private forget(): void {
    this.settled = this.taken;
    this.waiting = null;
    for (const { picture } of this.ready.splice(0)) picture?.close();
  }

  private show(): void {
    const next = this.ready.shift();
    if (next === undefined) return;
    if (this.ready.length > 0) this.draw();
    const { sample, picture } = next;
    // The absence of an image is no mistake: it leaves the last one.
    if (picture !== null) draw(this.canvas, picture);
    picture?.close();
    this.drawn(sample);
    complain(this.failure, null);
    const size = picture === null ? "no image" : `${this.canvas.width} × ${this.canvas.height}`;
    this.state.textContent = `${size}, cycle ${sample.cycle}, ${seconds(sample.time)}`;
  }
}

export const image: PanelKind = { kind: "image", name: "Image", open: (context) => new ImagePanel(context) };
