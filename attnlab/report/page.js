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

  // values: of every line of a panel that is shown, at the point nearest to the pointer
  each(document.querySelectorAll(".plot[data-values]"), function (plot) {
    var panels = JSON.parse(plot.dataset.values), img = plot.querySelector("img");
    var rule = make("i", plot), tip = make("div", plot);
    rule.className = "rule";
    tip.className = "tip";
    tip.hidden = rule.hidden = true;
    plot.onpointerleave = function () { tip.hidden = rule.hidden = true; };
    plot.onpointermove = plot.onpointerdown = function (event) {
      var box = img.getBoundingClientRect(), u = 1000 * (event.clientX - box.left) / box.width;
      var v = 1000 * (event.clientY - box.top) / box.height, best = null, said = [];
      var panel = panels.find(function (p) {
        return u >= p.box[0] - 5 && u <= p.box[2] + 5 && v >= p.box[1] - 5 && v <= p.box[3] + 5;
      });
      (panel ? panel.lines : []).forEach(function (line) {
        if (away[line.gid]) return;
        var near = line.at.reduce(function (a, b) { return !a || Math.abs(b[0] - u) < Math.abs(a[0] - u) ? b : a; }, null);
        if (!near || Math.abs(near[0] - u) > 60) return;
        if (!best || Math.abs(near[0] - u) < Math.abs(best[0] - u)) best = near;
        said.push([Math.abs(near[1] - v), line.name + " " + near[3]]);
      });
      tip.hidden = rule.hidden = !best;
      if (!best) return;
      said.sort(function (a, b) { return a[0] - b[0]; });
      tip.textContent = "";
      make("b", tip, panel.x + " " + best[2] + (panel.title ? " · " + panel.title : ""));
      said.slice(0, 8).forEach(function (one) { make("div", tip, one[1]); });
      if (said.length > 8) make("div", tip, "and " + (said.length - 8) + " more");
      rule.style.left = best[0] / 10 + "%";
      rule.style.top = panel.box[1] / 10 + "%";
      rule.style.height = (panel.box[3] - panel.box[1]) / 10 + "%";
      tip.style.left = best[0] < 550 ? best[0] / 10 + 1 + "%" : "auto";
      tip.style.right = best[0] < 550 ? "auto" : 101 - best[0] / 10 + "%";
      tip.style.top = panel.box[1] / 10 + "%";
    };
  });
}());
