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

  document.querySelectorAll(".zoom").forEach(function (box) {
    var data = JSON.parse(box.querySelector("script").textContent);
    var charts = groups[box.dataset.group] = groups[box.dataset.group] || [];
    var title = document.createElement("p"), plot = document.createElement("div");
    title.className = "zoom-title";
    title.textContent = data.labels.join(", ");
    plot.className = "zoom-plot";
    box.appendChild(title);
    box.appendChild(plot);
    box.closest("figure").classList.add("zooms");
    charts.push(new Dygraph(plot, rows(data), {
      labels: ["time [s]"].concat(data.labels),
      xlabel: "time [s]",
      ylabel: box.dataset.axis,
      colors: ["#16395f", "#d0712a"],
      axes: { x: { axisLabelFontSize: 12 }, y: { axisLabelFontSize: 12, axisLabelWidth: 56 } },
      gridLineColor: "#e3e7eb",
      axisLineColor: "#8b96a2",
      digitsAfterDecimal: 4,
      valueRange: data.range || null,
      drawCallback: function (chart, first) { if (!first) follow(charts, chart); }
    }));
  });
}());
