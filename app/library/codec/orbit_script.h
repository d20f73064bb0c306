/// What runs in the page of an orbit (orbit_page.h), by the browser alone.
#pragma once

namespace splatray {

inline constexpr const char* ORBIT_STYLE = R"(
html, body { margin: 0; height: 100%; background: #fff; font: 15px system-ui, sans-serif; overflow: hidden; }
canvas { width: 100%; height: 100%; display: block; touch-action: none; cursor: grab; }
#bar { position: fixed; left: 0; right: 0; bottom: 0; padding: 8px 12px; color: #222; background: #fffc; }
#bar button { font: inherit; margin-left: 8px; }
)";

inline constexpr const char* ORBIT_BODY = R"(<canvas id="view"></canvas>
<div id="bar"><span id="said">Drag to turn, wheel or two fingers to zoom, double click or double tap two points to measure.</span>
<button id="clear" hidden>Clear</button></div>
)";

inline constexpr const char* ORBIT_SCRIPT = R"(
'use strict';
const canvas = document.getElementById('view'), pen = canvas.getContext('2d');
const said = document.getElementById('said'), clear = document.getElementById('clear');
const rows = data.pictures.length / data.columns;
const view = { turn: 0, rise: 0, zoom: 1, x: 0, y: 0 };  // zoom about the middle, then moved by (x, y) of the window
const points = [];  // world

const add = (a, b, s) => [a[0] + b[0] * s, a[1] + b[1] * s, a[2] + b[2] * s];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const scaled = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
const unit = a => scaled(a, 1 / Math.hypot(...a));

function index() {
  const column = ((Math.round(view.turn) % data.columns) + data.columns) % data.columns;
  return Math.min(Math.max(Math.round(view.rise), 0), rows - 1) * data.columns + column;
}

/// A picture's decoded image, or the promise of it.
function load(picture, what) {
  const key = what + 'Image';
  if (!picture[key]) {
    picture[key] = new Image();
    picture[key].onload = draw;
    picture[key].src = picture[what];
  }
  return picture[key];
}

/// Where the picture lies in the window: it fits, then zoom and shift.
function place() {
  const fit = Math.min(canvas.width / data.width, canvas.height / data.height) * view.zoom;
  return { scale: fit, x: (canvas.width - data.width * fit) / 2 + view.x, y: (canvas.height - data.height * fit) / 2 + view.y };
}

/// The camera's axes, and the half height of the picture at distance 1, or its half height where it is orthographic.
function axes(picture) {
  const ahead = unit(add(picture.target, picture.eye, -1)), right = unit(cross(ahead, picture.up));
  const half = picture.ortho > 0 ? picture.ortho / 2 : Math.tan(picture.fov * Math.PI / 360);
  return { ahead, right, down: cross(ahead, right), half };
}

/// Position (x, y) in the picture, in half heights from its middle.
const centred = (x, y) => [(x - data.width / 2) / (data.height / 2), (y - data.height / 2) / (data.height / 2)];

/// The pixel that shows a place.
function project(picture, point) {
  const { ahead, right, down, half } = axes(picture), to = add(point, picture.eye, -1);
  const depth = picture.ortho > 0 ? 1 : dot(to, ahead);
  if (depth <= 0) return null;
  return [data.width / 2 + dot(to, right) / depth / half * data.height / 2,
          data.height / 2 + dot(to, down) / depth / half * data.height / 2];
}

/// The place that a pixel shows; null where nothing is.
function unproject(picture, x, y) {
  const image = load(picture, 'depth');
  if (!image.complete) return null;
  if (!picture.steps) {
    const paper = document.createElement('canvas');
    paper.width = picture.columns = image.naturalWidth;
    paper.height = picture.rows = image.naturalHeight;
    const context = paper.getContext('2d', { colorSpace: 'srgb' });
    context.drawImage(image, 0, 0);
    picture.steps = context.getImageData(0, 0, paper.width, paper.height).data;
  }
  const column = Math.floor(x / data.step), row = Math.floor(y / data.step);
  if (column < 0 || row < 0 || column >= picture.columns || row >= picture.rows) return null;
  const at = 4 * (row * picture.columns + column), step = 256 * picture.steps[at] + picture.steps[at + 1];
  if (step === 0) return null;
  const distance = data.near + (data.far - data.near) * step / 65535;
  const { ahead, right, down, half } = axes(picture);
  // The depth is that of its own pixel's centre.
  const [u, v] = centred((column + 0.5) * data.step, (row + 0.5) * data.step);
  if (picture.ortho > 0) return add(add(add(picture.eye, right, u * half), down, v * half), ahead, distance);
  return add(picture.eye, unit(add(add(ahead, right, u * half), down, v * half)), distance);
}

function lengthText(length) {
  const digits = Math.max(0, 3 - Math.floor(Math.log10(Math.max(length, 1e-9))));
  return length.toFixed(Math.min(digits, 6)) + (data.metres === 1 ? ' m' : data.metres > 0 ? ` (${(length * data.metres).toFixed(3)} m)` : ' units');
}

function draw() {
  const picture = data.pictures[index()], image = load(picture, 'image');
  if (!image.complete) return;
  const { scale, x, y } = place();
  pen.setTransform(1, 0, 0, 1, 0, 0);
  pen.clearRect(0, 0, canvas.width, canvas.height);
  pen.drawImage(image, x, y, data.width * scale, data.height * scale);
  pen.font = `${16 * devicePixelRatio}px system-ui, sans-serif`;
  pen.lineWidth = 2 * devicePixelRatio;
  const seen = points.map(point => project(picture, point)).map(at => at && [x + at[0] * scale, y + at[1] * scale]);
  seen.forEach((at, i) => {
    if (!at) return;
    pen.fillStyle = pen.strokeStyle = '#d4001a';
    pen.beginPath();
    pen.arc(at[0], at[1], 4 * devicePixelRatio, 0, 7);
    pen.fill();
    const before = i % 2 ? seen[i - 1] : null;
    if (!before) return;
    pen.beginPath();
    pen.moveTo(...before);
    pen.lineTo(...at);
    pen.stroke();
    const text = lengthText(Math.hypot(...add(points[i], points[i - 1], -1)));
    const middle = [(before[0] + at[0]) / 2 + 8, (before[1] + at[1]) / 2 - 8];
    pen.strokeStyle = '#fff';
    pen.lineWidth = 4 * devicePixelRatio;
    pen.strokeText(text, ...middle);
    pen.lineWidth = 2 * devicePixelRatio;
    pen.fillText(text, ...middle);
  });
  clear.hidden = points.length === 0;
}

/// Adds the place under a window's position to the measures.
function mark(clientX, clientY) {
  const { scale, x, y } = place(), picture = data.pictures[index()];
  const point = unproject(picture, (clientX * devicePixelRatio - x) / scale, (clientY * devicePixelRatio - y) / scale);
  if (point) points.push(point);
  const [a, b] = points.slice(-2);
  said.textContent = !point ? 'Nothing is there.'
    : points.length % 2 ? 'First point: ' + point.map(value => value.toFixed(3)).join(', ') + '. Double click the second one.'
      : 'Distance: ' + lengthText(Math.hypot(...add(b, a, -1)));
  draw();
}

function zoomAt(clientX, clientY, factor) {
  const zoom = Math.min(Math.max(view.zoom * factor, 0.5), 40), real = zoom / view.zoom;
  const px = clientX * devicePixelRatio - canvas.width / 2, py = clientY * devicePixelRatio - canvas.height / 2;
  view.x = px - (px - view.x) * real;
  view.y = py - (py - view.y) * real;
  view.zoom = zoom;
  draw();
}

const held = new Map();
let span = 0, tapped = { time: 0, x: 0, y: 0 };
canvas.addEventListener('pointerdown', event => {
  canvas.setPointerCapture(event.pointerId);
  held.set(event.pointerId, event);
  load(data.pictures[index()], 'depth');
  const near = Math.hypot(event.clientX - tapped.x, event.clientY - tapped.y) < 24;
  if (event.timeStamp - tapped.time < 400 && near) mark(event.clientX, event.clientY);
  tapped = { time: event.timeStamp, x: event.clientX, y: event.clientY };
});
canvas.addEventListener('pointermove', event => {
  const last = held.get(event.pointerId);
  if (!last) return;
  held.set(event.pointerId, event);
  if (held.size === 2) {
    const [a, b] = [...held.values()], now = Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
    if (span > 0) zoomAt((a.clientX + b.clientX) / 2, (a.clientY + b.clientY) / 2, now / span);
    span = now;
  } else if (event.shiftKey || event.buttons === 4) {
    view.x += (event.clientX - last.clientX) * devicePixelRatio;
    view.y += (event.clientY - last.clientY) * devicePixelRatio;
    draw();
  } else {
    view.turn -= (event.clientX - last.clientX) / canvas.clientWidth * data.columns;
    view.rise = Math.min(Math.max(view.rise + (event.clientY - last.clientY) / canvas.clientHeight * rows * 1.5, 0), rows - 1);
    draw();
  }
});
for (const name of ['pointerup', 'pointercancel']) canvas.addEventListener(name, event => { held.delete(event.pointerId); span = 0; });
canvas.addEventListener('wheel', event => {
  event.preventDefault();
  zoomAt(event.clientX, event.clientY, Math.exp(-event.deltaY * 0.0015));
}, { passive: false });
clear.addEventListener('click', () => { points.length = 0; draw(); });
addEventListener('keydown', event => {
  const turn = { ArrowLeft: 1, ArrowRight: -1 }[event.key], rise = { ArrowUp: 1, ArrowDown: -1 }[event.key];
  if (turn) view.turn = Math.round(view.turn) + turn;
  if (rise) view.rise = Math.min(Math.max(Math.round(view.rise) + rise, 0), rows - 1);
  if (turn || rise) draw();
});
function resize() {
  canvas.width = canvas.clientWidth * devicePixelRatio;
  canvas.height = canvas.clientHeight * devicePixelRatio;
  draw();
}
addEventListener('resize', resize);
view.rise = Math.floor((rows - 1) / 2);
resize();
// The others, so that turning does not wait for them.
data.pictures.forEach((picture, i) => setTimeout(() => load(picture, 'image'), 20 * i));
)";

}  // namespace splatray
