"use strict";
const data = JSON.parse(document.getElementById("data").textContent), slider = document.getElementById("price");
const SVG = "http://www.w3.org/2000/svg", percent = x => (100 * x).toFixed(1);
const able = rows => rows.filter(row => !row.way.startsWith("("));
const scored = (row, price) => row.harm[0] + price * row.looks[0];
const order = {};  // by place: [column, direction]

function make(parent, tag, text, attributes = {}, space) {
  const node = space ? document.createElementNS(space, tag) : document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  if (text !== undefined) node.textContent = text;
  parent.appendChild(node);
  return node;
}

function columns(rows, price) {
  const details = [...new Set(rows.flatMap(row => Object.keys(row.detail)))];
  return [
    ["way", row => row.way + (row.between ? " *" : ""), row => row.way],
    ["looks %", row => `${percent(row.looks[0])} ± ${percent(row.looks[1])}`, row => row.looks[0]],
    ["harm %", row => `${percent(row.harm[0])} ± ${percent(row.harm[1])}`, row => row.harm[0]],
    ["score", row => scored(row, price).toFixed(3), row => scored(row, price)],
    ["saved at equal looks", row => row.saved ? `${percent(row.saved[0])} ± ${percent(row.saved[1])}` : "",
      row => row.saved ? -row.saved[0] : Infinity],
    ["", row => row.verdict, row => row.verdict],
    ["front", row => row.front ? "yes" : "", row => row.front ? 0 : 1],
    ...details.map(name => [name, row => (row.detail[name] ?? NaN).toFixed(2), row => row.detail[name] ?? Infinity])];
}

function table(parent, place, rows, price) {
  const cells = columns(rows, price), [column, direction] = order[place] ?? ["score", 1];
  const [, , key] = cells.find(([name]) => name === column) ?? cells[3];
  const sorted = [...rows].sort((a, b) => {
    const x = key(a), y = key(b);
    return direction * (x < y ? -1 : x > y ? 1 : a.way < b.way ? -1 : 1);
  });
  const grid = make(parent, "table"), head = make(make(grid, "thead"), "tr"), body = make(grid, "tbody");
  for (const [name] of cells) {
    const button = make(make(head, "th"), "button", name || "verdict");
    button.onclick = () => { order[place] = [name, column === name ? -direction : 1]; draw(); };
  }
  for (const row of sorted) {
    const line = make(body, "tr");
    cells.forEach(([name, shown]) => make(line, "td", shown(row), name === "" ? { class: row.verdict } : {}));
  }
}

function plot(parent, place, rows) {
  const width = 900, height = 300, top = Math.max(...rows.map(row => row.harm[0] + row.harm[1])) || 1;
  const x = looks => 50 + (width - 80) * looks, y = harm => height - 30 - (height - 50) * harm / top;
  const svg = make(parent, "svg", undefined, { viewBox: `0 0 ${width} ${height}`, role: "img",
    "aria-label": `Looks against harm in ${place}; the Pareto front in orange` }, SVG);
  make(svg, "path", undefined, { d: `M50 10V${height - 30}H${width - 30}`, class: "axis", fill: "none" }, SVG);
  make(svg, "text", "looks a cycle, 0 to 1", { x: width / 2, y: height - 6 }, SVG);
  make(svg, "text", `harm, up to ${percent(top)} %`, { x: 54, y: 12 }, SVG);
  for (const row of rows) {
    const [cx, cy] = [x(row.looks[0]), y(row.harm[0])];
    make(svg, "path", undefined, { class: "bar", d: `M${cx} ${y(row.harm[0] - row.harm[1])}V${y(row.harm[0] + row.harm[1])}` +
      `M${x(row.looks[0] - row.looks[1])} ${cy}H${x(row.looks[0] + row.looks[1])}` }, SVG);
    const dot = make(svg, "circle", undefined, { cx, cy, r: 4, class: row.front ? "front" : "dot" }, SVG);
    make(dot, "title", row.way, {}, SVG);
    make(svg, "text", row.way, row.looks[0] > 0.85 ? { x: cx - 6, y: cy - 4, "text-anchor": "end" }
      : { x: cx + 6, y: cy - 4 }, SVG);
  }
}

function rankTable(parent, rows) {
  const grid = make(parent, "table", undefined, { class: "ranks" }), head = make(make(grid, "thead"), "tr");
  make(head, "th", "place at a price of");
  data.prices.forEach(price => make(head, "th", price));
  const ranked = data.prices.map(price => able(rows).sort((a, b) => scored(a, price) - scored(b, price) ||
    (a.way < b.way ? -1 : 1)).map(row => row.way));
  const body = make(grid, "tbody");
  for (const way of ranked[5]) {
    const line = make(body, "tr");
    make(line, "td", way);
    ranked.forEach(order => make(line, "td", order.indexOf(way) + 1));
  }
}

function draw() {
  const price = Number(slider.value), parent = document.getElementById("places");
  document.getElementById("shown").textContent = price.toFixed(2);
  parent.replaceChildren();
  for (const [place, rows] of Object.entries(data.places)) {
    make(parent, "h2", place);
    plot(parent, place, rows);
    table(parent, place, rows, price);
    const more = make(parent, "details");
    make(more, "summary", "Places of the ways at other prices");
    rankTable(more, rows);
  }
}
slider.value = data.price;
slider.oninput = draw;
draw();
