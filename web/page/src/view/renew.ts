// Owns how a list that was made anew takes the place of the one before: what is still there is the same element,
// so that it keeps its focus, what is selected in it, and the click that has begun.

/** Gives it these children in this order; those that it has are not touched. */
export function arrange(parent: HTMLElement, wanted: readonly HTMLElement[]): void {
  const staying = new Set<Node>(wanted);
  for (const child of [...parent.childNodes]) if (!staying.has(child)) child.remove();
  wanted.forEach((child, at) => {
    const there = parent.childNodes[at] ?? null;
    if (there !== child) parent.insertBefore(child, there);
  });
}

/** The same with elements that were made anew: the one with the same `data-key` says what the new one says, and keeps its listeners. */
export function renew(parent: HTMLElement, fresh: readonly HTMLElement[]): void {
  const known = new Map([...parent.children].map((child) => [child.getAttribute("data-key"), child as HTMLElement]));
  const wanted = fresh.map((one) => {
    const key = one.getAttribute("data-key");
    const there = key === null ? undefined : known.get(key);
    if (there !== undefined) become(there, one);
    return there ?? one;
  });
  arrange(parent, wanted);
}

function become(there: Element, fresh: Element): void {
  for (const { name } of [...there.attributes]) if (fresh.getAttribute(name) === null) there.removeAttribute(name);
  for (const { name, value } of [...fresh.attributes]) if (there.getAttribute(name) !== value) there.setAttribute(name, value);
  const [before, after] = [[...there.childNodes], [...fresh.childNodes]];
  for (const rest of before.slice(after.length)) rest.remove();
  after.forEach((node, at) => {
    const old = before[at];
    if (old === undefined) there.append(node);
    else if (old.nodeName !== node.nodeName) old.replaceWith(node);
    else if (node.nodeType === Node.ELEMENT_NODE) become(old as Element, node as Element);
    else if (old.nodeValue !== node.nodeValue) old.nodeValue = node.nodeValue;
  });
}
