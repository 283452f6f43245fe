// A chart in place of uPlot's: it has what it was given, and draws nothing.

export default class Chart {
  scales = {};
  select = { left: 0, width: 0 };

  constructor(options, data) {
    Object.assign(this, { options, data });
    (globalThis.charts ??= []).push(this);
  }

  setData(data) {
    this.data = data;
  }

  setScale(name, scale) {
    this.scales[name] = scale;
  }

  /** A part that somebody has drawn with the mouse, in the data's own numbers. */
  drag(from, to) {
    this.select = { left: from, width: to - from };
    for (const heard of this.options.hooks.setSelect) heard(this);
  }

  posToVal(at) {
    return at;
  }

  batch(deed) {
    deed();
  }

  setSelect() {}
  setSize() {}
  destroy() {}
}
