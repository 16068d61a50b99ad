"use strict";
// The plane of attnlab/kernels/planar.py once more: sonar, camera, motion and contact, with the same arithmetic. A test
// holds it to the original. boxes: rows of [x, y, cos, sin, half length, half width, radius]; lengths in m.

const mod = (a, n) => { const r = a % n; return r !== 0 && (r < 0) !== (n < 0) ? r + n : r; };
const wrap = angle => mod(angle + Math.PI, 2 * Math.PI) - Math.PI;

function boxOf(solid) {
  const a = solid.l / 2, b = solid.w / 2;
  return [solid.x, solid.y, Math.cos(solid.yaw), Math.sin(solid.yaw), a, b, Math.hypot(a, b)];
}

// Where the line from (x, y), relative to the box's centre, along (dx, dy) enters and leaves it.
function crossing(x, y, dx, dy, box) {
  const [, , c, s, a, b] = box, px = c * x + s * y, py = c * y - s * x, qx = c * dx + s * dy, qy = c * dy - s * dx;
  let enters = -Infinity, leaves = Infinity;
  if (qx !== 0) {
    const one = (-a - px) / qx, two = (a - px) / qx;
    enters = Math.min(one, two); leaves = Math.max(one, two);
  } else if (Math.abs(px) > a) return [Infinity, -Infinity];
  if (qy !== 0) {
    const one = (-b - py) / qy, two = (b - py) / qy;
    enters = Math.max(enters, Math.min(one, two)); leaves = Math.min(leaves, Math.max(one, two));
  } else if (Math.abs(py) > b) return [Infinity, -Infinity];
  return enters <= leaves ? [enters, leaves] : [Infinity, -Infinity];
}

// Ranges (m, from the ring) of the first `count` sonars of a robot at pose [x, y, heading].
function sonar(pose, boxes, beams, count, reach, shortest) {
  const [x, y] = pose, c = Math.cos(pose[2]), s = Math.sin(pose[2]), ranges = [];
  for (let k = 0; k < count; k++) {
    const [fx, fy, cx, sx, foot] = beams[k];
    const ox = x + c * fx - s * fy, oy = y + s * fx + c * fy, dx = c * cx - s * sx, dy = s * cx + c * sx;
    let nearest = foot + reach;
    for (const box of boxes) {
      const rx = box[0] - ox, ry = box[1] - oy, round = box[6];
      if (Math.abs(dx * ry - dy * rx) > round || dx * rx + dy * ry + round < 0) continue;
      const [enters, leaves] = crossing(-rx, -ry, dx, dy, box);
      if (enters >= 0) nearest = Math.min(nearest, enters);
      else if (leaves >= 0) nearest = Math.min(nearest, leaves);
    }
    ranges.push(Math.max(nearest - foot, shortest));
  }
  return ranges;
}

// Distances of the echoes from the robot's centre.
function fromCentre(ranges, sonars) {
  return ranges.map((r, k) => {
    const [x, y, a] = sonars[k];
    return Math.hypot(r + (x * Math.cos(a) + y * Math.sin(a)), Math.abs(-x * Math.sin(a) + y * Math.cos(a)));
  });
}

function arc(pose, v, w, dt) {
  const [x, y, heading] = pose, turn = w * dt, after = heading + turn;
  if (-1e-9 < turn && turn < 1e-9)
    return [x + v * dt * Math.cos(heading), y + v * dt * Math.sin(heading), wrap(after)];
  const radius = v / w;
  return [x + radius * (Math.sin(after) - Math.sin(heading)), y - radius * (Math.cos(after) - Math.cos(heading)),
    wrap(after)];
}

// From a point to a box; 0 inside.
function distance(x, y, box) {
  const dx = x - box[0], dy = y - box[1];
  return Math.hypot(Math.max(Math.abs(box[2] * dx + box[3] * dy) - box[4], 0),
    Math.max(Math.abs(box[2] * dy - box[3] * dx) - box[5], 0));
}

function touches(x, y, boxes, radius) {
  return boxes.some(box => {
    const dx = x - box[0], dy = y - box[1];
    const along = Math.abs(box[2] * dx + box[3] * dy) - box[4], across = Math.abs(box[2] * dy - box[3] * dx) - box[5];
    return along <= radius && across <= radius
      && Math.max(along, 0) ** 2 + Math.max(across, 0) ** 2 <= radius * radius;
  });
}

// First and one past the last image column that can meet a box; all of them if part of it is not ahead.
function span(box, x, y, c, s, columns, focal) {
  let low = Infinity, high = -Infinity, behind = 0;
  for (let corner = 0; corner < 4; corner++) {
    const along = corner < 2 ? box[4] : -box[4], across = corner % 2 === 0 ? box[5] : -box[5];
    const gx = box[0] + box[2] * along - box[3] * across - x, gy = box[1] + box[3] * along + box[2] * across - y;
    const ahead = c * gx + s * gy;
    if (ahead < 1e-6) behind++;
    else {
      const column = columns / 2 - focal * (c * gy - s * gx) / ahead;
      low = Math.min(low, column); high = Math.max(high, column);
    }
  }
  if (behind === 4 || (behind === 0 && (high < 0 || low > columns))) return [0, 0];
  if (behind > 0) return [0, columns];
  return [Math.trunc(Math.max(low - 1, 0)), Math.trunc(Math.min(high + 1, columns))];
}

function pixelRows(half, rows) {
  if (half >= rows / 2) return rows;
  return rows % 2 === 0 ? 2 * Math.floor(half + 0.5) : 2 * Math.floor(half) + 1;
}

// Blobs of the camera, in the order of the boxes: [{box, bearing, height, distance}]. The first `cubes` boxes make
// blobs, the others only hide.
function blobs(pose, boxes, cubes, camera) {
  const [x, y] = pose, c = Math.cos(pose[2]), s = Math.sin(pose[2]), { columns, rows, focal, half } = camera;
  const depths = new Array(columns).fill(Infinity), owner = new Array(columns).fill(-1);
  boxes.forEach((box, b) => {
    const [first, last] = span(box, x, y, c, s, columns, focal);
    for (let column = first; column < last; column++) {
      if (b >= cubes && owner[column] < 0) continue;
      const left = (columns / 2 - column - 0.5) / focal;
      const [depth] = crossing(x - box[0], y - box[1], c - s * left, s + c * left, box);
      if (depth >= 0 && depth < depths[column]) { depths[column] = depth; owner[column] = b; }
    }
  });
  const seen = [];
  for (let b = 0; b < cubes; b++) {
    let sum = 0, height = 0, area = 0;
    for (let column = 0; column < columns; column++) {
      if (owner[column] !== b) continue;
      const tall = pixelRows(focal * half / depths[column], rows);
      sum += tall * (column + 0.5); height = Math.max(height, tall); area += tall;
    }
    if (area > 0) {
      const bearing = Math.atan2(columns / 2 - sum / area, focal);
      seen.push({ box: b, bearing, height, distance: focal * 0.5 / height / Math.cos(bearing) });
    }
  }
  return seen;
}

// Python's random.Random from its state (624 words and an index).
class Twister {
  constructor(state) { this.words = Uint32Array.from(state.slice(0, 624)); this.at = state[624]; }
  word() {
    const mt = this.words;
    if (this.at >= 624) {
      for (let k = 0; k < 624; k++) {
        const y = (mt[k] & 0x80000000) | (mt[(k + 1) % 624] & 0x7fffffff);
        mt[k] = mt[(k + 397) % 624] ^ (y >>> 1) ^ (y & 1 ? 0x9908b0df : 0);
      }
      this.at = 0;
    }
    let y = mt[this.at++];
    y ^= y >>> 11; y ^= (y << 7) & 0x9d2c5680; y ^= (y << 15) & 0xefc60000; y ^= y >>> 18;
    return y >>> 0;
  }
  random() { const a = this.word() >>> 5, b = this.word() >>> 6; return (a * 67108864 + b) / 9007199254740992; }
  uniform(low, high) { return low + (high - low) * this.random(); }
}
