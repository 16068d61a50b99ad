"use strict";
// A validation episode lived in the page: the machine cycle of attnlab/cycle.py with AVOID, EAT and DRINK, needs, energy
// and clocks, from the state in which the recorded episode began. A test holds it to the original.

class Larder {
  constructor(reading, body) {
    this.r = reading; this.eaten = {}; this.following = body.following;
    this.fullAgain = Object.fromEntries(body.empty.map(solid => [solid, reading.max_cycles + 1]));
  }
  has(solid, cycle) { return this.r.food_supply === "endless" || cycle >= (this.fullAgain[solid] ?? 0); }
  take(solid, cycle) {
    if (this.r.food_supply === "endless") return;
    this.eaten[solid] = (this.eaten[solid] ?? 0) + 1;
    if (this.eaten[solid] % this.r.food_portions !== 0) return;
    this.fullAgain[solid] = this.r.food_supply === "respawn" ? cycle + this.r.food_respawn_cycles
      : this.r.max_cycles + 1;
    if (this.r.food_supply === "wandering") this.fullAgain[this.following[solid]] = cycle;
  }
}

class Body {
  constructor(model) {
    const { body, reading } = model;
    Object.assign(this, { needs: body.needs, eU: body.e_u, eNb: body.e_nb, energy: body.energy, r: reading });
    this.values = this.needs.map(need => need.start);
    this.eaten = this.needs.map(() => 0);
    this.larder = new Larder(reading, body);
  }
  index(name) { return this.needs.findIndex(need => need.name === name); }
  need(name) { return this.values[this.index(name)]; }
  floor(need) { return this.r.needs_floored ? Math.max(0, need) : need; }
  clip(energy) { return this.r.energy_clipped ? Math.min(energy, this.r.energy_max) : energy; }
  fed() { return this.needs.reduce((sum, need, i) => need.feeds_energy ? sum + this.eaten[i] : sum, 0); }
  untilDeath(active, cycles) {
    for (const [i, need] of this.needs.entries()) {
      if (need.death_at === null) continue;
      const left = need.death_at - this.floor(this.values[i] + need.per_activation * active - this.eaten[i]);
      if (left - need.per_cycle <= 0) return 1;
      if (need.per_cycle > 0) cycles = Math.min(cycles, Math.ceil(left / need.per_cycle));
    }
    if (this.r.energy_death) {
      const left = this.clip(this.energy - 0 - this.eNb * active + this.fed()) - this.r.energy_min;
      if (left - this.eU < 0) return 1;
      if (this.eU > 0) cycles = Math.min(cycles, Math.trunc(left / this.eU) + 1);
    }
    return cycles;
  }
  live(active, cycles) {
    const fed = this.fed();
    this.needs.forEach((need, i) => {
      this.values[i] = this.floor(this.values[i] + need.per_activation * active - this.eaten[i])
        + need.per_cycle * cycles;
    });
    this.energy = this.r.energy_clipped
      ? this.clip(this.energy - 0 - this.eNb * active + fed) - this.eU * cycles
      : this.energy - this.eU * cycles - this.eNb * active + fed;
    this.eaten.fill(0);
    const dead = this.needs.findIndex((need, i) => need.death_at !== null && this.values[i] >= need.death_at);
    if (dead >= 0) return this.needs[dead].name;
    return this.r.energy_death && this.energy < this.r.energy_min ? "energy" : null;
  }
}

// AVOID's motor schema; `self` holds its settings and the side it keeps to.
function avoidCommand(self, heard, r) {
  const near = Math.min(...heard);
  const v = r.v_max_m_s * Math.min(1, Math.max(0, (near - self.stop_m) / (self.high - self.stop_m)));
  let w = 0;
  heard.forEach((d, k) => { if (d < self.active_m) w += self.turns[k]; });
  if (Math.min(...heard.slice(2, 6)) >= self.blocked_m || r.turn_rule === "sum") { self.side = 0; return [v, w]; }
  if (self.side === 0) self.side = w < 0 ? -1 : 1;
  return [v, self.side * r.w_max_rad_s];
}

// EAT's and DRINK's motor schema.
function forageCommand(self, seen, robot) {
  const { r, body, cycle } = robot, p = self.params;
  if (!seen.length) {
    if (cycle >= self.searchUntil) {
      self.searchUntil = cycle + p.search_cycles;
      self.direction = self.draw.uniform(-Math.PI, Math.PI);
    }
    const error = wrap(self.direction - robot.pose[2]), limit = p.search_turn_rad_s;
    return [r.v_max_m_s, Math.min(limit, Math.max(-limit, error))];
  }
  const blob = seen.reduce((best, b) => b.height > best.height ? b : best);
  if (blob.distance < r.food_reach_m && cycle >= self.nextMeal) {
    body.eaten[body.index(self.need)] += p.power;
    body.larder.take(blob.solid, cycle);
    robot.meals.push([cycle, self.need]);
    self.nextMeal = cycle + r.meal_interval_cycles;
  }
  self.searchUntil = -1;
  const ahead = Math.min(1, Math.max(0, (blob.distance - p.rest_m) / (p.slow_m - p.rest_m)));
  return [r.v_max_m_s * ahead, p.turn_gain * blob.bearing];
}

// One look of behaviour `self`: percept, liking, the next period, the next command. Adds a row to its looks.
function look(self, robot, model) {
  const { r, cycle, body } = robot;
  const raw = self.kind === "avoid" ? Math.min(...robot.front()) : body.need(self.need);
  const sigma = Math.min(self.high, Math.max(self.low, raw));
  const percept = Math.min(model.bins - 1, Math.max(0,
    Math.trunc((sigma - self.low) / (self.high - self.low) * model.bins)));
  const wanting = !model.curious || body.energy < r.energy_well ? 0
    : Math.min(1, (body.energy - r.energy_well) / (r.energy_max - r.energy_well));
  let visits = self.memory.filter(p => p === percept).length;
  if (r.novelty_counts_current)
    visits += 1 - (self.memory.length === r.novelty_window && self.memory[0] === percept ? 1 : 0);
  const liking = 1 - visits / r.novelty_window;
  const level = !model.curious || wanting <= 0 ? 0 : liking > 0.5 ? 2 : 1;
  const row = self.values[(level * model.periods.length + self.action) * model.bins + percept];
  self.action = self.pinned !== null ? model.periods.indexOf(self.pinned) : row.indexOf(Math.max(...row));
  self.memory.push(percept);
  if (self.memory.length > r.novelty_window) self.memory.shift();
  self.period = model.periods[self.action];
  self.due = cycle + self.period;
  const released = self.kind === "avoid" || body.need(self.need) >= r.releaser_threshold;
  self.command = !released ? null : self.kind === "avoid" ? avoidCommand(self, robot.front(), r)
    : forageCommand(self, robot.blobs(self.source), robot);
  robot.looks[self.name].push([cycle, percept + 1, model.levels[level], self.period, sigma, wanting, liking,
    released ? 1 : 0]);
  return released || r.active === "fired" ? 1 : 0;
}

function fuse(commands, r) {
  if (!commands.length) return [0, 0];
  let v = r.v_max_m_s, w = 0;
  for (const [speed, turn] of commands) { v = Math.min(v, speed); w += turn; }
  return [Math.max(0, v), Math.min(r.w_max_rad_s, Math.max(-r.w_max_rad_s, w))];
}

// The sensors of the robot, read when they are asked for and once a cycle; what was read is kept for the page.
class Robot {
  constructor(model, solids) {
    Object.assign(this, { model, r: model.reading, cycle: 0, pose: model.start.slice(), meals: [], fans: {}, seen: {} });
    this.body = new Body(model);
    this.looks = Object.fromEntries(model.behaviours.map(b => [b.name, []]));
    this.selves = model.behaviours.map(b => ({ ...b, stop_m: b.stop_m, due: 0, action: model.periods.indexOf(
      Math.min(...model.periods)), command: null, memory: model.persists ? b.memory.slice() : [], pinned: b.fixed,
      side: 0, nextMeal: 0, searchUntil: -1, direction: 0, draw: new Twister(b.stream) }));
    this.stand(solids);
  }
  stand(solids) { this.solids = solids; this.boxes = this.model.order.map(i => boxOf(solids[i])); }
  front() {
    const m = this.model;
    this.fans[this.cycle] ??= sonar(this.pose, this.boxes, m.beams, 8, m.reach, m.shortest);
    return fromCentre(this.fans[this.cycle], m.sonars);
  }
  blobs(kind) {
    const m = this.model;
    this.seen[this.cycle] ??= blobs(this.pose, this.boxes, m.cubes, m.camera).map(b => ({ ...b, solid: m.order[b.box] }));
    return this.seen[this.cycle].filter(b => this.solids[b.solid].kind === kind
      && this.body.larder.has(b.solid, this.cycle));
  }
  crashed() {
    const m = this.model;
    if (touches(this.pose[0], this.pose[1], this.boxes, m.radius)) return true;
    return m.safety > 0 && Math.min(...fromCentre(sonar(this.pose, this.boxes, m.beams, 8, m.reach, m.shortest),
      m.sonars)) < m.safety;
  }
}

// The track of the episode with `changes` ({at, what: "period" | "need" | "energy" | "move" | "away", ...}) made as soon
// as cycle `at` begins; without any it is the recorded one.
function liveEpisode(model, solids, changes) {
  let here = solids.map(solid => ({ ...solid }));
  const robot = new Robot(model, here), { body, selves } = robot, todo = changes.slice().sort((a, b) => a.at - b.at);
  const track = { x: [], y: [], h: [], energy: [], wanting: [], safety: [], held: [], needs: body.needs.map(() => []) };
  const guard = selves.find(self => self.kind === "avoid"), first = robot.looks[selves[0].name];
  const longest = Math.max(...model.periods), shortest = Math.min(...model.periods);
  let death = null;
  while (death === null && robot.cycle < model.most) {
    while (todo.length && todo[0].at <= robot.cycle) here = change(robot, here, todo.shift());
    let active = 0, idleUntil = todo.length ? Math.min(model.most, todo[0].at) : model.most;
    const held = [];
    for (const self of selves) {
      if (self.due === robot.cycle) active += look(self, robot, model);
      idleUntil = Math.min(idleUntil, self.due);
      if (self.command !== null) held.push(self.command);
    }
    const [v, w] = fuse(held, robot.r), most = body.untilDeath(active, idleUntil - robot.cycle), from = track.x.length;
    let moved = 0, crash = false;
    while (moved < most && !crash) {
      robot.pose = arc(robot.pose, v, w, model.dt);
      moved++;
      crash = robot.crashed();
      track.x.push(robot.pose[0]); track.y.push(robot.pose[1]); track.h.push(robot.pose[2]);
      track.wanting.push(first[first.length - 1][5]);
      if (guard && longest > shortest) {
        const away = Math.min(...robot.boxes.map(box => distance(robot.pose[0], robot.pose[1], box)));
        const share = (longest - guard.period) / (longest - shortest), last = robot.looks[guard.name];
        track.safety.push(Math.min(away, guard.high) / guard.high * share);
        track.held.push(last[last.length - 1][4] / guard.high * share);
      } else { track.safety.push(null); track.held.push(null); }
    }
    robot.cycle += moved;
    const cause = body.live(active, moved);
    death = crash ? "crash" : cause;
    for (let i = from; i < track.x.length; i++) {
      const left = track.x.length - 1 - i;
      track.energy.push(body.energy + body.eU * left);
      body.needs.forEach((need, k) => track.needs[k].push(body.values[k] - need.per_cycle * left));
    }
  }
  const blobsOf = Object.fromEntries(Object.entries(robot.seen).map(([cycle, seen]) =>
    [cycle, seen.map(b => [b.solid, b.bearing, b.distance, b.height])]));
  return { ...track, n: track.x.length, death: death ?? "none", looks: robot.looks, fans: robot.fans, blobs: blobsOf,
    meals: robot.meals, solids: here };
}

function change(robot, solids, { what, behaviour, period, need, value, solid, x, y }) {
  const self = robot.selves.find(s => s.name === behaviour);
  if (what === "period") self.pinned = period === null ? self.fixed : period;
  if (what === "need") robot.body.values[robot.body.index(need)] = value;
  if (what === "energy") robot.body.energy = value;
  if (what === "move") solids = solids.map((s, i) => i === solid ? { ...s, x, y } : s);
  if (what === "away") solids = solids.map((s, i) => i === solid ? { ...s, x: -1000, y: -1000 } : s);
  robot.stand(solids);
  return solids;
}

// How far the page's own life of the recorded episode is from the record: {pose_m, same: is all the rest alike?}.
function compare(lived, track) {
  let far = lived.n === track.n ? 0 : Infinity;
  for (let i = 0; i < Math.min(lived.n, track.n); i++)
    far = Math.max(far, Math.hypot(lived.x[i] - track.x[i], lived.y[i] - track.y[i]));
  const short = looks => JSON.stringify(Object.values(looks).map(rows => rows.map(row => row.slice(0, 4))));
  const same = lived.death === track.death && short(lived.looks) === short(track.looks)
    && JSON.stringify(lived.meals.slice().sort((a, b) => a[0] - b[0] || (a[1] < b[1] ? -1 : 1)))
      === JSON.stringify(track.meals);
  return { pose_m: far, same };
}
