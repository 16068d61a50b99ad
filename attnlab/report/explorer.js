"use strict";
// Draws the specification curve of any comparison in any order; the page shows one without it.
(function () {
  var home = document.getElementById("spec"), data = JSON.parse(document.getElementById("spec-data").textContent);
  var which = home.querySelector("[name=which]"), by = home.querySelector("[name=by]");
  var said = document.getElementById("spec-said"), seen = document.getElementById("spec-seen"), order = [];

  function within(d) { return Math.max(-data.limit, Math.min(data.limit, d)); }

  function draw() {
    var m = data.curves[which.value], factor = data.factors[by.value];
    order = m.d.map(function (_, i) { return i; }).filter(function (i) { return m.d[i] !== null; });
    order.sort(function (a, b) {
      return (factor ? factor.of[a] - factor.of[b] : 0) || m.d[a] - m.d[b] || a - b;
    });
    var paths = { bars: ["", "", ""], dots: ["", "", ""] };
    order.forEach(function (i, x) {
      var low = m.d[i] - m.reach[i], high = m.d[i] + m.reach[i], side = low > 0 ? 0 : high < 0 ? 1 : 2, at = x + 0.5;
      paths.bars[side] += "M" + at + " " + (-within(low)).toFixed(2) + "V" + (-within(high)).toFixed(2);
      paths.dots[side] += "M" + at + " " + (-within(m.d[i])).toFixed(2) + "h0";
    });
    home.querySelectorAll("svg").forEach(function (svg) {
      var box = svg.viewBox.baseVal;
      box.width = Math.max(1, order.length);
    });
    ["bars", "dots"].forEach(function (kind) {
      home.querySelectorAll("path." + kind).forEach(function (path, side) { path.setAttribute("d", paths[kind][side]); });
    });
    home.querySelectorAll("path[data-f]").forEach(function (path) {
      var of = data.factors[path.dataset.f].of, level = +path.dataset.l, d = "";
      for (var x = 0, from; x < order.length; x++) {
        for (from = x; x < order.length && of[order[x]] === level; x++);
        if (x > from) d += "M" + from + " 0h" + (x - from) + "v1h-" + (x - from) + "z";
      }
      path.setAttribute("d", d);
    });
    said.textContent = m.said;
    seen.textContent = "";
  }

  home.querySelector(".pick").hidden = false;
  which.onchange = by.onchange = draw;
  home.onpointermove = function (event) {
    var svg = event.target.closest("svg");
    if (!svg) return;
    var box = svg.getBoundingClientRect(), i = order[Math.floor((event.clientX - box.left) / box.width * order.length)];
    if (i === undefined) return;
    seen.textContent = data.names[i] + ": d " + data.curves[which.value].d[i] + "; " + data.factors.map(function (f) {
      return f.name + "=" + f.levels[f.of[i]];
    }).join(", ");
  };
  draw();
}());
