// Owns the picture of a field on a canvas: metres to pixels, moved and zoomed by hand, and what is drawn on it again and again.
import { sharp } from "../view/dom";
import { markings, RULES, type FieldSize } from "./field";
import { outOf, type Point, type Pose } from "./geometry";

/** Colours that the style sheet has, so that they follow light and dark. */
export interface Palette {
  ink: string;
  faint: string;
  paper: string;
  grass: string;
  line: string;
}

export class Chart {
  readonly canvas: HTMLCanvasElement;
  private size: FieldSize = RULES;
  private zoom = 1;
  private middle: Point = [0, 0];
  private held: { id: number; at: Point; middle: Point } | null = null;

  constructor(
    canvas: HTMLCanvasElement,
    private readonly draw: () => void,
  ) {
    this.canvas = canvas;
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoomed(Math.exp(-event.deltaY / 400));
    }, { passive: false });
    canvas.addEventListener("dblclick", () => this.whole());
    canvas.addEventListener("keydown", (event) => this.key(event));
  }

  /** The keyboard's way to do what wheel and drag do. */
  private key(event: KeyboardEvent): void {
    const step = 0.5 / this.zoom;
    const moves: Record<string, Point> = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] };
    const move = moves[event.key];
    if (move !== undefined) this.middle = [this.middle[0] + move[0], this.middle[1] + move[1]];
    else if (event.key === "+") this.zoom *= 1.2;
    else if (event.key === "-") this.zoom /= 1.2;
    else if (event.key === "0") return this.whole();
    else return;
    event.preventDefault();
    this.draw();
  }

  whole(): void {
    [this.zoom, this.middle] = [1, [0, 0]];
    this.draw();
  }

  private zoomed(factor: number): void {
    this.zoom = Math.min(Math.max(this.zoom * factor, 0.5), 20);
    this.draw();
  }

  /** A drag moves the picture; a panel asks for it where nothing else is under the pointer. */
  pan(event: PointerEvent): void {
    this.held = { id: event.pointerId, at: [event.offsetX, event.offsetY], middle: this.middle };
    this.canvas.setPointerCapture(event.pointerId);
    const move = (next: PointerEvent): void => {
      if (this.held === null || next.pointerId !== this.held.id) return;
      const scale = this.scale(this.size);
      const { at, middle } = this.held;
      this.middle = [middle[0] - (next.offsetX - at[0]) / scale, middle[1] + (next.offsetY - at[1]) / scale];
      this.draw();
    };
    const end = (): void => {
      this.held = null;
      this.canvas.removeEventListener("pointermove", move);
    };
    this.canvas.addEventListener("pointermove", move);
    for (const name of ["pointerup", "pointercancel"]) this.canvas.addEventListener(name, end, { once: true });
  }

  private scale(size: FieldSize): number {
    const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight];
    const [length, across] = [size.length + 2 * size.border, size.width + 2 * size.border];
    return this.zoom * Math.min(width / length, height / across);
  }

  toPixel([x, y]: Point): Point {
    const scale = this.scale(this.size);
    return [this.canvas.clientWidth / 2 + (x - this.middle[0]) * scale, this.canvas.clientHeight / 2 - (y - this.middle[1]) * scale];
  }

  toField([x, y]: Point): Point {
    const scale = this.scale(this.size);
    return [this.middle[0] + (x - this.canvas.clientWidth / 2) / scale, this.middle[1] - (y - this.canvas.clientHeight / 2) / scale];
  }

  /** A clean picture; `hasField`: with the lines, else with a grid, since nobody knows where the field is. */
  begin(size: FieldSize, hasField: boolean): CanvasRenderingContext2D | null {
    this.size = size;
    const { canvas } = this;
    const context = sharp(canvas);
    if (context === null) return null;
    const palette = paletteOf();
    context.fillStyle = palette.grass;
    context.fillRect(0, 0, canvas.clientWidth, canvas.clientHeight);
    context.strokeStyle = palette.line;
    if (hasField) this.drawField(context, size);
    else this.drawGrid(context);
    return context;
  }

  private drawField(context: CanvasRenderingContext2D, size: FieldSize): void {
    const scale = this.scale(size);
    context.lineWidth = Math.max(0.05 * scale, 1.5);
    for (const [one, other] of markings(size)) this.line(context, [one, other]);
    const [x, y] = this.toPixel([0, 0]);
    context.beginPath();
    context.arc(x, y, size.circleRadius * scale, 0, 2 * Math.PI);
    context.stroke();
    for (const side of [-1, 1]) {
      const [markX, markY] = this.toPixel([side * (size.length / 2 - size.penaltyMark), 0]);
      context.beginPath();
      context.arc(markX, markY, Math.max(0.05 * scale, 2), 0, 2 * Math.PI);
      context.fillStyle = context.strokeStyle;
      context.fill();
      const [goal, half] = [(side * size.length) / 2, size.goalWidth / 2];
      this.line(context, [[goal, -half], [goal + side * 0.5, -half], [goal + side * 0.5, half], [goal, half]]);
    }
  }

  private drawGrid(context: CanvasRenderingContext2D): void {
    context.lineWidth = 0.5;
    for (let at = -10; at <= 10; at++) {
      this.line(context, [[at, -10], [at, 10]]);
      this.line(context, [[-10, at], [10, at]]);
    }
  }

  line(context: CanvasRenderingContext2D, points: readonly Point[]): void {
    context.beginPath();
    points.forEach((point, at) => {
      const [x, y] = this.toPixel(point);
      if (at === 0) context.moveTo(x, y);
      else context.lineTo(x, y);
    });
    context.stroke();
  }

  /** `radius` in metres, but never too small to be seen. */
  disc(context: CanvasRenderingContext2D, at: Point, radius: number, fill: string | null, stroke: string | null): void {
    const [x, y] = this.toPixel(at);
    context.beginPath();
    context.arc(x, y, Math.max(radius * this.scale(this.size), 4), 0, 2 * Math.PI);
    if (fill !== null) {
      context.fillStyle = fill;
      context.fill();
    }
    if (stroke !== null) {
      context.strokeStyle = stroke;
      context.stroke();
    }
  }

  /** A robot from above: where it is, where it looks, and a name that needs no colour. */
  robot(context: CanvasRenderingContext2D, pose: Pose, color: string, name: string, isOutline: boolean): void {
    context.lineWidth = 2;
    // Dark colours are lost on dark grass.
    if (isOutline) this.disc(context, [pose.x, pose.y], 0.16, "#ffffff40", null);
    this.disc(context, [pose.x, pose.y], 0.16, isOutline ? null : color, isOutline ? color : "#ffffff");
    context.strokeStyle = isOutline ? color : "#ffffff";
    context.lineWidth = 3;
    this.line(context, [outOf(pose, [0.05, 0]), outOf(pose, [0.3, 0])]);
    if (name !== "") this.text(context, [pose.x, pose.y], name, isOutline ? color : "#ffffff");
  }

  ellipse(context: CanvasRenderingContext2D, at: Point, axes: { long: number; short: number; turn: number }, heading: number, color: string): void {
    const [x, y] = this.toPixel(at);
    const scale = this.scale(this.size);
    context.beginPath();
    context.ellipse(x, y, Math.max(axes.long * scale, 2), Math.max(axes.short * scale, 2), -(axes.turn + heading), 0, 2 * Math.PI);
    context.strokeStyle = color;
    context.stroke();
  }

  text(context: CanvasRenderingContext2D, at: Point, text: string, color: string): void {
    const [x, y] = this.toPixel(at);
    context.font = "600 12px system-ui, sans-serif";
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.lineWidth = 3;
    context.strokeStyle = "#00000080";
    context.strokeText(text, x, y);
    context.fillStyle = color;
    context.fillText(text, x, y);
  }
}

export function paletteOf(): Palette {
  const style = getComputedStyle(document.body);
  const of = (name: string): string => style.getPropertyValue(name).trim();
  return { ink: of("--ink"), faint: of("--faint"), paper: of("--paper"), grass: of("--grass"), line: of("--chalk") };
}
