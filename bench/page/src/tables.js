// The tables, and in a sentence what came of a scene.
import { make, fill, by_id } from './dom.js';
import { report } from './data.js';

const figure = (scene, run, name) => {
  const column = scene.columns.findIndex((c) => c.name === name);
  return column < 0 ? 'n/a' : run.cells[column];
};

const run_of = (scene, method) => scene.runs.find((run) => run.method === method);

// As in the terminal: two digits, or a whole number from 10 % on.
function share_of_dmp2(scene, run) {
  const dmp2 = run_of(scene, 'dmp2')?.metrics.torque_jump_nm;
  const jump = run.metrics.torque_jump_nm;
  if (jump == null || !(dmp2 > 0)) return 'n/a';
  const share = (100 * jump) / dmp2;
  return share < 10 ? String(Number(share.toPrecision(2))) : share.toFixed(0);
}

const outcomes_of = (run) =>
  Object.entries(run.outcomes)
    .map(([name, value]) => `${name} ${value}`)
    .join(', ');

const chip = (method) => make('span', { class: 'method', style: `--method: var(--${method})` }, method);

function table(head, rows) {
  return make('table', {}, make('thead', {}, head), make('tbody', {}, ...rows));
}

const head = (cells, texts) =>
  make('tr', {}, ...cells.map((c, i) => make('th', { scope: 'col', class: i < texts ? 'text' : 'number' }, c)));

export function show_overview(choose) {
  const numbers = [
    ['torque jump [N·m]', (s, r) => figure(s, r, 'torque_jump_nm')],
    ["of dmp2's [%]", share_of_dmp2],
    ['order', (s, r) => figure(s, r, 'torque_jump_order')],
    ['peak torque rate [N·m/s]', (s, r) => figure(s, r, 'torque_rate_peak_nm_s')],
    ['peak jerk [rad/s³]', (s, r) => figure(s, r, 'jerk_peak_rad_s3')],
    ['deviation [rad]', (s, r) => figure(s, r, 'deviation_peak_rad')],
  ];
  const rows = report.scenes.flatMap((scene, s) =>
    scene.runs.map((run, i) =>
      make(
        'tr',
        { class: i === 0 ? 'first' : '' },
        i === 0
          ? make('th', { scope: 'rowgroup', rowspan: scene.runs.length, class: 'text' },
              make('a', { href: `#${encodeURIComponent(scene.name)}`, onclick: () => choose(s) }, scene.name))
          : '',
        make('th', { scope: 'row', class: 'text' }, chip(run.method)),
        ...numbers.map(([, of]) => make('td', {}, of(scene, run))),
        make('td', { class: 'text' }, outcomes_of(run)),
      ),
    ),
  );
  const headings = ['scene', 'method', ...numbers.map(([name]) => name)];
  const row = head(headings, 2);
  row.append(make('th', { scope: 'col', class: 'text' }, 'what came of it'));
  fill(by_id('overview'), table(row, rows));
}

const listed = (words) =>
  words.length < 2 ? words.join('') : `${words.slice(0, -1).join(', ')} and ${words.at(-1)}`;

function torque_sentence(scene) {
  const dmp2 = run_of(scene, 'dmp2');
  const others = scene.runs.filter((run) => run !== dmp2);
  const jump = (run) => figure(scene, run, 'torque_jump_nm');
  if (!dmp2 || !others.length || others.some((run) => run.metrics.torque_jump_nm == null))
    return scene.runs.map((run) => `${run.method}: the torque jumps by up to ${jump(run)} N·m at a join.`).join(' ');
  const worst = others.reduce((a, b) => (b.metrics.torque_jump_nm > a.metrics.torque_jump_nm ? b : a));
  return `With dmp2 the torque steps by up to ${jump(dmp2)} N·m at a join; with ${listed(others.map((r) => r.method))} by at most ${jump(worst)} N·m, ${share_of_dmp2(scene, worst)} % of that.`;
}

// Values that differ are told by method, the same ones once.
function outcome_sentence(scene, name) {
  const methods = new Map();
  for (const run of scene.runs) {
    const value = run.outcomes[name] ?? 'n/a';
    methods.set(value, [...(methods.get(value) ?? []), run.method]);
  }
  const capital = name[0].toUpperCase() + name.slice(1);
  if (methods.size === 1) return `${capital}: ${[...methods.keys()][0]} with ${scene.runs.length > 1 ? 'every method' : scene.runs[0].method}.`;
  return `${capital}: ${[...methods].map(([value, m]) => `${value} with ${listed(m)}`).join(', ')}.`;
}

export function headline(scene) {
  const names = [...new Set(scene.runs.flatMap((run) => Object.keys(run.outcomes)))];
  return [torque_sentence(scene), ...names.map((name) => outcome_sentence(scene, name))].join(' ');
}

// "torque jump, order in dt" below "torque jump [N·m]" as "order in dt".
function shortened(columns) {
  let group = '';
  return columns.map(({ heading }) => {
    const [begin, ...rest] = heading.split(', ');
    if (rest.length && begin === group) return { heading: rest.join(', '), sub: true };
    group = begin.replace(/ \[.*/, '');
    return { heading, sub: false };
  });
}

// Figures downwards, methods across: that fits a phone.
export function show_figures(scene) {
  const rows = shortened(scene.columns).map(({ heading, sub }, c) =>
    make('tr', {}, make('th', { scope: 'row', class: sub ? 'text sub' : 'text' }, heading),
      ...scene.runs.map((run) => make('td', {}, run.cells[c]))));
  fill(by_id('figures'), table(head(['', ...scene.runs.map((run) => chip(run.method))], 1), rows));
}

export function show_joins(scene, go) {
  const rows = scene.runs.flatMap((run) =>
    run.joins.map((join, i) =>
      make('tr', { class: i === 0 ? 'first' : '' },
        i === 0 ? make('th', { scope: 'rowgroup', rowspan: run.joins.length, class: 'text' }, chip(run.method)) : '',
        make('td', {}, make('button', { type: 'button', class: 'link', title: 'Every tick around it', onclick: () => go(join.time) }, join.time.toFixed(3))),
        ...join.cells.map((cell) => make('td', {}, cell)))));
  const headings = scene.join_columns.map(({ heading }) => heading);
  fill(by_id('join-figures'), table(head(['method', 'time [s]', ...headings], 1), rows));
}

export function show_configuration(scene) {
  const run = scene.runs[0];
  const facts = [
    ['Bullet\'s tick', `${run.dt * 1e3} ms`],
    ['seed', String(run.seed)],
    ...Object.entries(report.versions).map(([name, value]) => [name, String(value)]),
  ];
  if (scene.overrides.length) facts.push(['set anew', scene.overrides.join(', ')]);
  fill(by_id('made'),
    make('dl', { class: 'facts' }, ...facts.map(([name, value]) => make('div', {}, make('dt', {}, name), make('dd', {}, value)))),
    make('pre', { tabindex: '0', 'aria-label': 'Scene file' }, scene.file));
}
