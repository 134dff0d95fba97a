// Puts a zoomable chart in the place of every static history.  Charts of one pass zoom together.
(function () {
  "use strict";
  var groups = {};

  function rows(data) {
    return data.series[0].map(function (_, i) {
      return [data.start + i * data.step].concat(data.series.map(function (series) { return series[i]; }));
    });
  }

  function follow(charts, chart) {
    var range = chart.xAxisRange();
    charts.forEach(function (other) {
      var own = other.xAxisRange();
      if (other !== chart && (own[0] !== range[0] || own[1] !== range[1]))
        other.updateOptions({ dateWindow: range });
    });
  }

  function colour(name) {
    var probe = document.createElement("i");
    probe.style.color = "var(--" + name + ")";
    document.body.appendChild(probe);
    var found = window.getComputedStyle(probe).color;
    probe.remove();
    return found;
  }

  function palette() {
    return { colors: [colour("dark"), colour("warm")], gridLineColor: colour("grid"), axisLineColor: colour("frame") };
  }

  window.addEventListener("themechange", function () {
    Object.keys(groups).forEach(function (name) {
      groups[name].forEach(function (chart) { chart.updateOptions(palette()); });
    });
  });

  document.querySelectorAll(".zoom").forEach(function (box) {
    var data = JSON.parse(box.querySelector("script").textContent);
    var charts = groups[box.dataset.group] = groups[box.dataset.group] || [];
    var title = document.createElement("p"), plot = document.createElement("div");
    title.className = "zoom-title";
    title.textContent = data.title || data.labels.join(", ");
    plot.className = "zoom-plot";
    box.appendChild(title);
    box.appendChild(plot);
    box.closest("figure").classList.add("zooms");
    charts.push(new Dygraph(plot, rows(data), Object.assign({
      labels: ["time [s]"].concat(data.labels),
      xlabel: "time [s]",
      ylabel: box.dataset.axis,
      axes: { x: { axisLabelFontSize: 12 }, y: { axisLabelFontSize: 12, axisLabelWidth: 56 } },
      digitsAfterDecimal: 4,
      valueRange: data.range || null,
      drawCallback: function (chart, first) { if (!first) follow(charts, chart); }
    }, palette())));
  });
}());

// Animates the stand in the chosen mode.  Every shape carries its corners at rest and the displacements that
// they follow: "x,y,k" or, between two of them, "x,y,k,l,share".
(function () {
  "use strict";
  var still = window.matchMedia && window.matchMedia("(prefers-reduced-motion: reduce)").matches;

  function corners(text) {
    return text.split(" ").map(function (corner) { return corner.split(",").map(Number); });
  }

  function show(shape, displacement, swing) {
    shape.element.setAttribute("points", shape.corners.map(function (c) {
      var d = displacement[c[2]];
      if (c.length > 3) d += c[4] * (displacement[c[3]] - d);
      return c[0] + "," + (c[1] - swing * d).toFixed(2);
    }).join(" "));
  }

  function list(box, shares) {
    while (box.firstChild) box.removeChild(box.firstChild);
    shares.forEach(function (share) {
      var row = document.createElement("li"), track = document.createElement("i");
      var name = document.createElement("span"), bar = document.createElement("b"), number = document.createElement("em");
      name.textContent = share[0];
      bar.style.width = share[1] + "%";
      number.textContent = share[1].toFixed(0) + " %";
      track.appendChild(bar);
      [name, track, number].forEach(function (part) { row.appendChild(part); });
      box.appendChild(row);
    });
  }

  function bring_to_life(player) {
    var data = JSON.parse(player.querySelector("script").textContent);
    var find = function (selector) { return player.querySelector(selector); };
    var button = find(".play"), speed = find(".speed"), swing = find(".swing"), models = find(".pick-model");
    var drawings = {}, mode = null, shapes = [], playing = false, seen = true, turn = 0.25, last = 0, asked = 0;

    data.forEach(function (model) {
      drawings[model.name] = [];
      player.querySelectorAll(".mode-drawing").forEach(function (box) {
        if (box.dataset.model === model.name)
          drawings[model.name] = Array.prototype.map.call(box.querySelectorAll("[data-at]"), function (element) {
            return { element: element, corners: corners(element.dataset.at), ghost: element.classList.contains("ghost") };
          });
      });
    });

    function draw() {
      var size = Number(swing.value), now = size * Math.sin(2 * Math.PI * turn);
      shapes.forEach(function (shape) { if (!shape.ghost) show(shape, mode.d, now); });
    }

    function outlines() {
      shapes.forEach(function (shape) { if (shape.ghost) show(shape, mode.d, -Number(swing.value)); });
      draw();
    }

    function frame(time) {
      asked = 0;
      if (!playing || !seen) { last = 0; return; }
      if (last) turn = (turn + Number(speed.value) * Math.min(0.1, (time - last) / 1000)) % 1;
      last = time;
      draw();
      asked = window.requestAnimationFrame(frame);
    }

    function play(on) {
      playing = on;
      button.textContent = on ? "Pause" : "Play";
      if (on && !asked) asked = window.requestAnimationFrame(frame);
      if (!on && mode) { turn = 0.25; draw(); }
    }

    function choose() {
      var name = models.value, number = 0, model = data.filter(function (one) { return one.name === name; })[0];
      player.querySelectorAll("[data-model]").forEach(function (box) {
        box.hidden = box.dataset.model !== name;
        if (!box.hidden && box.querySelector(".pick-mode")) number = Number(box.querySelector(".pick-mode").value);
      });
      mode = model.modes[number];
      shapes = drawings[name];
      find(".mode-say").textContent = mode.say;
      list(find("[data-shares=kinetic]"), mode.kinetic);
      list(find("[data-shares=strain]"), mode.strain);
      outlines();
    }

    models.addEventListener("change", choose);
    player.querySelectorAll(".pick-mode").forEach(function (one) { one.addEventListener("change", choose); });
    swing.addEventListener("input", outlines);
    button.addEventListener("click", function () { play(!playing); });
    window.addEventListener("beforeprint", function () { play(false); });
    if (window.IntersectionObserver)
      new IntersectionObserver(function (entries) {
        seen = entries[entries.length - 1].isIntersecting;
        if (seen && playing && !asked) asked = window.requestAnimationFrame(frame);
      }).observe(player);
    find(".controls").hidden = false;
    choose();
    play(!still);
  }

  document.querySelectorAll(".mode-player").forEach(bring_to_life);
}());
