"use strict";
// One pane of the page: an episode's arena, clocks and series. `new Pane(...)` builds it, `show(cycle)` moves it.

const SVG = "http://www.w3.org/2000/svg";
const PERIOD_CLASSES = ["p0", "p1", "p2", "p3"];

function svg(tag, attributes, parent) {
  const node = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  parent?.append(node);
  return node;
}

function html(tag, text, parent, attributes = {}) {
  const node = document.createElement(tag);
  node.textContent = text;
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  parent?.append(node);
  return node;
}

const number = (value, digits = 0) => value === null || value === undefined ? "-" : value.toFixed(digits);
const periodClass = (period, periods) => PERIOD_CLASSES[Math.min(3, periods.indexOf(period))];

class Pane {
  constructor(track, world, parent, seek, kind = "") {
    Object.assign(this, { track, world, seek, cursors: [] });
    this.names = Object.keys(track.looks);
    this.box = html("section", "", parent, { class: "pane", "aria-label": track.title });
    html("h2", track.title, this.box);
    html("p", track.said, this.box, { class: "said" });
    const both = html("div", "", this.box, { class: "both" });
    this.arena(html("div", "", both, { class: "arena" }), kind);
    const strips = html("div", "", both, { class: "strips" });
    this.raster(strips);
    const needy = Math.max(...track.needs.map(need => need.deadly ?? Math.max(...need.v)), 1);
    const rich = Math.max(track.full, ...track.energy);
    this.strip(strips, `Needs, 0 to ${number(needy)} UoE`, track.needs.map((need, i) => [need.name, need.v, `s${i % 5}`]),
      0, needy, track.needs.length > 0);
    this.strip(strips, `Energy, 0 to ${number(rich)} UoE; dashes: well-being`, [["energy", track.energy, "s2"]], 0, rich,
      true, [track.well]);
    this.strip(strips, "Wanting and liking, 0 to 1", [["wanting", track.wanting, "w"],
      ...this.names.map((name, i) => [`liking, ${name}`, this.held(name, 6), `l${i % 5}`])], 0, 1, true);
    this.strip(strips, "Safety, 0 to 1", [["where it is", track.safety, "s1"], ["as AVOID saw it", track.held, "l0"]], 0, 1,
      track.safety.some(v => v !== null) || track.held.some(v => v !== null));
    html("p", "The row of each table that the last look used: the value of every period, the chosen one marked", this.box,
      { class: "said" });
    this.table(html("div", "", this.box, { class: "scroll", tabindex: 0, role: "region",
      "aria-label": `Tables of ${track.title}` }));
  }

  // The value of column k of a behaviour's looks, in every cycle until the next look.
  held(name, k) {
    const rows = this.track.looks[name], values = new Array(this.track.n).fill(null);
    rows.forEach((row, i) => values.fill(row[k], row[0], i + 1 < rows.length ? rows[i + 1][0] : this.track.n));
    return values;
  }

  arena(parent, kind) {
    const { width, depth } = this.world, m = 0.15, t = this.track;
    const solids = t.solids ?? this.world.solids;
    const root = svg("svg", { viewBox: `${-m} ${-depth - m} ${width + 2 * m} ${depth + 2 * m}`, role: "img",
      "aria-label": `Arena of ${width} by ${depth} m from above, with the robot, its path and what it senses` }, parent);
    const g = svg("g", { transform: "scale(1,-1)" }, root);
    svg("rect", { x: 0, y: 0, width, height: depth, class: "floor" }, g);
    this.solids = solids.map(solid => {
      const node = svg("rect", { x: -solid.l / 2, y: -solid.w / 2, width: solid.l, height: solid.w,
        class: `solid ${["wall", "obstacle", "food", "water"].includes(solid.kind) ? solid.kind : "other"}`,
        transform: `translate(${solid.x},${solid.y}) rotate(${solid.yaw * 180 / Math.PI})` }, g);
      svg("title", {}, node).textContent = solid.kind;
      return node;
    });
    svg("polyline", { points: this.points(0, t.n), class: `ahead ${kind}` }, g);
    this.behind = svg("polyline", { class: `behind ${kind}` }, g);
    t.meals.forEach(([cycle, need]) => svg("circle", { cx: t.x[cycle], cy: t.y[cycle], r: 0.045,
      class: `meal m${t.needs.findIndex(n => n.name === need)}` }, g));
    this.fan = svg("path", { class: "fan" }, g);
    this.sight = svg("path", { class: "sight" }, g);
    this.robot = svg("g", { class: "robot" }, g);
    svg("circle", { r: 0.25 }, this.robot);
    svg("path", { d: "M-0.14,0L0.2,0M0.1,0.09L0.2,0L0.1,-0.09" }, this.robot);
    if (t.death !== "none") {
      const end = t.n - 1;
      svg("path", { d: "M-0.1,-0.1L0.1,0.1M-0.1,0.1L0.1,-0.1", class: "dead",
        transform: `translate(${t.x[end]},${t.y[end]})` }, g);
    }
    this.scene = g;
  }

  points(from, to) {
    const t = this.track, parts = from === 0 ? [`${t.start[0].toFixed(3)},${t.start[1].toFixed(3)}`] : [];
    for (let i = from; i < to; i++) parts.push(`${t.x[i].toFixed(3)},${t.y[i].toFixed(3)}`);
    return parts.join(" ");
  }

  frame(parent, title, legend, height) {
    const box = html("div", "", parent, { class: "strip" });
    const head = html("p", `${title} `, box, { class: "head" });
    legend.forEach(([name, css]) => html("span", name, head, { class: `key ${css}` }));
    const root = svg("svg", { viewBox: `0 0 ${this.track.most} ${height}`, preserveAspectRatio: "none",
      style: `height:${height}px`, "aria-hidden": "true" }, box);
    root.addEventListener("pointerdown", event => this.drag(event, root));
    root.addEventListener("pointermove", event => { if (event.buttons) this.drag(event, root); });
    return root;
  }

  drag(event, root) {
    const area = root.getBoundingClientRect();
    this.seek(Math.round((event.clientX - area.left) / area.width * this.track.most));
  }

  cursor(root, height) { this.cursors.push(svg("line", { y1: 0, y2: height, class: "cursor" }, root)); }

  raster(parent) {
    const { periods } = this.track, row = 18, height = row * this.names.length;
    const root = this.frame(parent, "Clocks: when each looked, and the period it chose",
      periods.map(p => [`${p}`, periodClass(p, periods)]), height);
    this.names.forEach((name, i) => {
      const paths = {};
      for (const look of this.track.looks[name])
        (paths[periodClass(look[3], periods)] ??= []).push(`M${look[0]},${i * row + 3}v${row - 5}`);
      for (const [css, parts] of Object.entries(paths)) svg("path", { d: parts.join(""), class: `tick ${css}` }, root);
    });
    this.cursor(root, height);
    const names = html("p", "", root.parentNode, { class: "rows" });
    names.textContent = `Rows, from above: ${this.names.join(", ")}`;
  }

  strip(parent, title, series, low, high, there, lines = []) {
    if (!there) return;
    const height = 64, root = this.frame(parent, title, series.map(([name, , css]) => [name, css]), height);
    const y = value => (height - 2 - (value - low) / (high - low) * (height - 4)).toFixed(1);
    lines.forEach(value => svg("line", { x1: 0, x2: this.track.most, y1: y(value), y2: y(value), class: "limit" },
      root));
    series.forEach(([, values, css]) => {
      let path = "", last = null;
      values.forEach((value, i) => {
        if (value === null) { last = null; return; }
        path += `${last === null ? "M" : "L"}${i},${y(value)}`;
        last = value;
      });
      svg("path", { d: path, class: `line ${css}` }, root);
    });
    this.cursor(root, height);
  }

  table(parent) {
    const table = html("table", "", parent), head = html("tr", "", html("thead", "", table));
    for (const text of ["behaviour", "looked", "percept", "level", "was", ...this.track.periods.map(p => `period ${p}`)])
      html("th", text, head, { scope: "col" });
    const body = html("tbody", "", table);
    this.rows = this.names.map(name => {
      const row = html("tr", "", body);
      html("th", name, row, { scope: "row" });
      return Array.from({ length: 4 + this.track.periods.length }, () => html("td", "", row));
    });
  }

  // The index of a behaviour's last look at or before this cycle.
  last(name, cycle) {
    const rows = this.track.looks[name];
    let low = 0, high = rows.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (rows[middle][0] <= cycle) low = middle; else high = middle - 1;
    }
    return low;
  }

  show(cycle) {
    const t = this.track, at = Math.min(cycle, t.n - 1), over = cycle >= t.n;
    const [x, y, h] = at === 0 ? t.start : [t.x[at - 1], t.y[at - 1], t.h[at - 1]];
    const [rx, ry, rh] = over ? [t.x[at], t.y[at], t.h[at]] : [x, y, h];
    this.robot.setAttribute("transform", `translate(${rx},${ry}) rotate(${rh * 180 / Math.PI})`);
    this.behind.setAttribute("points", this.points(0, over ? t.n : at));
    this.fan.setAttribute("d", over ? "" : this.fanPath(t.fans[at], x, y, h));
    this.sight.setAttribute("d", over ? "" : (t.blobs[at] ?? []).map(([, bearing, away]) =>
      `M${x},${y}l${away * Math.cos(h + bearing)},${away * Math.sin(h + bearing)}`).join(""));
    this.cursors.forEach(line => { line.setAttribute("x1", at); line.setAttribute("x2", at); });
    this.names.forEach((name, i) => this.tell(name, this.rows[i], at));
  }

  fanPath(fan, x, y, h) {
    if (!fan) return "";
    const c = Math.cos(h), s = Math.sin(h);
    return fan.map((range, k) => {
      const [sx, sy, a] = this.world.sonars[k];
      return `M${x + c * sx - s * sy},${y + s * sx + c * sy}l${range * Math.cos(h + a)},${range * Math.sin(h + a)}`;
    }).join("");
  }

  tell(name, cells, at) {
    const t = this.track, k = this.last(name, at), look = t.looks[name][k];
    const was = k > 0 ? t.looks[name][k - 1][3] : Math.min(...t.periods);
    const values = t.tables[name]?.[`${look[2]}|${was}|${look[1]}`] ?? [];
    const ago = at - look[0];
    const texts = [ago ? `${ago} ago` : "now", look[1], look[2], was, ...t.periods.map((p, i) =>
      values[i] === undefined ? "-" : number(values[i], 2))];
    cells.forEach((cell, i) => {
      cell.textContent = texts[i];
      const chosen = i >= 4 && t.periods[i - 4] === look[3];
      cell.className = (i >= 4 ? "n" : "") + (chosen ? " chosen" : "") + (i === 0 && !ago ? " now" : "");
      if (chosen) cell.setAttribute("aria-label", `${texts[i]}, chosen`); else cell.removeAttribute("aria-label");
    });
  }

  // This cycle in words.
  words(cycle) {
    const t = this.track, at = Math.min(cycle, t.n - 1);
    if (cycle >= t.n) return t.death === "none" ? "The episode is over; the robot lives." : `The robot died: ${t.death}.`;
    const active = this.names.filter(name => t.looks[name][this.last(name, at)][0] === at);
    const heard = t.fans[at] ? ` Nearest sonar echo ${Math.min(...t.fans[at]).toFixed(2)} m.` : "";
    const solids = t.solids ?? this.world.solids;
    const seen = (t.blobs[at] ?? []).map(b => solids[b[0]].kind);
    const meal = t.meals.filter(m => m[0] === at).map(m => m[1] === "thirst" ? "It drinks." : "It eats.").join(" ");
    return `${active.length ? active.join(", ") + (active.length > 1 ? " look." : " looks.") : "Nobody looks."}${heard}`
      + `${seen.length ? ` In view: ${seen.join(", ")}.` : ""} ${meal} ${t.needs.map(n =>
        `${n.name} ${number(n.v[at])}`).join(", ")}${t.needs.length ? ", " : ""}energy ${number(t.energy[at])}.`;
  }
}
