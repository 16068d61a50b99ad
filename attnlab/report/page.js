"use strict";
// Sorts and filters every table, hides conditions, tells the values under the pointer. The page says all without it.
(function () {
  function each(list, what) { Array.prototype.forEach.call(list, what); }
  function make(tag, where, text) {
    var made = where.appendChild(document.createElement(tag));
    if (text) made.textContent = text;
    return made;
  }

  // the number that a cell begins with, its text if there is none
  function worth(cell) {
    var text = cell ? cell.textContent.trim() : "", found = /^[−+-]?[\d,]*\.?\d+(e[+-]?\d+)?/i.exec(text);
    if (text === "∞" || text === "−∞") return text === "∞" ? Infinity : -Infinity;
    return found ? +found[0].replace("−", "-").replace(/,/g, "") : text;
  }

  function compare(a, b) {
    var one = typeof a === "number", other = typeof b === "number";
    if (one !== other) return one ? -1 : 1;
    return one ? a - b : a.localeCompare(b, "en", { numeric: true });
  }

  function sortable(table) {
    var body = table.tBodies[0], heads = table.tHead.rows[0].cells;
    each(heads, function (head, column) {
      if (head.tagName !== "TH" || !head.textContent.trim() || head.querySelector(".scale")) return;
      var button = document.createElement("button");
      button.type = "button";
      button.className = "sort";
      while (head.firstChild) button.appendChild(head.firstChild);
      head.appendChild(button);
      button.onclick = function () {
        var down = head.getAttribute("aria-sort") === "ascending";
        each(heads, function (other) { other.removeAttribute("aria-sort"); });
        head.setAttribute("aria-sort", down ? "descending" : "ascending");
        Array.from(body.rows).map(function (row) { return [worth(row.cells[column]), row]; }).sort(function (a, b) {
          var none = (b[0] !== "-" && b[0] !== "") - (a[0] !== "-" && a[0] !== "");  // what is missing comes last
          return none || (down ? -compare(a[0], b[0]) : compare(a[0], b[0]));
        }).forEach(function (pair) { body.appendChild(pair[1]); });
      };
    });
  }

  function filterable(table) {
    var rows = Array.from(table.tBodies[0].rows), bar = document.createElement("p");
    bar.className = "pick small";
    var label = make("label", bar, "Filter "), field = make("input", label), told = make("span", bar);
    field.type = "search";
    told.setAttribute("role", "status");
    field.oninput = function () {
      var words = field.value.toLowerCase().split(/\s+/), left = 0;
      rows.forEach(function (row) {
        var text = row.textContent.toLowerCase();
        var fits = words.every(function (word) { return text.indexOf(word) >= 0; });
        row.classList.toggle("filtered", !fits);
        left += fits;
      });
      told.textContent = field.value ? " " + left + " of " + rows.length : "";
    };
    var home = table.closest(".scroll") || table;
    home.parentNode.insertBefore(bar, home);
  }

  each(document.querySelectorAll("main table"), function (table) {
    if (!table.tHead || !table.tBodies[0] || table.matches(".spec, .matrix")) return;
    if (table.tBodies[0].rows.length > 1) sortable(table);
    if (table.tBodies[0].rows.length > 7) filterable(table);
  });

  // conditions: rows by data-of, lines of figures by the ids in their SVG
  var away = {}, drawings = [];
  each(document.querySelectorAll(".plot img"), function (img) {
    var parts = /^data:image\/svg\+xml(;base64)?,(.*)$/.exec(img.src);
    if (parts) drawings.push({ img: img, text: parts[1] ? atob(parts[2]) : decodeURIComponent(parts[2]), was: img.src });
  });
  var home = document.getElementById("shown");

  function update() {
    each(document.querySelectorAll("[data-of]"), function (row) { row.hidden = !!away[row.dataset.of]; });
    var hidden = Object.keys(away).filter(function (key) { return away[key]; });
    drawings.forEach(function (of) {
      var mine = hidden.filter(function (key) { return of.text.indexOf(key) >= 0; });
      if (!mine.length) { of.img.src = of.was; return; }
      var svg = new DOMParser().parseFromString(of.text, "image/svg+xml");
      mine.forEach(function (key) {
        each(svg.querySelectorAll('[id="' + key + '"]'), function (part) { part.setAttribute("display", "none"); });
      });
      of.img.src = "data:image/svg+xml," + encodeURIComponent(new XMLSerializer().serializeToString(svg));
    });
  }
  if (home) {
    home.hidden = false;
    home.onchange = function (event) {
      away[event.target.value] = !event.target.checked;
      update();
    };
  }

  // a link into what is folded unfolds it
  function unfold() {
    var part = location.hash.length > 1 && document.getElementById(decodeURIComponent(location.hash.slice(1)));
    for (var fold = part && part.closest("details"); fold; fold = fold.parentNode.closest("details")) fold.open = true;
    if (part) part.scrollIntoView();
  }
  addEventListener("hashchange", unfold);
  if (location.hash) unfold();

  // values at the pointer, or where the arrows are: of every line of a panel at the nearest point, of the nearest row of
  // a ranked one, of the cell of a heat map
  function among(edges, at) {
    for (var i = 1; i < edges.length; i++) if ((edges[i - 1] - at) * (edges[i] - at) <= 0) return i - 1;
    return -1;
  }

  function nearest(points, place, at) {
    return points.reduce(function (a, b) { return !a || Math.abs(b[place] - at) < Math.abs(a[place] - at) ? b : a; }, null);
  }

  // {head, lines, at: [left, top, width, height] of the mark} at a place of a panel; nothing where nothing is near
  function told(panel, u, v) {
    var box = panel.box, lines = panel.lines.filter(function (line) { return !away[line.gid]; });
    if (panel.rows) {
      var rows = lines.map(function (line) { return [line.at[0][0], line.at[0][1], line.name, line.at[0][3]]; });
      var row = nearest(rows, 1, v);
      return row && Math.abs(row[1] - v) < 60 && { head: row[2], lines: [(panel.title || panel.x) + " " + row[3]],
        at: [box[0], row[1], box[2] - box[0], 0], x: row[0] };
    }
    var said = [], best = null, cells = panel.cells;
    lines.forEach(function (line) {
      var near = nearest(line.at, 0, u);
      if (!near || Math.abs(near[0] - u) > 60) return;
      if (!best || Math.abs(near[0] - u) < Math.abs(best[0] - u)) best = near;
      said.push([Math.abs(near[1] - v), line.name + " " + near[3]]);
    });
    if (best) {
      said.sort(function (a, b) { return a[0] - b[0]; });
      var texts = said.slice(0, 8).map(function (one) { return one[1]; });
      if (said.length > 8) texts.push("and " + (said.length - 8) + " more");
      return { head: panel.x + " " + best[2] + (panel.title ? " · " + panel.title : ""), lines: texts,
        at: [best[0], box[1], 0, box[3] - box[1]], x: best[0] };
    }
    var i = cells ? among(cells.across, u) : -1, j = cells ? among(cells.up, v) : -1;
    if (i < 0 || j < 0 || !cells.said[j][i]) return null;
    var left = Math.min(cells.across[i], cells.across[i + 1]), top = Math.min(cells.up[j], cells.up[j + 1]);
    return { head: cells.columns[i] + ", " + cells.rows[j] + (panel.title ? " · " + panel.title : ""),
      lines: [cells.said[j][i] + cells.unit], at: [left, top, Math.abs(cells.across[i + 1] - cells.across[i]),
        Math.abs(cells.up[j + 1] - cells.up[j])], x: left };
  }

  // every place of a panel where the arrows stop
  function stops(panel) {
    var found = {};
    panel.lines.forEach(function (line) {
      if (!away[line.gid]) line.at.forEach(function (at) { found[panel.rows ? at[1] : at[0]] = [at[0], at[1]]; });
    });
    var keys = Object.keys(found).sort(function (a, b) { return a - b; });
    if (keys.length || !panel.cells) return keys.map(function (key) { return found[key]; });
    var of = panel.cells, places = [];
    of.said.forEach(function (row, j) {
      row.forEach(function (text, i) {
        if (text) places.push([(of.across[i] + of.across[i + 1]) / 2, (of.up[j] + of.up[j + 1]) / 2]);
      });
    });
    return places;
  }

  each(document.querySelectorAll(".plot[data-values]"), function (plot) {
    var panels = JSON.parse(plot.dataset.values), img = plot.querySelector("img"), at = [0, -1];
    var rule = make("i", plot), tip = make("div", plot);
    rule.className = "rule";
    tip.className = "tip";
    tip.setAttribute("role", "status");
    tip.hidden = rule.hidden = true;

    function show(panel, u, v) {
      var found = panel && told(panel, u, v);
      tip.hidden = rule.hidden = !found;
      tip.textContent = "";
      if (!found) return;
      make("b", tip, found.head);
      found.lines.forEach(function (line) { make("div", tip, line); });
      ["left", "top", "width", "height"].forEach(function (side, i) { rule.style[side] = found.at[i] / 10 + "%"; });
      tip.style.left = found.x < 550 ? found.x / 10 + 1 + "%" : "auto";
      tip.style.right = found.x < 550 ? "auto" : 101 - found.x / 10 + "%";
      var beside = panel.rows || panel.cells, low = found.at[1] > 600;
      tip.style.top = beside ? low ? "auto" : (found.at[1] + found.at[3] + 8) / 10 + "%" : panel.box[1] / 10 + "%";
      tip.style.bottom = beside && low ? (1008 - found.at[1]) / 10 + "%" : "auto";
    }
    plot.onpointerleave = plot.onblur = function () { show(null); };
    plot.onpointermove = plot.onpointerdown = function (event) {
      var box = img.getBoundingClientRect(), u = 1000 * (event.clientX - box.left) / box.width;
      var v = 1000 * (event.clientY - box.top) / box.height;
      show(panels.find(function (p) {
        return u >= p.box[0] - 5 && u <= p.box[2] + 5 && v >= p.box[1] - 5 && v <= p.box[3] + 5;
      }), u, v);
    };
    plot.onkeydown = function (event) {
      var turn = { ArrowUp: [-1, 0], ArrowDown: [1, 0], ArrowLeft: [0, -1], ArrowRight: [0, 1] }[event.key];
      if (event.key === "Escape") show(null);
      if (!turn) return;
      event.preventDefault();
      at = turn[0] ? [(at[0] + turn[0] + panels.length) % panels.length, 0] : [at[0], at[1] + turn[1]];
      var places = stops(panels[at[0]]);
      at[1] = Math.max(0, Math.min(places.length - 1, at[1]));
      if (places.length) show(panels[at[0]], places[at[1]][0], places[at[1]][1]);
    };
  });

  // the ranked plot on the first screen: the seed that is nearest to the pointer
  each(document.querySelectorAll(".forest svg"), function (svg) {
    var tip = make("div", svg.parentNode), box = svg.viewBox.baseVal;
    tip.className = "tip";
    tip.hidden = true;
    svg.onpointerleave = function () { tip.hidden = true; };
    svg.onpointermove = svg.onpointerdown = function (event) {
      var area = svg.getBoundingClientRect(), u = box.width * (event.clientX - area.left) / area.width;
      var marks = Array.from(svg.querySelectorAll("circle")).map(function (mark) {
        return [+mark.getAttribute("cx"), mark.textContent];
      });
      var near = nearest(marks, 0, u);
      tip.hidden = !near || Math.abs(near[0] - u) > 30;
      tip.textContent = near ? near[1] : "";
      tip.style.left = near ? Math.min(60, 100 * near[0] / box.width) + "%" : "0";
    };
  });
}());
