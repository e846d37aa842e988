// Fills the report from the JSON that is embedded in it.
"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const media = JSON.parse(document.getElementById("media").textContent);
const $ = id => document.getElementById(id);
const isFixed = row => row.technique === "white" || row.technique === "baked";
const digits = (value, n = 3) => value === null || value === undefined ? "–" : value.toFixed(n);
const columns = [
  ["case", "label", v => v], ["RMSE", "rmse", digits], ["of white", "of_white", digits], ["MAE", "mae", digits], ["bias", "bias", digits],
  ["|bias|", "abs_bias", digits], ["P95", "p95", digits], ["SSIM", "ssim", digits], ["correlation", "correlation", digits], ["skill", "skill", digits],
  ["noise", "noise", v => digits(v, 4)], ["edge", "edge", digits], ["border", "border", digits], ["contact", "contact", digits],
  ["fetches", "taps_per_pixel", v => v ? digits(v, v % 1 ? 1 : 0) : "–"], ["CPU share", "cpu_share", digits], ["of it guard", "guard_share", v => v ? digits(v) : "–"],
];
const palette = ["#0b66c3", "#c2410c", "#15803d", "#7e22ce", "#b91c1c", "#0f766e", "#a16207", "#475569", "#be185d"];
const techniques = [...new Set(data.rows.map(r => r.technique))].filter(t => !isFixed({ technique: t }));
const colorOf = technique => palette[techniques.indexOf(technique) % palette.length];

function element(name, text, parent) {
  const made = document.createElement(name);
  if (text !== undefined) made.textContent = text;
  if (parent) parent.append(made);
  return made;
}

function fillTable(table, heads, rows) {
  const [head, body] = [table.tHead, table.tBodies[0]];
  head.replaceChildren(); body.replaceChildren();
  const line = element("tr", undefined, head);
  for (const [title] of heads) element("th", title, line).scope = "col";
  for (const row of rows) {
    const tr = element("tr", undefined, body);
    if (row.on_front) tr.className = "front";
    if (isFixed(row)) tr.className = "fixed";
    for (const [, key, show] of heads) element("td", show(row[key]), tr);
  }
}

let sorting = null;
function showGroup() {
  const group = data.tables[$("group").value];
  const rows = [...group.rows];
  if (sorting) {
    const { key, down } = sorting;
    const order = (a, b) => a === null ? 1 : b === null ? -1 : typeof a === "string" ? a.localeCompare(b) : a - b;
    rows.sort((a, b) => (down ? -1 : 1) * order(a[key], b[key]));
  }
  fillTable($("table"), columns, rows);
  [...$("table").tHead.rows[0].cells].forEach((cell, i) => {
    const key = columns[i][1];
    if (sorting?.key === key) cell.ariaSort = sorting.down ? "descending" : "ascending";
    cell.onclick = () => { sorting = { key, down: sorting?.key === key && !sorting.down }; showGroup(); };
  });
  drawPareto(group);
}

let pareto = null;
function drawPareto(group) {
  const rows = group.rows.filter(r => !isFixed(r) && r.cpu_share !== null);
  const point = r => ({ x: r.cpu_share, y: r.of_white, label: r.label });
  const datasets = techniques.map(t => ({
    label: t, data: rows.filter(r => r.technique === t).map(point), backgroundColor: colorOf(t), pointRadius: 5,
  })).filter(d => d.data.length);
  const front = rows.filter(r => r.on_front).map(point).sort((a, b) => a.x - b.x);
  datasets.push({ label: "Pareto front", data: front, type: "line", borderColor: "#1d2330", borderWidth: 1.5, pointRadius: 0, stepped: "before" });
  pareto?.destroy();
  pareto = draw("pareto", datasets, "CPU share of the article's pass", "RMSE, of white", "logarithmic");
  $("pareto").dataset.points = rows.length;
  $("pareto").dataset.front = front.map(p => p.label).join(";");
}

function draw(id, datasets, x, y, type = "linear") {
  return new Chart($(id), {
    type: "scatter",
    data: { datasets },
    options: {
      animation: false, maintainAspectRatio: false,
      scales: { x: { type, title: { display: true, text: x } }, y: { title: { display: true, text: y } } },
      plugins: { tooltip: { callbacks: { label: p => `${p.raw.label}: ${digits(p.raw.y)} at ${digits(p.raw.x)}` } } },
    },
  });
}

function drawCurves(id, start, x) {
  const curves = data.curves.filter(c => c.name.startsWith(start) && c.points.some(p => p.cpu_share !== null));
  const datasets = curves.map((c, i) => ({
    label: c.name.slice(start.length), showLine: true, borderColor: palette[i % palette.length], backgroundColor: palette[i % palette.length],
    data: c.points.filter(p => p.x || start.startsWith("blur")).map(p => ({ x: p.x, y: p.cpu_share, label: p.label })).sort((a, b) => a.x - b.x),
  }));
  draw(id, datasets, x, "CPU share of the article's pass");
  $(id).dataset.points = datasets.reduce((n, d) => n + d.data.length, 0);
}

function showSplits() {
  const sums = new Map();
  for (const s of data.split) {
    if (s.set !== "evaluation") continue;
    for (const kind of [s.kind]) {
      const key = `${s.technique} ${s.quality}, ${kind === "room" ? "rooms" : "thin occluders"}`;
      const sum = sums.get(key) ?? { label: key, total: 0, estimator: 0, missing: 0, n: 0 };
      for (const part of ["total", "estimator", "missing"]) sum[part] += s[part] / s.white;
      ++sum.n;
      sums.set(key, sum);
    }
  }
  const rows = [...sums.values()].map(s => ({ label: s.label, total: s.total / s.n, estimator: s.estimator / s.n, missing: s.missing / s.n }));
  fillTable($("split"), [["case", "label", v => v], ["total", "total", digits], ["estimator", "estimator", digits], ["missing", "missing", digits]], rows);
}

function showFits() {
  const rows = data.calibration.map(f => ({ ...f, label: `${f.technique} ${f.quality}` }));
  fillTable($("fits"), [["case", "label", v => v], ["(a) as shipped", "before", digits], ["(b) calibrated", "after", digits], ["on the calibration views", "fitted", digits],
    ["radius ×", "radius", v => digits(v, 2)], ["strength", "strength", v => digits(v, 2)], ["power", "power", v => digits(v, 2)],
    ["(c) matched", "matched", digits], ["definition", "matched_name", v => v || "–"]], rows);
}

function picture(parent, uri, text, className) {
  const figure = element("figure", undefined, parent);
  const image = element("img", undefined, figure);
  image.src = uri; image.alt = text; image.loading = "lazy";
  if (className) image.className = className;
  element("figcaption", text, figure);
}

function showPictures() {
  $("pictures").replaceChildren();
  for (const p of media.pictures.filter(p => p.scene === $("pictureScene").value)) {
    picture($("pictures"), p.map, p.label);
    if (p.error) picture($("pictures"), p.error, `${p.label}: error`, "error");
  }
}

function showLit() {
  $("lit").replaceChildren();
  for (const l of media.lit.filter(l => l.scene === $("litScene").value)) {
    const figure = element("figure", undefined, $("lit"));
    const slider = element("div", undefined, figure);
    slider.className = "slider";
    for (const [kind, uri] of [["without", media.without[l.without]], ["with", l.with]]) {
      const image = element("img", undefined, slider);
      image.src = uri; image.className = kind; image.alt = `${l.scene}, ${l.label}, ${kind} occlusion`;
    }
    const range = element("input", undefined, slider);
    range.type = "range"; range.min = 0; range.max = 100; range.value = 50; range.ariaLabel = `Without occlusion | ${l.label}`;
    range.oninput = () => slider.style.setProperty("--cut", `${range.value}%`);
    element("figcaption", `${l.scene}, ${l.view}: without | ${l.label}`, figure);
  }
}

function fillSelect(id, words, change) {
  words.forEach((word, i) => { element("option", word, $(id)).value = id === "group" ? i : word; });
  $(id).onchange = change;
  change();
}

$("about").append("Truth: Embree, ", `${data.truth_samples} rays a pixel, hard falloff. Device: ${data.device}. Size: ${data.sizes.join(", ")}. `, "Made by ");
element("code", data.command, $("about"));
fillSelect("group", data.tables.map(t => t.title), showGroup);
drawCurves("samples", "samples: ", "samples per pixel, no blur, full resolution");
drawCurves("blurs", "blur: ", "texels that the blur reads per pixel");
showSplits();
showFits();
fillSelect("litScene", [...new Set(media.lit.map(l => l.scene))], showLit);
fillSelect("pictureScene", [...new Set(media.pictures.map(p => p.scene))], showPictures);
document.documentElement.dataset.ready = "yes";
