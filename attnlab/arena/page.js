"use strict";
const data = JSON.parse(document.getElementById("data").textContent), slider = document.getElementById("price");
const SVG = "http://www.w3.org/2000/svg", percent = x => (100 * x).toFixed(1);
const ends = three => `${percent(three[0])} [${percent(three[1])}, ${percent(three[2])}]`;
const competes = row => !row.way.startsWith("("), steady = row => row.way.startsWith("(steady ");
const scored = (row, price) => row.harm[0] + price * row.looks[0];
const ordered = (rows, price) => rows.filter(competes).sort((a, b) => scored(a, price) - scored(b, price) ||
  (a.way < b.way ? -1 : 1));
const order = {}, open = {};  // by place: [column, direction]; are the places at other prices shown?

function make(parent, tag, text, attributes = {}, space) {
  const node = space ? document.createElementNS(space, tag) : document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  if (text !== undefined) node.textContent = text;
  parent.appendChild(node);
  return node;
}

function columns(rows, price) {
  const details = [...new Set(rows.flatMap(row => Object.keys(row.detail)))];
  const first = ordered(rows, price).map(row => row.way);
  return [
    ["way", row => row.way + (row.between ? " *" : ""), row => row.way],
    ["place", row => competes(row) ? first.indexOf(row.way) + 1 : "", row => competes(row) ? first.indexOf(row.way) : 1e9],
    ["score", row => scored(row, price).toFixed(3), row => scored(row, price)],
    ["looks %", row => ends(row.looks), row => row.looks[0]],
    ["harm %", row => ends(row.harm), row => row.harm[0]],
    ["saved at equal looks", row => row.saved ? ends(row.saved) : "", row => row.saved ? -row.saved[0] : Infinity],
    ["p (Holm)", row => row.holm === null ? "" : row.holm.toFixed(3), row => row.holm ?? Infinity],
    ["verdict", row => row.verdict, row => row.verdict || "~"],
    ["front", row => row.front ? "yes" : "", row => row.front ? 0 : 1],
    ["of resamples", row => competes(row) ? `${Math.round(100 * row.often)} %` : "", row => -row.often],
    ...details.map(name => [name, row => name in row.detail ? row.detail[name].toFixed(2) : "",
      row => row.detail[name] ?? Infinity])];
}

function table(parent, place, rows, price) {
  const cells = columns(rows, price), [column, direction] = order[place] ?? ["score", 1];
  const [, , key] = cells.find(([name]) => name === column) ?? cells[2];
  const sorted = [...rows].sort((a, b) => {
    const x = key(a), y = key(b);
    return direction * (x < y ? -1 : x > y ? 1 : a.way < b.way ? -1 : 1);
  });
  const grid = make(make(parent, "div", undefined, { class: "wide" }), "table"), head = make(make(grid, "thead"), "tr");
  const body = make(grid, "tbody");
  for (const [name] of cells) {
    const cell = make(head, "th", undefined, { scope: "col" }), button = make(cell, "button", name);
    if (name === column) cell.setAttribute("aria-sort", direction > 0 ? "ascending" : "descending");
    button.onclick = () => {
      order[place] = [name, column === name ? -direction : 1];
      draw();
      document.querySelectorAll(`[data-place="${CSS.escape(place)}"] th button`).forEach(b => b.textContent === name && b.focus());
    };
  }
  for (const row of sorted) {
    const line = make(body, "tr");
    cells.forEach(([name, shown]) => make(line, "td", shown(row), name === "verdict" && row.verdict ? { class: row.verdict } : {}));
  }
}

function plot(parent, place, rows) {
  const width = 900, height = 380, left = 46, right = 20, ground = height - 34, ticks = [0.02, 0.05, 0.1, 0.2, 0.5, 1];
  const least = Math.min(...rows.map(row => row.looks[0])) * 0.9, top = Math.max(...rows.map(row => row.harm[2])) || 1;
  const share = looks => Math.log(Math.max(looks, least) / least) / Math.log(1.02 / least);
  const x = looks => left + (width - left - right) * share(looks);
  const y = harm => ground - (ground - 24) * Math.sqrt(Math.max(0, harm) / top);
  const wide = make(parent, "div", undefined, { class: "wide" });
  const svg = make(wide, "svg", undefined, { viewBox: `0 0 ${width} ${height}`, role: "img",
    "aria-label": `Looks against harm in ${place}; the Pareto front in orange, clocks of any mean period as circles` }, SVG);
  make(svg, "path", undefined, { d: `M${left} 20V${ground}H${width - right}`, class: "axis" }, SVG);
  make(svg, "text", "looks in 100 cycles (logarithmic)", { x: width - right, y: height - 4, "text-anchor": "end" }, SVG);
  make(svg, "text", "harm, % (square root)", { x: 4, y: 12 }, SVG);
  for (const tick of ticks.filter(t => t >= least)) make(svg, "text", percent(tick).replace(".0", ""), { x: x(tick), y: ground + 14, "text-anchor": "middle" }, SVG);
  for (const tick of [0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1].filter(t => t <= top)) {
    if (tick && y(tick) > ground - 10) continue;
    make(svg, "text", percent(tick).replace(".0", ""), { x: left - 4, y: y(tick) + 4, "text-anchor": "end" }, SVG);
  }
  const along = kept => rows.filter(kept).sort((a, b) => a.looks[0] - b.looks[0]).map(row => `${x(row.looks[0])} ${y(row.harm[0])}`);
  const uniform = row => steady(row) || (rows.some(steady) && /^(always_on|fixed_\d+)$/.test(row.way));
  for (const [kept, kind] of [[uniform, "steady"], [row => row.front, "line"]]) {
    const points = along(kept);
    if (points.length) make(svg, "path", undefined, { d: `M${points.join("L")}`, class: kind }, SVG);
  }
  const taken = rows.map(row => [x(row.looks[0]) - 4, y(row.harm[0]) + 4, 8]);
  for (const row of [...rows].sort((a, b) => b.front - a.front)) {
    const [cx, cy] = [x(row.looks[0]), y(row.harm[0])];
    make(svg, "path", undefined, { class: "bar", d: `M${cx} ${y(row.harm[1])}V${y(row.harm[2])}M${x(row.looks[1])} ${cy}H${x(row.looks[2])}` }, SVG);
    const dot = make(svg, "circle", undefined, { cx, cy, r: 4, class: row.front ? "front" : steady(row) ? "held" : "dot" }, SVG);
    make(dot, "title", `${row.way}: ${ends(row.looks)} looks in 100 cycles, harm ${ends(row.harm)} %`, {}, SVG);
    if (!steady(row)) label(svg, row.way, cx, cy, taken, width, ground);
  }
}

function label(svg, text, cx, cy, taken, width, ground) {  // where it covers no other, as near as there is room
  const w = 6.2 * text.length, free = ([a, b]) => a >= 48 && a + w <= width && b >= 22 && b <= ground - 2 &&
    !taken.some(([p, q, v]) => a < p + v && p < a + w && Math.abs(b - q) < 11);
  const places = [6, 18, 30, 44, 60, 78, 98].flatMap(d => [[cx + 7, cy - d], [cx - 7 - w, cy - d], [cx + 7, cy + d + 4], [cx - 7 - w, cy + d + 4]]);
  const [a, b] = places.find(free) ?? [cx + 7, cy - 6];
  taken.push([a, b, w]);
  if (Math.abs(b - cy) > 16) make(svg, "path", undefined, { d: `M${cx} ${cy}L${a < cx ? a + w : a} ${b - 4}`, class: "lead" }, SVG);
  make(svg, "text", text, { x: a, y: b }, SVG);
}

function rankTable(parent, rows, price) {
  const grid = make(make(parent, "div", undefined, { class: "wide" }), "table", undefined, { class: "ranks" });
  const head = make(make(grid, "thead"), "tr");
  make(head, "th", "place at a price of");
  data.prices.forEach(price => make(head, "th", price));
  const ranked = data.prices.map(price => ordered(rows, price).map(row => row.way)), body = make(grid, "tbody");
  for (const { way } of ordered(rows, price)) {
    const line = make(body, "tr");
    make(line, "td", way);
    ranked.forEach(order => make(line, "td", order.indexOf(way) + 1, order[0] === way ? { class: "top" } : {}));
  }
}

function stability(rows, price) {  // share of pairs of ways in the same order at half and at twice the price
  const now = ordered(rows, price).map(row => row.way);
  const kept = other => {
    const then = ordered(rows, other).map(row => row.way);
    let same = 0, all = 0;
    now.forEach((a, i) => now.slice(i + 1).forEach(b => { all += 1; same += then.indexOf(a) < then.indexOf(b); }));
    return all ? `${Math.round(100 * same / all)} %` : "all";
  };
  return `First at this price: ${now[0] ?? "nobody"}. Pairs of ways that keep their order at half the price: ${kept(price / 2)}; at twice: ${kept(price * 2)}.`;
}

function draw() {
  const price = Number(slider.value), parent = document.getElementById("places");
  document.getElementById("shown").textContent = price.toFixed(2);
  parent.replaceChildren();
  for (const [place, rows] of Object.entries(data.places)) {
    const part = make(parent, "section", undefined, { "data-place": place });
    make(part, "h2", place);
    plot(part, place, rows);
    make(part, "p", stability(rows, price), { class: "soft" });
    table(part, place, rows, price);
    if (rows.some(row => row.between)) make(part, "p", "* learned from the percepts between its looks as well.", { class: "soft" });
    const more = make(part, "details", undefined, open[place] ? { open: "" } : {});
    more.ontoggle = () => { open[place] = more.open; };
    make(more, "summary", "Places of the ways at other prices");
    rankTable(more, rows, price);
  }
}
slider.value = data.price;
slider.oninput = draw;
draw();
