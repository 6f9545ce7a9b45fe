import 'uplot/dist/uPlot.min.css';
import './style.css';
import { by_id, fill, make } from './dom.js';
import { methods_of, Pack, report } from './data.js';
import { Plots } from './plots.js';
import { View } from './view.js';
import { coordinate_label } from './units.js';
import { headline, show_configuration, show_figures, show_joins, show_overview } from './tables.js';

const around_join = 0.04; // [s] to either side
const frame = 1 / 60; // [s]

const hidden = new Set();
let scene = null;
let arms = 'both'; // or which of the scene's
let time = 0;
let playing = false;
let last_frame = null;

const plots = new Plots(report.methods, (at) => {
  if (!playing) go(at);
});
const view = new View(by_id('view'), report);

// Unpacks a scene when it is first looked at.
async function open(data) {
  if (data.time instanceof Float64Array) return;
  const pack = await Pack.open(data.pack);
  for (const run of data.runs) {
    const columns = pack.columns(run.values);
    run.curve = (name) => columns[data.curves.indexOf(name)];
  }
  data.time = pack.columns(data.time)[0];
  data.tick = data.runs[0].dt;
  data.joins = [...new Set(data.runs.flatMap((run) => run.joins.map((join) => join.time)))].sort((a, b) => a - b);
  data.largest = (name) =>
    Math.max(...data.shown.map((run) => run.curve(name)?.reduce((most, v) => Math.max(most, Math.abs(v)), 0) ?? 0));
  data.starts = starts(data);
  await view.unpack(data, pack);
}

// Where the primitives begin, by name.
function starts(data) {
  const running = data.runs.find((run) => run.motion)?.motion.running ?? [];
  return running.flatMap((primitive, i) => {
    const time = i / data.stage.frame_rate;
    if (primitive < 0 || primitive === running[i - 1]) return [];
    return [{ time: data.joins.findLast((join) => join <= time) ?? time, name: data.stage.primitives[primitive] }];
  });
}

// The runs on the arms that are shown.
function pick_arms(data) {
  const on = data.arms[arms] ?? data.arms[0];
  data.shown = data.runs.filter((run) => arms === 'both' || run.arm === on);
}

const arms_shown = (data) => [...new Set(data.shown.map((run) => run.arm))];

const coordinates = (data) => data.curves.filter((c) => c.startsWith('ref_acc.')).map((c) => c.slice(8));
const joints = (data) => data.curves.filter((c) => c.startsWith('torque.')).map((c) => c.slice(7));

async function choose(index) {
  const data = report.scenes[index];
  if (data === scene) return;
  play(false);
  await open(data);
  scene = data;
  pick_arms(data);
  const own = coordinates(data);
  const tool = own.filter((c) => !joints(data).includes(c));
  const option = (chosen) => (name) => make('option', { value: name, selected: name === chosen }, coordinate_label(name));
  fill(by_id('coordinate'), ...[...tool, ...joints(data)].map(option(data.figure)));
  fill(by_id('joint'), ...joints(data).map(option(data.torque)));
  for (const [i, tab] of [...by_id('tabs').children].entries()) {
    tab.setAttribute('aria-selected', i === index);
    tab.tabIndex = i === index ? 0 : -1;
  }
  by_id('scene').setAttribute('aria-labelledby', `tab-${index}`);
  by_id('title').textContent = data.title;
  show_arms();
  show_methods();
  show_join_buttons();
  show_configuration(data);
  show_runs();
  by_id('time').max = data.time.at(-1);
  by_id('time').step = data.tick;
  draw_plots();
  go(data.joins.at(-1) ?? 0);
  if (location.hash.slice(1) !== data.name) history.replaceState(null, '', `#${encodeURIComponent(data.name)}`);
}

// All that depends on which arms are shown.
function show_runs() {
  fill(by_id('headline'), ...headline(scene));
  show_figures(scene);
  show_joins(scene, zoom_to_join);
  view.show(scene, hidden);
}

function choose_arms(chosen) {
  if (scene.arms.length < 2) return;
  arms = chosen;
  pick_arms(scene);
  const focused = by_id('arms').contains(document.activeElement);
  show_arms();
  if (focused) by_id('arms').querySelector('[aria-pressed=true]').focus();
  show_runs();
  draw_plots();
  go(time);
}

function show_arms() {
  const several = scene.arms.length > 1;
  by_id('arms').hidden = !several;
  const button = (chosen, label, ...lines) =>
    make('button', {
      type: 'button', 'aria-pressed': String(arms === chosen), 'data-arms': String(chosen), title: 'Which arms are shown (A)',
      onclick: () => choose_arms(chosen),
    }, ...lines, label);
  const lines = [line('opacity="0.35" stroke-width="5"'), line('stroke-width="1.75"')];
  fill(by_id('arms'), ...scene.arms.map((arm, i) => button(i, `${arm} arm`, several && arms === 'both' ? lines[i] : '')), button('both', 'both'));
}

const draw_plots = () => plots.show(scene, by_id('coordinate').value, by_id('joint').value);

function show_tabs() {
  fill(by_id('tabs'), ...report.scenes.map((data, i) =>
    make('button', { type: 'button', role: 'tab', id: `tab-${i}`, 'aria-controls': 'scene', onclick: () => choose(i) }, data.name)));
  by_id('tabs').addEventListener('keydown', (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    event.stopPropagation();
    next_scene(step).then(() => by_id('tabs').querySelector('[aria-selected=true]').focus());
  });
}

const next_scene = (step) =>
  choose((report.scenes.indexOf(scene) + step + report.scenes.length) % report.scenes.length);

function show_methods() {
  fill(by_id('methods'), ...methods_of(scene).map((method, i) =>
    make('button', {
      type: 'button', class: 'toggle', style: `--method: var(--${method})`, 'data-method': method,
      'aria-pressed': String(!hidden.has(method)), title: `Show or hide (${i + 1})`, onclick: () => toggle(method),
    }, sample(method), method)));
}

// A bit of the method's line.
function sample(method) {
  const { dash } = report.methods.find((m) => m.name === method);
  return line(`stroke-width="2.5" ${dash[0] ? `stroke-dasharray="${dash}"` : ''}`);
}

function line(style) {
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  svg.setAttribute('viewBox', '0 0 26 6');
  svg.innerHTML = `<line x1="0" y1="3" x2="26" y2="3" stroke="currentColor" ${style}/>`;
  return svg;
}

function toggle(method) {
  if (!hidden.delete(method)) hidden.add(method);
  by_id('methods').querySelector(`[data-method="${method}"]`).setAttribute('aria-pressed', !hidden.has(method));
  plots.set_hidden(method, hidden.has(method));
  view.set_hidden(hidden);
}

// Joins that follow closely (a goal that a camera sees) share a button.
function show_join_buttons() {
  const apart = scene.joins.filter((join, i) => i === 0 || join - scene.joins[i - 1] > 0.1);
  const button = (label, title, act) => make('button', { type: 'button', title, onclick: act }, label);
  fill(by_id('joins'), button('Whole run', 'All of it (0)', () => plots.whole()),
    ...apart.map((join) => button(`Join ${join.toFixed(2)} s`, 'Every tick around it (J)', () => zoom_to_join(join))));
}

function zoom_to_join(join) {
  by_id('bar').scrollIntoView({ block: 'nearest' });
  plots.zoom(join - around_join, join + around_join);
  go(join);
}

function next_join(step) {
  const after = scene.joins.filter((join) => (step > 0 ? join > time + 1e-9 : join < time - 1e-9));
  const join = step > 0 ? (after[0] ?? scene.joins[0]) : (after.at(-1) ?? scene.joins.at(-1));
  if (join != null) zoom_to_join(join);
}

function go(at) {
  const end = scene.time.at(-1);
  time = Math.min(Math.max(at, 0), end);
  by_id('time').value = time;
  by_id('clock').textContent = `${time.toFixed(3)} s`;
  plots.cursor(time);
  view.at(time);
  by_id('primitive').textContent = view.doing(time);
}

function play(on) {
  playing = on;
  last_frame = null;
  const button = by_id('play');
  button.classList.toggle('playing', on);
  button.setAttribute('aria-label', on ? 'Pause' : 'Play');
  if (on && time >= scene.time.at(-1) - 1e-9) go(0);
  if (on) requestAnimationFrame(advance);
}

function advance(now) {
  if (!playing) return;
  const passed = last_frame == null ? 0 : Math.min(now - last_frame, 250) / 1e3;
  last_frame = now;
  go(time + passed * Number(by_id('speed').value));
  const [min, max] = plots.range;
  if (time > max && max - min < scene.time.at(-1)) plots.zoom(time, time + max - min);
  if (time >= scene.time.at(-1)) play(false);
  else requestAnimationFrame(advance);
}

const themes = ['auto', 'light', 'dark'];
const system_is_dark = matchMedia('(prefers-color-scheme: dark)');
let theme = 'auto';

function set_theme(chosen) {
  theme = chosen;
  document.documentElement.dataset.theme = theme === 'auto' ? (system_is_dark.matches ? 'dark' : 'light') : theme;
  by_id('theme').textContent = { auto: 'Auto', light: 'Light', dark: 'Dark' }[theme];
  try {
    localStorage.setItem('seam-theme', theme);
  } catch {
    // a browser that keeps nothing for files
  }
  repaint();
}

function kept_theme() {
  try {
    const kept = localStorage.getItem('seam-theme');
    return themes.includes(kept) ? kept : 'auto';
  } catch {
    return 'auto';
  }
}

function repaint() {
  if (!scene) return;
  draw_plots();
  plots.cursor(time);
  view.repaint();
}

const keys = {
  ' ': () => play(!playing),
  ArrowRight: (shift) => go(time + (shift ? scene.tick : frame)),
  ArrowLeft: (shift) => go(time - (shift ? scene.tick : frame)),
  Home: () => go(0),
  End: () => go(Infinity),
  '+': () => plots.zoom_at(time, 0.5),
  '=': () => plots.zoom_at(time, 0.5),
  '-': () => plots.zoom_at(time, 2),
  0: () => plots.whole(),
  j: () => next_join(1),
  J: () => next_join(-1),
  '[': () => next_scene(-1),
  ']': () => next_scene(1),
  g: () => set_layout('ghosts'),
  s: () => set_layout('side'),
  c: () => view.set_close(by_id('close-up').getAttribute('aria-pressed') !== 'true'),
  a: () => choose_arms({ both: 0, 0: 1, 1: 'both' }[arms]),
  t: () => set_theme(themes[(themes.indexOf(theme) + 1) % themes.length]),
  '?': () => by_id('help').click(),
};

function on_key(event) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const at = event.target;
  if (at.matches('select, input:not([type=range]), textarea')) return;
  if (event.key === ' ' && at.matches('button, summary, a')) return;
  if (at.id === 'view' && event.key.startsWith('Arrow')) return;
  if (at.matches('input[type=range]') && /^(Arrow|Home|End|Page)/.test(event.key)) return;
  if (at.matches('.scroll, pre') && /^(Arrow|Home|End|Page)/.test(event.key)) return;
  const method = /^[1-9]$/.test(event.key) && methods_of(scene)[event.key - 1];
  const act = method ? () => toggle(method) : keys[event.key];
  if (!act) return;
  event.preventDefault();
  act(event.shiftKey);
}

function set_layout(layout) {
  by_id('layout').value = layout;
  view.set_layout(layout);
}

function listen() {
  document.addEventListener('keydown', on_key);
  for (const id of ['coordinate', 'joint'])
    by_id(id).addEventListener('change', () => {
      if (id === 'coordinate' && joints(scene).includes(by_id(id).value)) by_id('joint').value = by_id(id).value;
      draw_plots();
      go(time);
    });
  by_id('play').addEventListener('click', () => play(!playing));
  by_id('time').addEventListener('input', () => {
    play(false);
    go(Number(by_id('time').value));
  });
  by_id('layout').addEventListener('change', () => set_layout(by_id('layout').value));
  by_id('solid').addEventListener('change', () => view.set_solid(by_id('solid').value));
  by_id('camera').addEventListener('click', () => view.reset_camera());
  by_id('close-up').addEventListener('click', () => keys.c());
  by_id('theme').addEventListener('click', () => keys.t());
  by_id('help').addEventListener('click', () => {
    const open = by_id('keys').toggleAttribute('hidden') === false;
    by_id('help').setAttribute('aria-expanded', open);
  });
  system_is_dark.addEventListener('change', () => set_theme(theme));
  addEventListener('hashchange', () => {
    const named = scene_named();
    if (named >= 0) choose(named);
  });
}

const scene_named = () => report.scenes.findIndex((data) => data.name === decodeURIComponent(location.hash.slice(1)));

function tell(trouble) {
  by_id('trouble').hidden = false;
  by_id('trouble').textContent = trouble;
}

async function start() {
  if (typeof DecompressionStream === 'undefined')
    return tell('This browser cannot unpack the data (it has no DecompressionStream): Chromium 80, Firefox 113, Safari 16.4 or newer can.');
  for (const { name, colour } of report.methods) document.documentElement.style.setProperty(`--own-${name}`, colour);
  set_theme(kept_theme());
  show_tabs();
  show_overview((i) => choose(i).then(() => by_id('tabs').scrollIntoView()));
  listen();
  by_id('footer').textContent = `Made by seam ${report.versions.seam}. This page is whole: it loads nothing from anywhere.`;
  await choose(Math.max(0, scene_named()));
  document.documentElement.dataset.ready = 'yes';
}

// For the test that drives the page.
window.seam_report = {
  get state() {
    return { scene: scene?.name, time, playing, ranges: plots.ranges(), hidden: [...hidden], on: scene && arms_shown(scene), ...view.state() };
  },
  picture: () => view.picture(),
};

start().catch((error) => {
  tell(`The page could not be drawn: ${error.message}`);
  throw error;
});
