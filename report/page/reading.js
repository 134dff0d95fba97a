// How the page is read: how much is unfolded, light or dark, values under the pointer, search in tables.
(function () {
  "use strict";
  var root = document.documentElement, ranks = { manager: 0, engineer: 1, expert: 2 };

  // A browser may refuse storage to a page without a server; the settings then last as long as the page.
  function kept(key, value) {
    try {
      if (value !== undefined) window.localStorage.setItem("millstand." + key, value);
      return window.localStorage.getItem("millstand." + key);
    } catch (refused) {
      return null;
    }
  }

  function press(setting, value) {
    document.querySelectorAll("button[data-" + setting + "]").forEach(function (button) {
      button.setAttribute("aria-pressed", String(button.dataset[setting] === value));
    });
  }

  function set_depth(depth) {
    document.querySelectorAll("details.part").forEach(function (part) {
      part.open = ranks[part.dataset.depth] <= ranks[depth];
    });
    root.dataset.reading = depth;
    press("depth", depth);
  }

  function set_theme(theme) {
    if (theme === "auto") root.removeAttribute("data-theme");
    else root.dataset.theme = theme;
    press("theme", theme);
    window.dispatchEvent(new Event("themechange"));
  }

  function unfold(id) {
    var target = id && document.getElementById(id);
    for (var part = target; part; part = part.parentElement && part.parentElement.closest("details"))
      if (part.tagName === "DETAILS") part.open = true;
    if (target) target.scrollIntoView();
  }

  // A chart that was made while folded has no size.
  document.addEventListener("toggle", function () { window.dispatchEvent(new Event("resize")); }, true);

  document.querySelectorAll(".settings").forEach(function (box) {
    box.hidden = false;
    box.addEventListener("click", function (event) {
      var button = event.target.closest("button");
      if (!button) return;
      if (button.dataset.depth) { set_depth(button.dataset.depth); kept("depth", button.dataset.depth); }
      if (button.dataset.theme) { set_theme(button.dataset.theme); kept("theme", button.dataset.theme); }
    });
  });
  set_depth(ranks[kept("depth")] === undefined ? "engineer" : kept("depth"));
  set_theme(kept("theme") || root.dataset.theme || "auto");
  document.addEventListener("click", function (event) {
    var link = event.target.closest("a[href^='#']");
    if (link) unfold(decodeURIComponent(link.getAttribute("href").slice(1)));
  });
  unfold(decodeURIComponent(window.location.hash.slice(1)));
}());

// Search, copy and CSV of a long table.
(function () {
  "use strict";

  function cells(row) {
    return [row.dataset.name, row.dataset.value, row.dataset.unit, row.dataset.at, row.dataset.error];
  }

  function quoted(text) {
    return /[",\n]/.test(text) ? '"' + text.replace(/"/g, '""') + '"' : text;
  }

  document.querySelectorAll(".tools").forEach(function (tools) {
    var table = tools.parentElement.querySelector("table"), status = tools.querySelector("output");
    var rows = Array.prototype.slice.call(table.querySelectorAll("tbody tr[data-name]"));
    var head = ["name", "value", "unit", "at", "error_estimate"];

    function seen() {
      return rows.filter(function (row) { return !row.hidden; }).map(cells);
    }

    tools.hidden = false;
    tools.querySelector("input").addEventListener("input", function () {
      var words = this.value.toLowerCase().split(/\s+/).filter(Boolean);
      rows.forEach(function (row) {
        var text = row.textContent.toLowerCase();
        row.hidden = !words.every(function (word) { return text.indexOf(word) >= 0; });
      });
      status.textContent = seen().length + " of " + rows.length;
    });
    tools.querySelector(".copy").addEventListener("click", function () {
      var text = [head].concat(seen()).map(function (row) { return row.join("\t"); }).join("\n");
      var area = document.createElement("textarea");
      area.value = text;
      document.body.appendChild(area);
      area.select();
      status.textContent = document.execCommand("copy") ? "copied" : "the browser refuses to copy";
      area.remove();
    });
    tools.querySelector(".csv").addEventListener("click", function () {
      var text = [head].concat(seen()).map(function (row) { return row.map(quoted).join(","); }).join("\n") + "\n";
      var link = document.createElement("a");
      link.href = URL.createObjectURL(new Blob([text], { type: "text/csv" }));
      link.download = (document.title.split(" - ")[0] || "results") + ".csv";
      link.click();
      URL.revokeObjectURL(link.href);
    });
  });
}());

// Values of the drawn lines under the pointer, read off the drawing itself.
(function () {
  "use strict";
  var box = document.createElement("div");
  box.className = "read-off";
  box.hidden = true;
  document.body.appendChild(box);

  function axis(text) {
    var part = text.split(" ");
    return { first: +part[0], last: +part[1], low: +part[2], high: +part[3], log: part[4] === "log", unit: part.slice(5).join(" ") };
  }

  function value(a, pixel) {
    var share = (pixel - a.first) / (a.last - a.first);
    return a.log ? a.low * Math.pow(a.high / a.low, share) : a.low + share * (a.high - a.low);
  }

  function shown(number, unit) {
    var text = Math.abs(number) >= 1e5 || (number !== 0 && Math.abs(number) < 1e-3) ? number.toExponential(3) : String(Number(number.toPrecision(4)));
    return text + (unit === "-" ? "" : " " + unit);
  }

  // Height of a stroke at this place along the drawing; strokes of several parts are tried one after the other.
  function height(line, x) {
    var points = line.points;
    for (var i = 1; i < points.numberOfItems; ++i) {
      var a = points.getItem(i - 1), b = points.getItem(i);
      if ((a.x - x) * (b.x - x) <= 0)
        return a.x === b.x ? (a.y + b.y) / 2 : a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
    }
    return null;
  }

  document.querySelectorAll("svg[data-x]").forEach(function (svg) {
    var x = axis(svg.dataset.x), y = axis(svg.dataset.y), mark = null, names = {};
    svg.dataset.lines.split("|").forEach(function (entry) {
      var at = entry.indexOf("=");
      names[entry.slice(0, at)] = entry.slice(at + 1);
    });

    function leave() {
      box.hidden = true;
      if (mark) mark.remove();
      mark = null;
    }

    svg.addEventListener("pointermove", function (event) {
      var matrix = svg.getScreenCTM();
      if (!matrix) return;
      var at = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
      if (at.x < x.first || at.x > x.last || at.y < y.last || at.y > y.first) { leave(); return; }
      var rows = [shown(value(x, at.x), x.unit)], read = {};
      svg.querySelectorAll("polyline.pen").forEach(function (line) {
        var pen = line.getAttribute("class").replace(/^pen /, ""), h = height(line, at.x);
        if (h === null || read[pen] || names[pen] === undefined) return;
        read[pen] = true;
        rows.push((names[pen] ? names[pen] + ": " : "") + shown(value(y, h), y.unit));
      });
      if (!mark) {
        mark = document.createElementNS("http://www.w3.org/2000/svg", "line");
        mark.setAttribute("class", "read-line");
        svg.appendChild(mark);
      }
      mark.setAttribute("x1", at.x); mark.setAttribute("x2", at.x);
      mark.setAttribute("y1", y.first); mark.setAttribute("y2", y.last);
      box.textContent = "";
      rows.forEach(function (row) {
        var line = document.createElement("div");
        line.textContent = row;
        box.appendChild(line);
      });
      box.hidden = false;
      box.style.left = Math.max(4, Math.min(event.clientX + 14, window.innerWidth - box.offsetWidth - 8)) + "px";
      box.style.top = Math.max(4, Math.min(event.clientY + 14, window.innerHeight - box.offsetHeight - 8)) + "px";
    });
    svg.addEventListener("pointerleave", leave);
  });
}());
