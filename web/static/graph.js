// Zoom, pan, search and highlighting for the picture of a robot. Without it the picture is a plain one.
"use strict";
const main = document.querySelector("main");
const svg = main.querySelector("svg");
const search = document.getElementById("search");
const said = document.getElementById("said");
const nodes = [...svg.querySelectorAll(".node")];
const wires = [...svg.querySelectorAll(".wire[data-from]")];
const whole = { x: 0, y: 0, width: svg.viewBox.baseVal.width, height: svg.viewBox.baseVal.height };
let view = { ...whole };

main.classList.add("live");
svg.removeAttribute("width");
svg.removeAttribute("height");
svg.setAttribute("preserveAspectRatio", "xMidYMin meet");
for (const id of ["search", "zoom"]) document.getElementById(id).hidden = false;

function show(next) {
  view = next;
  svg.setAttribute("viewBox", `${view.x} ${view.y} ${view.width} ${view.height}`);
}

/** The place of the picture below a place of the window. */
function under(x, y) {
  return new DOMPoint(x, y).matrixTransform(svg.getScreenCTM().inverse());
}

/** Keeps the place (x, y) of the picture where it is. */
function zoom(factor, x, y) {
  const width = Math.min(Math.max(view.width * factor, 200), whole.width * 2);
  const scale = width / view.width;
  show({ x: x - (x - view.x) * scale, y: y - (y - view.y) * scale, width, height: view.height * scale });
}

function zoomMiddle(factor) {
  zoom(factor, view.x + view.width / 2, view.y + view.height / 2);
}

/** As wide as the window, from the top: text can be read; or everything, if that is small. */
function start() {
  const ratio = main.clientHeight / main.clientWidth;
  const width = Math.max(Math.min(whole.width, main.clientWidth), main.clientWidth * 0.6);
  show({ x: Math.min(0, (whole.width - width) / 2), y: 0, width, height: width * ratio });
}

function choose(node) {
  svg.classList.toggle("choosing", Boolean(node));
  for (const one of svg.querySelectorAll(".touched, .chosen")) one.classList.remove("touched", "chosen");
  said.textContent = "";
  if (!node) return;
  const name = node.dataset.node;
  node.classList.add("chosen");
  const others = new Set();
  let reads = 0, writes = 0;
  for (const wire of wires) {
    const to = wire.dataset.to.split(" ");
    if (wire.dataset.from !== name && !to.includes(name)) continue;
    wire.classList.add("touched");
    if (wire.dataset.from === name) { writes += 1; to.forEach((one) => others.add(one)); }
    else { reads += 1; others.add(wire.dataset.from); }
  }
  for (const one of nodes) one.classList.toggle("touched", others.has(one.dataset.node));
  said.textContent = `${name}: ${reads} read, ${writes} written`;
}

function center(node) {
  const box = node.getBBox();
  show({ ...view, x: box.x + box.width / 2 - view.width / 2, y: box.y + box.height / 2 - view.height / 2 });
}

function find() {
  const words = search.value.trim().toLowerCase();
  const text = (node) => `${node.dataset.node} ${[...node.querySelectorAll("text")].map((one) => one.firstChild.data).join(" ")}`;
  const found = words ? nodes.filter((node) => text(node).toLowerCase().includes(words)) : [];
  for (const node of nodes) node.classList.toggle("found", found.includes(node));
  if (words) said.textContent = found.length === 1 ? "1 node" : `${found.length} nodes`;
  else said.textContent = "";
  return found.sort((one, other) => rank(one, words) - rank(other, words));
}

/** Nodes whose name matches come before nodes that only read or write what was searched. */
function rank(node, words) {
  return node.dataset.node.toLowerCase().includes(words) ? 0 : 1;
}

let next = 0;
search.addEventListener("input", () => { next = 0; const [first] = find(); if (first) center(first); });
search.addEventListener("keydown", (event) => {
  if (event.key !== "Enter") return;
  const found = find();
  if (found.length === 0) return;
  const node = found[next++ % found.length];
  center(node);
  choose(node);
});
document.addEventListener("keydown", (event) => {
  if (event.key === "Escape") { search.value = ""; find(); choose(null); }
  if (event.target === search) return;
  if (event.key === "/") { event.preventDefault(); search.focus(); }
  if (event.key === "+") zoomMiddle(0.8);
  if (event.key === "-") zoomMiddle(1.25);
  if (event.key === "0") show({ ...whole });
});
for (const node of nodes) {
  node.setAttribute("tabindex", "0");
  node.setAttribute("role", "button");
  node.setAttribute("aria-label", node.dataset.node);
  node.addEventListener("keydown", (event) => { if (event.key === "Enter") choose(node); });
}
let drag = null;
main.addEventListener("pointerdown", (event) => {
  drag = { x: event.clientX, y: event.clientY, from: under(event.clientX, event.clientY), node: event.target.closest(".node"), moved: false };
  main.setPointerCapture(event.pointerId);
});
main.addEventListener("pointermove", (event) => {
  if (!drag) return;
  drag.moved ||= Math.hypot(event.clientX - drag.x, event.clientY - drag.y) > 4;
  if (!drag.moved) return;
  const now = under(event.clientX, event.clientY);
  show({ ...view, x: view.x + drag.from.x - now.x, y: view.y + drag.from.y - now.y });
});
main.addEventListener("pointerup", () => { if (drag && !drag.moved) choose(drag.node); drag = null; });
main.addEventListener("pointercancel", () => { drag = null; });
main.addEventListener("wheel", (event) => {
  event.preventDefault();
  const at = under(event.clientX, event.clientY);
  if (event.ctrlKey || event.metaKey) zoom(Math.exp(event.deltaY * 0.004), at.x, at.y);
  else {
    const scale = svg.getScreenCTM().a;
    show({ ...view, x: view.x + event.deltaX / scale, y: view.y + event.deltaY / scale });
  }
}, { passive: false });
document.getElementById("closer").addEventListener("click", () => zoomMiddle(0.8));
document.getElementById("farther").addEventListener("click", () => zoomMiddle(1.25));
document.getElementById("whole").addEventListener("click", () => show({ ...whole }));
start();
