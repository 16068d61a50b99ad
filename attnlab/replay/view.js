"use strict";
// The page: panes that scrub together, keys and buttons, and what-if.

const data = JSON.parse(document.getElementById("data").textContent);
const $ = id => document.getElementById(id);
const most = Math.max(...data.tracks.map(t => t.most));
let cycle = 0, playing = null, panes = [], changes = [];

function build() {
  $("panes").replaceChildren();
  panes = data.tracks.map((track, i) => new Pane(track, data.world[i], $("panes"), seek));
  if (data.what) panes.push(new Pane(data.what, data.world[0], $("panes"), seek, "what"));
  $("panes").className = panes.length > 1 ? "two" : "one";
  if (data.tracks[0].model) panes[0].solids.forEach((node, i) => draggable(node, i));
}

function seek(to) {
  cycle = Math.max(0, Math.min(most, to));
  panes.forEach(pane => pane.show(cycle));
  $("scrub").value = cycle;
  $("scrub").setAttribute("aria-valuetext", `cycle ${cycle} of ${most}`);
  $("at").textContent = `cycle ${cycle} of ${most}, ${(cycle * data.tracks[0].dt).toFixed(1)} s`;
  if (!playing) say();
}

function say() {
  const many = panes.length > 1;
  $("words").textContent = panes.map(p => (many ? `${p.track.title}: ` : "") + p.words(cycle)).join(" ");
}

function play(on = !playing) {
  if (on === Boolean(playing)) return;
  if (playing) { cancelAnimationFrame(playing.frame); playing = null; say(); } else {
    if (cycle >= most) seek(0);
    playing = { from: performance.now(), at: cycle };
    const step = now => {
      const rate = Number($("speed").value) / data.tracks[0].dt / 1000;
      playing.at += (now - playing.from) * rate;
      playing.from = now;
      if (Math.floor(playing.at) !== cycle) seek(Math.floor(playing.at));
      if (cycle >= most) play(false); else playing.frame = requestAnimationFrame(step);
    };
    playing.frame = requestAnimationFrame(step);
  }
  $("play").textContent = playing ? "Pause" : "Play";
}

// The cycles of every pane at which something of this kind happens.
function moments(kind) {
  const all = panes.flatMap(({ track: t }) => {
    if (kind === "meal") return t.meals.map(m => m[0]);
    if (kind === "death") return t.death === "none" ? [] : [t.n];
    return Object.values(t.looks).flatMap(rows => rows.filter((row, i) =>
      i > 0 && row[6] >= data.surprising && row[1] !== rows[i - 1][1]).map(row => row[0]));
  });
  return [...new Set(all)].sort((a, b) => a - b);
}

function jump(kind, back) {
  play(false);
  const all = moments(kind), to = back ? all.reverse().find(c => c < cycle) : all.find(c => c > cycle);
  if (to !== undefined) seek(to);
  else $("words").textContent = `There is no ${back ? "earlier" : "later"} ${kind}.`;
}

const KEYS = { " ": () => play(), ArrowLeft: e => seek(cycle - (e.shiftKey ? 10 : 1)),
  ArrowRight: e => seek(cycle + (e.shiftKey ? 10 : 1)), Home: () => seek(0), End: () => seek(most),
  m: () => jump("meal"), M: () => jump("meal", true), d: () => jump("death"), s: () => jump("surprise"),
  S: () => jump("surprise", true) };
document.addEventListener("keydown", event => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches("select, input[type=number]")) return;
  if (event.key === " " && event.target.matches("button, summary")) return;
  if (event.target.matches("input[type=range]") && event.key !== " " && event.key.length > 1 && !event.shiftKey) return;
  const act = KEYS[event.key];
  if (act) { event.preventDefault(); act(event); }
});
$("play").addEventListener("click", () => play());
$("scrub").addEventListener("input", event => { play(false); seek(Number(event.target.value)); });
$("back").addEventListener("click", () => seek(cycle - 1));
$("on").addEventListener("click", () => seek(cycle + 1));
for (const kind of ["meal", "death", "surprise"]) $(kind).addEventListener("click", () => jump(kind));
window.addEventListener("hashchange", fromHash);

function fromHash() {
  const found = /cycle=(\d+)/.exec(location.hash);
  if (found) seek(Number(found[1]));
}

// What if.

function whatIf() {
  const t = data.tracks[0];
  if (!changes.length) data.what = null;
  else {
    const lived = liveEpisode(t.model, data.world[0].solids, changes);
    data.what = { ...t, ...lived, needs: t.needs.map((need, i) => ({ ...need, v: lived.needs[
      t.model.body.needs.findIndex(n => n.name === need.name)] })), title: "What if",
    said: `${changes.map(told).join("; ")}: ${lived.n} cycles, ${lived.meals.length} meals, `
      + (lived.death === "none" ? "it lives." : `it dies (${lived.death}).`) };
  }
  $("changes").replaceChildren(...changes.map((change, i) => {
    const item = html("li", `${told(change)} `, null);
    html("button", "take back", item, { type: "button" }).addEventListener("click", () => {
      changes.splice(i, 1);
      whatIf();
    });
    return item;
  }));
  build();
  seek(cycle);
}

function told(c) {
  const from = `from cycle ${c.at} on`, solid = data.world[0].solids[c.solid];
  if (c.what === "period") return c.period === null ? `${c.behaviour} as learned ${from}`
    : `${c.behaviour} every ${c.period} ${from}`;
  if (c.what === "need" || c.what === "energy") return `${c.need ?? "energy"} is ${c.value} at cycle ${c.at}`;
  return c.what === "away" ? `${solid.kind} ${c.solid} is gone ${from}`
    : `${solid.kind} ${c.solid} at (${c.x.toFixed(2)}, ${c.y.toFixed(2)}) ${from}`;
}

function add(change) { play(false); changes.push({ at: Math.min(cycle, data.tracks[0].n - 1), ...change }); whatIf(); }

function draggable(node, i) {
  if (data.world[0].solids[i].kind === "wall") return;
  node.classList.add("movable");
  node.addEventListener("pointerdown", event => {
    const root = node.ownerSVGElement, back = panes[0].scene.getScreenCTM().inverse();
    const place = e => new DOMPoint(e.clientX, e.clientY).matrixTransform(back);
    const move = e => { const p = place(e); node.setAttribute("transform", `translate(${p.x},${p.y})`); };
    const drop = e => {
      root.removeEventListener("pointermove", move);
      const p = place(e);
      add({ what: "move", solid: i, x: p.x, y: p.y });
    };
    root.addEventListener("pointermove", move);
    root.addEventListener("pointerup", drop, { once: true });
    event.preventDefault();
  });
}

function form() {
  const t = data.tracks[0], { solids } = data.world[0], choice = $("choice"), value = $("value");
  const options = [...t.model.behaviours.map(b => [`period of ${b.name}`, "period", { behaviour: b.name }]),
    ...t.needs.map(n => [n.name, "need", { need: n.name }]), ["energy", "energy", {}],
    ...solids.flatMap((s, i) => s.kind === "wall" ? [] : [[`${s.kind} ${i}: move`, "move", { solid: i }],
      [`${s.kind} ${i}: take away`, "away", { solid: i }]])];
  options.forEach(([text], i) => html("option", text, choice, { value: i }));
  const fields = () => {
    const [, what, about] = options[Number(choice.value)];
    value.replaceChildren();
    const label = (text, node) => { const l = html("label", `${text} `, value); l.append(node); };
    if (what === "period") {
      const select = html("select", "", null, { id: "v" });
      [...t.periods, "as learned"].forEach(p => html("option", p, select));
      label("to", select);
    } else if (what === "move") {
      label("x, m", html("input", "", null, { id: "vx", type: "number", step: 0.05, value: solids[about.solid].x.toFixed(2) }));
      label("y, m", html("input", "", null, { id: "vy", type: "number", step: 0.05, value: solids[about.solid].y.toFixed(2) }));
    } else if (what !== "away") label("to, UoE", html("input", "", null, { id: "v", type: "number", step: 50, value: 1000 }));
  };
  choice.addEventListener("change", fields);
  $("whatform").addEventListener("submit", event => {
    event.preventDefault();
    const [, what, about] = options[Number(choice.value)];
    if (what === "period") add({ what, ...about, period: $("v").value === "as learned" ? null : Number($("v").value) });
    else if (what === "move") add({ what, ...about, x: Number($("vx").value), y: Number($("vy").value) });
    else add({ what, ...about, value: what === "away" ? 0 : Number($("v").value) });
  });
  fields();
}

function checkItself() {
  const t = data.tracks[0];
  if (!t.model) { $("check").textContent = `There is no what-if here: ${t.why}.`; return; }
  const found = compare(liveEpisode(t.model, data.world[0].solids, []), t);
  const fine = found.same && found.pose_m < 1e-9;
  $("check").dataset.pose = found.pose_m;
  $("check").dataset.same = found.same;
  $("check").textContent = fine ? `This page lived the episode by itself and came within ${found.pose_m.toExponential(0)} `
    + "m of the record, with the same clocks, percepts, meals and end." : "There is no what-if in this browser: it did "
    + "not live the episode as it was recorded.";
  if (fine) { form(); $("whatform").hidden = false; }
}

$("scrub").max = most;
$("controls").hidden = $("whatif").hidden = false;
build();
seek(0);
fromHash();
setTimeout(checkItself, 0);
