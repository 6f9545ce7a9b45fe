// The tables, and in a sentence what came of a scene.
import { make, fill, by_id } from './dom.js';
import { methods_of, of_both, report } from './data.js';

const figure = (scene, run, name) => {
  const column = scene.columns.findIndex((c) => c.name === name);
  return column < 0 ? 'n/a' : run.cells[column];
};

const run_of = (runs, method) => runs.find((run) => run.method === method);

// As in the terminal: two digits, or a whole number from 10 % on.
function share_of_dmp2(runs, run) {
  const dmp2 = run_of(runs, 'dmp2')?.metrics.torque_jump_nm;
  const jump = run.metrics.torque_jump_nm;
  if (jump == null || !(dmp2 > 0)) return 'n/a';
  const share = (100 * jump) / dmp2;
  return share < 10 ? String(Number(share.toPrecision(2))) : share.toFixed(0);
}

// What explains others is in the scene's own table alone, as in the overview of bench/columns.cpp.
const explaining = ['wave peak', 'ringing', 'resonance'];
const outcomes_of = (runs) =>
  [...new Set(runs.flatMap((run) => Object.keys(run.outcomes)))]
    .map((name) => [name, of_both(runs.map((run) => run.outcomes[name] ?? '0 %'))])
    .filter(([name]) => !explaining.includes(name))
    .map(([name, value]) => `${name} ${value}`)
    .join(', ');

const thousandths = (value, unit) => `${1e3 * value < 9.95 ? (1e3 * value).toPrecision(2) : (1e3 * value).toFixed(0)} m${unit}`;

// By how much a tool or, where there is none, a joint is missed.
function missed(scene, run, when) {
  const tool = run.metrics[`tool_tracking_${when}_m`];
  const turned = run.metrics[`tool_tracking_${when}_rad`];
  if (tool != null) return thousandths(tool, 'm') + (turned == null ? '' : `, ${thousandths(turned, 'rad')}`);
  const joints = run.metrics[`tracking_${when}_rad`];
  const unit = scene.columns.find(({ name }) => name === 'tracking_max_rad').heading.match(/\[(.*)\]/)[1];
  return joints == null ? 'n/a' : thousandths(joints, unit.replace('or m', 'or mm'));
}

const limited = (run) => {
  const share = run.metrics.limited_share;
  return share == null ? 'n/a' : String(Number((100 * share).toPrecision(2)));
};

const chip = (method) => make('span', { class: 'method', style: `--method: var(--${method})` }, method);

function table(head, rows) {
  return make('table', {}, make('thead', {}, head), make('tbody', {}, ...rows));
}

const head = (cells, texts) =>
  make('tr', {}, ...cells.map((c, i) => make('th', { scope: 'col', class: i < texts ? 'text' : 'number' }, c)));

export function show_overview(choose) {
  const numbers = [
    ['torque jump [N·m]', (s, runs) => of_both(runs.map((r) => figure(s, r, 'torque_jump_nm')))],
    ['order', (s, runs) => figure(s, runs[0], 'torque_jump_order')],
    ['peak torque rate [N·m/s]', (s, runs) => of_both(runs.map((r) => figure(s, r, 'torque_rate_peak_nm_s')))],
    ['error after a join', (s, runs) => missed(s, runs.at(-1), 'after_join_max')],
    ['largest error', (s, runs) => missed(s, runs.at(-1), 'max')],
    ['at a limit [%]', (s, runs) => limited(runs.at(-1))],
  ];
  const rows = report.scenes.flatMap((scene, s) =>
    methods_of(scene).map((method, i, methods) => {
      const runs = scene.runs.filter((run) => run.method === method);
      return make(
        'tr',
        { class: i === 0 ? 'first' : '' },
        i === 0
          ? make('th', { scope: 'rowgroup', rowspan: methods.length, class: 'text' },
              make('a', { href: `#${encodeURIComponent(scene.name)}`, onclick: () => choose(s) }, scene.name))
          : '',
        make('th', { scope: 'row', class: 'text' }, chip(method)),
        ...numbers.map(([, of]) => make('td', {}, of(scene, runs))),
        make('td', { class: 'text' }, outcomes_of(runs)),
      );
    }),
  );
  const headings = ['scene', 'method', ...numbers.map(([name]) => name)];
  const row = head(headings, 2);
  row.append(make('th', { scope: 'col', class: 'text' }, 'what came of it'));
  fill(by_id('overview'), table(row, rows));
}

const listed = (words) =>
  words.length < 2 ? words.join('') : `${words.slice(0, -1).join(', ')} and ${words.at(-1)}`;

function torque_sentence(scene, runs) {
  const dmp2 = run_of(runs, 'dmp2');
  const others = runs.filter((run) => run !== dmp2);
  const jump = (run) => figure(scene, run, 'torque_jump_nm');
  if (!dmp2 || !others.length || others.some((run) => run.metrics.torque_jump_nm == null))
    return runs.map((run) => `${run.method}: the torque jumps by up to ${jump(run)} N·m at a join.`).join(' ');
  const worst = others.reduce((a, b) => (b.metrics.torque_jump_nm > a.metrics.torque_jump_nm ? b : a));
  return `With dmp2 the torque steps by up to ${jump(dmp2)} N·m at a join; with ${listed(others.map((r) => r.method))} by at most ${jump(worst)} N·m, ${share_of_dmp2(runs, worst)} % of that.`;
}

// Values that differ are told by method, the same ones once.
function sentence(runs, name, value_of) {
  const methods = new Map();
  for (const run of runs) {
    const value = value_of(run);
    methods.set(value, [...(methods.get(value) ?? []), run.method]);
  }
  const capital = name[0].toUpperCase() + name.slice(1);
  if (methods.size === 1) return `${capital}: ${[...methods.keys()][0]} with ${runs.length > 1 ? 'every method' : runs[0].method}.`;
  return `${capital}: ${[...methods].map(([value, m]) => `${value} with ${listed(m)}`).join('; ')}.`;
}

function arm_sentences(scene, runs) {
  const names = [...new Set(runs.flatMap((run) => Object.keys(run.outcomes)))];
  const list = [torque_sentence(scene, runs), ...names.map((name) => sentence(runs, name, (run) => run.outcomes[name] ?? 'n/a'))];
  if (runs[0].arm !== 'ideal') list.push(sentence(runs, 'largest tracking error after a join', (run) => missed(scene, run, 'after_join_max')));
  if (runs.some((run) => run.metrics.limited_share > 0)) list.push(sentence(runs, 'time at a limit of the drives', (run) => `${limited(run)} %`));
  return list.join(' ');
}

const by_arm = (runs) => [...new Set(runs.map((run) => run.arm))].map((arm) => runs.filter((run) => run.arm === arm));
const arm_label = (arm) => `${arm[0].toUpperCase()}${arm.slice(1)} arm`;

// A paragraph for each arm.
export function headline(scene) {
  return by_arm(scene.shown).map((runs) =>
    make('p', {}, scene.arms.length > 1 ? make('b', {}, `${arm_label(runs[0].arm)}. `) : '', arm_sentences(scene, runs)));
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
      ...scene.shown.map((run) => make('td', {}, run.cells[c]))));
  const names = table(head(['', ...scene.shown.map((run) => chip(run.method))], 1), rows);
  const arms = by_arm(scene.shown);
  if (arms.length > 1)
    names.tHead.prepend(make('tr', { class: 'arms' }, make('td', {}),
      ...arms.map((runs) => make('th', { scope: 'colgroup', colspan: runs.length, class: 'number' }, arm_label(runs[0].arm)))));
  fill(by_id('figures'), names);
}

export function show_joins(scene, go) {
  const several = by_arm(scene.shown).length > 1;
  const rows = scene.shown.flatMap((run) =>
    run.joins.map((join, i) =>
      make('tr', { class: i === 0 ? 'first' : '' },
        i === 0 ? make('th', { scope: 'rowgroup', rowspan: run.joins.length, class: 'text' }, chip(run.method), several ? ` ${run.arm}` : '') : '',
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
    ['arm', scene.arms.join(', ')],
    ...Object.entries(report.versions).map(([name, value]) => [name, String(value)]),
  ];
  if (scene.overrides.length) facts.push(['set anew', scene.overrides.join(', ')]);
  fill(by_id('made'),
    make('dl', { class: 'facts' }, ...facts.map(([name, value]) => make('div', {}, make('dt', {}, name), make('dd', {}, value)))),
    make('pre', { tabindex: '0', 'aria-label': 'Scene file' }, scene.file));
}
