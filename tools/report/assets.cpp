#include "tools/report/assets.h"

namespace feedtwin::tools {

const std::string_view report_style = R"css(
:root{color-scheme:light dark;--back:#fcfcfb;--text:#1c1e21;--soft:#63686f;--line:#d9dbde;--card:#fff;
--s0:#1f5fbf;--s1:#c2491d;--s2:#2e8540;--s3:#8a3fa0;--s4:#9a7400;--s5:#0c7c86}
@media (prefers-color-scheme:dark){:root{--back:#14161a;--text:#e4e6e9;--soft:#989ea6;--line:#33373d;--card:#1b1e23;
--s0:#79aefc;--s1:#ff9468;--s2:#77ce8a;--s3:#d59aea;--s4:#e0bd4e;--s5:#5fcad4}}
*{box-sizing:border-box}
body{margin:0;padding:1.5rem;background:var(--back);color:var(--text);font:15px/1.5 system-ui,sans-serif}
header,main{max-width:1500px;margin:0 auto}h1{font-size:1.35rem;margin:0}header p{color:var(--soft);margin:.2rem 0 1.2rem}
#figures{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,560px),1fr));gap:1rem}
figure{margin:0;padding:.8rem;background:var(--card);border:1px solid var(--line);border-radius:8px;min-width:0}
figcaption{font-weight:600;font-size:.92rem;overflow-wrap:anywhere}
.legend{display:flex;flex-wrap:wrap;gap:.1rem .9rem;font-size:.82rem;margin:.15rem 0 .3rem}
.legend button{all:unset;cursor:pointer;color:var(--text)}.legend button:focus-visible{outline:2px solid var(--s0)}
.legend i{display:inline-block;width:.9em;height:.9em;border-radius:2px;margin-right:.35em;vertical-align:-.08em}
.legend .off{opacity:.35;text-decoration:line-through}
canvas{width:100%;height:280px;display:block;cursor:crosshair;touch-action:pan-y}
.read{font-size:.8rem;color:var(--soft);min-height:1.3em;font-variant-numeric:tabular-nums}
#numbers{margin-top:1.5rem}details{margin:.7rem 0}summary{cursor:pointer;font-weight:600}
details details{margin-left:1rem}
.scroll{overflow-x:auto}table{border-collapse:collapse;font-size:.84rem;margin:.3rem 0}
th,td{text-align:left;padding:.15rem .7rem;border-bottom:1px solid var(--line);white-space:nowrap}
td{font-variant-numeric:tabular-nums}thead th{color:var(--soft);font-weight:500}tbody th{font-weight:500}
@media print{body{background:#fff;color:#000}figure{break-inside:avoid}}
)css";

const std::string_view report_script = R"js(
'use strict';
(() => {
const figures = JSON.parse(document.getElementById('data').textContent);
const colour = i => getComputedStyle(document.documentElement).getPropertyValue('--s' + i % 6).trim();
const css = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const label = a => a && a.label ? a.label + (a.unit ? ' in ' + a.unit : '') : '';
function ticks(low, high, most) {
  const raw = (high - low) / most, power = Math.pow(10, Math.floor(Math.log10(raw)));
  const step = [1, 2, 5, 10].map(f => f * power).find(s => s >= raw), out = [];
  for (let k = Math.ceil(low / step); k * step <= high + 1e-9 * step; k++) out.push(k * step);
  return out;
}
const text = (v, span) => v === 0 || Math.abs(v) < 1e-12 * span ? '0' : Math.abs(v) >= 1e5 || Math.abs(v) < 1e-3
  ? v.toExponential(Math.min(6, Math.max(0, Math.floor(Math.log10(Math.abs(v))) - Math.floor(Math.log10(span)) + 1)))
  : String(+v.toPrecision(7));
function extent(figure, shown, inX) {
  let x0 = Infinity, x1 = -Infinity, y0 = Infinity, y1 = -Infinity;
  figure.series.forEach((s, i) => { if (shown[i]) for (let k = 0; k < s.x.length; k++) {
    const x = s.x[k], y = s.y[k];
    if (x === null || y === null || (inX && (x < inX[0] || x > inX[1]))) continue;
    if (x < x0) x0 = x; if (x > x1) x1 = x; if (y < y0) y0 = y; if (y > y1) y1 = y;
  } });
  if (x0 > x1) return [0, 1, 0, 1];
  const px = (x1 - x0 || Math.abs(x0) || 1) * 0.01, py = (y1 - y0 || Math.abs(y0) || 1) * 0.05;
  return [x0 - px, x1 + px, y0 - py, y1 + py];
}
function draw(figure, parent) {
  const box = document.createElement('figure'), caption = document.createElement('figcaption');
  const legend = document.createElement('div'), canvas = document.createElement('canvas'), read = document.createElement('div');
  caption.textContent = figure.title || ''; legend.className = 'legend'; read.className = 'read';
  canvas.setAttribute('role', 'img'); canvas.setAttribute('aria-label', figure.title || 'figure');
  box.append(caption, legend, canvas, read); parent.append(box);
  const shown = figure.series.map(() => true);
  let view = extent(figure, shown), drag = null;
  const pad = {l: 66, r: 10, t: 6, b: 36};
  const size = () => [canvas.clientWidth, canvas.clientHeight];
  const toX = px => view[0] + (px - pad.l) / (size()[0] - pad.l - pad.r) * (view[1] - view[0]);
  const toY = py => view[3] - (py - pad.t) / (size()[1] - pad.t - pad.b) * (view[3] - view[2]);
  function paint() {
    const [w, h] = size(), ratio = window.devicePixelRatio || 1, c = canvas.getContext('2d');
    canvas.width = w * ratio; canvas.height = h * ratio; c.scale(ratio, ratio); c.clearRect(0, 0, w, h);
    const X = v => pad.l + (v - view[0]) / (view[1] - view[0]) * (w - pad.l - pad.r);
    const Y = v => pad.t + (view[3] - v) / (view[3] - view[2]) * (h - pad.t - pad.b);
    c.font = '11px system-ui,sans-serif'; c.lineWidth = 1; c.strokeStyle = css('--line'); c.fillStyle = css('--soft');
    c.textAlign = 'center'; c.textBaseline = 'top';
    for (const t of ticks(view[0], view[1], Math.max(2, w / 110))) {
      c.beginPath(); c.moveTo(X(t), pad.t); c.lineTo(X(t), h - pad.b); c.stroke(); c.fillText(text(t, view[1] - view[0]), X(t), h - pad.b + 4);
    }
    c.textAlign = 'right'; c.textBaseline = 'middle';
    for (const t of ticks(view[2], view[3], Math.max(2, h / 45))) {
      c.beginPath(); c.moveTo(pad.l, Y(t)); c.lineTo(w - pad.r, Y(t)); c.stroke(); c.fillText(text(t, view[3] - view[2]), pad.l - 5, Y(t));
    }
    c.textAlign = 'center'; c.textBaseline = 'bottom'; c.fillText(label(figure.x), (pad.l + w - pad.r) / 2, h - 1);
    c.save(); c.translate(10, (pad.t + h - pad.b) / 2); c.rotate(-Math.PI / 2); c.textBaseline = 'middle'; c.fillText(label(figure.y), 0, 0); c.restore();
    c.save(); c.beginPath(); c.rect(pad.l, pad.t, w - pad.l - pad.r, h - pad.t - pad.b); c.clip();
    figure.series.forEach((s, i) => {
      if (!shown[i]) return;
      c.strokeStyle = c.fillStyle = colour(i); c.lineWidth = 1.4;
      if (s.style === 'points') { c.globalAlpha = 0.6;
        for (let k = 0; k < s.x.length; k++) if (s.y[k] !== null) c.fillRect(X(s.x[k]) - 1.2, Y(s.y[k]) - 1.2, 2.4, 2.4);
        c.globalAlpha = 1; return; }
      c.beginPath(); let on = false;
      for (let k = 0; k < s.x.length; k++) {
        if (s.x[k] === null || s.y[k] === null) { on = false; continue; }
        if (on) c.lineTo(X(s.x[k]), Y(s.y[k])); else c.moveTo(X(s.x[k]), Y(s.y[k])); on = true;
      }
      c.stroke();
    });
    c.restore();
    if (drag && drag.moved) { c.fillStyle = css('--s0'); c.globalAlpha = 0.15;
      c.fillRect(Math.min(drag.x, drag.x1), pad.t, Math.abs(drag.x1 - drag.x), h - pad.t - pad.b); c.globalAlpha = 1; }
  }
  figure.series.forEach((s, i) => {
    const b = document.createElement('button'), mark = document.createElement('i');
    mark.style.background = 'var(--s' + i % 6 + ')'; b.append(mark, s.name || 'series ' + (i + 1));
    b.onclick = () => { shown[i] = !shown[i]; b.classList.toggle('off', !shown[i]); view = extent(figure, shown); paint(); };
    legend.append(b);
  });
  const at = e => { const r = canvas.getBoundingClientRect(); return [e.clientX - r.left, e.clientY - r.top]; };
  canvas.onpointerdown = e => { const [x] = at(e); drag = {x, x1: x, moved: false}; canvas.setPointerCapture(e.pointerId); };
  canvas.onpointermove = e => { const [x, y] = at(e);
    read.textContent = (figure.x && figure.x.label || 'x') + ' ' + text(toX(x), view[1] - view[0]) + '   ' + (figure.y && figure.y.label || 'y') + ' ' + text(toY(y), view[3] - view[2]);
    if (drag) { drag.x1 = x; drag.moved = Math.abs(x - drag.x) > 4; paint(); } };
  canvas.onpointerup = () => { if (drag && drag.moved) { const a = toX(Math.min(drag.x, drag.x1)), b = toX(Math.max(drag.x, drag.x1));
      const inside = extent(figure, shown, [a, b]); view = [a, b, inside[2], inside[3]]; } drag = null; paint(); };
  canvas.ondblclick = () => { view = extent(figure, shown); paint(); };
  new ResizeObserver(paint).observe(canvas);
  matchMedia('(prefers-color-scheme:dark)').addEventListener('change', paint);
}
const place = document.getElementById('figures');
for (const figure of figures) if (figure && Array.isArray(figure.series)) draw(figure, place);
})();
)js";

}  // namespace feedtwin::tools
