// Curves over time with one zoom and one cursor for all of them.
import uPlot from 'uplot';
import { make, fill, by_id } from './dom.js';
import { methods_of, of_both, row_at } from './data.js';
import { coordinate_label, digits, signal_label, ticks, unit_of } from './units.js';

const colour_of = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

const pale = '59'; // opacity of an arm's curves below another's

// What a scene's plots show of a coordinate of the primitives and a joint.
function panels(scene, coordinate, joint) {
  const u = unit_of(coordinate);
  const list = [
    { label: `Position of ${coordinate_label(coordinate)}`, unit: u, curve: `ref.${coordinate}` },
    { label: 'Velocity', unit: `${u}/s`, curve: `ref_vel.${coordinate}` },
    { label: 'Acceleration', unit: `${u}/s²`, curve: `ref_acc.${coordinate}` },
    { label: `Torque of joint ${joint}`, unit: 'N·m', curve: `torque.${joint}` },
  ];
  for (const curve of scene.curves)
    if (!curve.includes('.'))
      list.push({ ...signal_label(curve), curve, line: curve === 'wave_m' && scene.rim ? 1e3 * scene.rim : null });
  const error = `error.${joint}`;
  if (scene.largest(error) > 1e-7) {
    const small = scene.largest(error) < 1e-3;
    list.push({ label: `Tracking error of joint ${joint}`, unit: small ? 'µrad' : 'mrad', scale: small ? 1e6 : 1e3, curve: error });
  }
  return list;
}

// A curve that is all but constant is not blown up into noise.
function y_range(_, low, high) {
  if (low == null) return [0, 1];
  const middle = (low + high) / 2;
  const half = Math.max((high - low) / 2, 1e-6 * Math.abs(middle), 1e-9) * 1.08;
  return [middle - half, middle + half];
}

export class Plots {
  // `moved(time)`: the cursor was moved by hand.
  constructor(methods, moved) {
    this.methods = methods;
    this.moved = moved;
    this.plots = [];
    this.hidden = new Set();
    this.linking = false;
    new ResizeObserver(() => this.resize()).observe(by_id('plots'));
  }

  // Positions, velocities and so on of a coordinate, the torque of a joint, and what the scene adds.
  show(scene, coordinate, joint) {
    const same = this.scene === scene;
    const zoom = same && this.range ? this.range : [scene.time[0], scene.time.at(-1)];
    this.scene = scene;
    for (const { plot, box } of this.plots) {
      plot.destroy();
      box.remove();
    }
    this.plots = panels(scene, coordinate, joint).map((panel, i, all) => this.make({ ...panel, first: i === 0, last: i === all.length - 1 }));
    this.zoom(...zoom);
  }

  make(panel) {
    const readouts = methods_of(this.scene).map((method) =>
      make('span', { class: 'readout', style: `--method: var(--${method})`, 'data-method': method }));
    const title = make('div', { class: 'plot-head' },
      make('span', { class: 'plot-title' }, panel.label, make('span', { class: 'unit' }, panel.unit ? ` [${panel.unit}]` : '')),
      make('span', { class: 'readouts' }, ...readouts));
    const box = make('figure', { class: 'plot' }, title);
    by_id('plots').append(box);
    const { scale = 1 } = panel;
    const curves = this.scene.shown.map((run) => (scale === 1 ? run.curve(panel.curve) : run.curve(panel.curve).map((v) => scale * v)));
    const largest = scale * this.scene.largest(panel.curve);
    const plot = new uPlot(this.options(panel), [this.scene.time, ...curves], box);
    plot.over.setAttribute('role', 'img');
    plot.over.setAttribute('aria-label', `${panel.label} [${panel.unit}] over time [s]`);
    this.listen(plot);
    return { plot, box, readouts, curves, largest };
  }

  options(panel) {
    const { last } = panel;
    const ink = colour_of('--ink-2');
    const axis = { stroke: ink, font: '11px system-ui, sans-serif', grid: { stroke: colour_of('--grid'), width: 1 }, ticks: { stroke: colour_of('--grid'), width: 1, size: 4 } };
    return {
      width: this.width(),
      height: last ? 168 : 150,
      legend: { show: false },
      padding: [8, 12, last ? 0 : 4, 0],
      cursor: {
        y: false,
        drag: { x: true, y: false, setScale: true },
        points: { size: 6 },
        bind: { mouseleave: () => () => null, dblclick: (u) => () => (this.whole(), null) },
      },
      scales: { x: { time: false }, y: { range: y_range } },
      axes: [
        { ...axis, size: last ? 22 : 18, label: last ? 'time [s]' : undefined, labelFont: '12px system-ui, sans-serif', labelSize: 16, space: 60 },
        { ...axis, size: 58, space: 28, values: (_, splits) => ticks(splits) },
      ],
      series: [
        {},
        ...this.scene.shown.map((run) => {
          const { dash } = this.methods.find((m) => m.name === run.method);
          const below = run.arm !== this.scene.shown.at(-1).arm;
          const stroke = colour_of(`--${run.method}`) + (below ? pale : '');
          return {
            label: run.method,
            stroke,
            width: below ? 5 : 1.75,
            dash: dash[0] && !below ? dash : undefined,
            show: !this.hidden.has(run.method),
            points: { show: (u) => !below && this.sparse(u), size: 5, fill: stroke },
          };
        }),
      ],
      hooks: {
        drawAxes: [(u) => this.draw_below(u, panel)],
        draw: [(u) => this.place_cursor(u)],
        setScale: [(u, key) => key === 'x' && this.link(u)],
      },
    };
  }

  // Single ticks are marked where they can be told apart.
  sparse(u) {
    const { min, max } = u.scales.x;
    return row_at(this.scene.time, max) - row_at(this.scene.time, min) < u.over.clientWidth / 7;
  }

  draw_below(u, panel) {
    const { ctx, bbox } = u;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    ctx.lineWidth = devicePixelRatio;
    const line = (colour, dash, x0, y0, x1, y1) => {
      ctx.strokeStyle = colour;
      ctx.setLineDash(dash.map((d) => d * devicePixelRatio));
      ctx.beginPath();
      ctx.moveTo(x0, y0);
      ctx.lineTo(x1, y1);
      ctx.stroke();
    };
    const crowded = this.scene.joins.length > 12;
    for (const time of this.scene.joins) {
      const x = Math.round(u.valToPos(time, 'x', true)) + 0.5;
      line(colour_of(crowded ? '--rule' : '--join'), [3, 3], x, bbox.top, x, bbox.top + bbox.height);
    }
    ctx.fillStyle = colour_of('--ink-2');
    ctx.font = `${11 * devicePixelRatio}px system-ui, sans-serif`;
    ctx.textAlign = 'left';
    for (const { time, name } of panel.first ? this.scene.starts : [])
      ctx.fillText(name, u.valToPos(time, 'x', true) + 4 * devicePixelRatio, bbox.top + 11 * devicePixelRatio);
    if (panel.line != null) {
      const y = Math.round(u.valToPos(panel.line, 'y', true)) + 0.5;
      line(colour_of('--ink-2'), [], bbox.left, y, bbox.left + bbox.width, y);
      ctx.textAlign = 'right';
      ctx.fillText('rim', bbox.left + bbox.width - 4 * devicePixelRatio, y - 4 * devicePixelRatio);
    }
    ctx.restore();
  }

  link(u) {
    const { min, max } = u.scales.x;
    if (this.linking || min == null) return;
    this.linking = true;
    for (const { plot } of this.plots) if (plot !== u) plot.setScale('x', { min, max });
    this.linking = false;
    this.range = [min, max];
    this.on_zoom?.(min, max);
    this.cursor(this.time ?? min);
  }

  zoom(min, max) {
    const [first, last] = [this.scene.time[0], this.scene.time.at(-1)];
    const width = Math.min(Math.max(max - min, 4 * this.scene.tick), last - first);
    const from = Math.min(Math.max(min, first), last - width);
    this.plots[0].plot.setScale('x', { min: from, max: from + width });
  }

  zoom_at(time, factor) {
    const [min, max] = this.range;
    this.zoom(time - (time - min) * factor, time + (max - time) * factor);
  }

  whole() {
    this.zoom(this.scene.time[0], this.scene.time.at(-1));
  }

  set_hidden(method, hidden) {
    if (hidden) this.hidden.add(method);
    else this.hidden.delete(method);
    for (const { plot, readouts } of this.plots) {
      this.scene.shown.forEach((run, i) => run.method === method && plot.setSeries(i + 1, { show: !hidden }));
      readouts.find((readout) => readout.dataset.method === method).hidden = hidden;
    }
  }

  cursor(time) {
    this.time = time;
    const row = row_at(this.scene.time, time + 0.5 * this.scene.tick);
    for (const { plot, curves, readouts, largest } of this.plots) {
      this.place_cursor(plot);
      for (const readout of readouts) {
        const { method } = readout.dataset;
        const own = curves.filter((_, i) => this.scene.shown[i].method === method);
        readout.textContent = of_both(own.map((curve) => digits(curve[row], largest)));
        readout.hidden = this.hidden.has(method);
      }
    }
  }

  place_cursor(plot) {
    if (this.time != null) plot.setCursor({ left: plot.valToPos(this.time, 'x'), top: 0 }, false);
  }

  // Mouse: uPlot's own dragging zooms, moving moves the time. Touch: one finger moves the time, two zoom.
  listen(plot) {
    const { over } = plot;
    const time_at = (event) => plot.posToVal(event.clientX - over.getBoundingClientRect().left, 'x');
    const fingers = new Map();
    let pinch = null;
    const spread = () => {
      const x = [...fingers.values()].map((e) => e.clientX - over.getBoundingClientRect().left);
      return { middle: (x[0] + x[1]) / 2, apart: Math.max(20, Math.abs(x[0] - x[1])) };
    };
    over.addEventListener('pointermove', (event) => {
      if (event.pointerType !== 'mouse') fingers.has(event.pointerId) && fingers.set(event.pointerId, event);
      if (pinch && fingers.size === 2) {
        const now = spread();
        const width = (pinch.max - pinch.min) * (pinch.apart / now.apart);
        const from = pinch.time - width * (now.middle / over.clientWidth);
        this.zoom(from, from + width);
      } else if (event.buttons === 0 || event.pointerType !== 'mouse') this.moved(time_at(event));
    });
    over.addEventListener('pointerdown', (event) => {
      if (event.pointerType === 'mouse') return;
      fingers.set(event.pointerId, event);
      if (fingers.size !== 2) return;
      const { middle, apart } = spread();
      pinch = { apart, min: this.range[0], max: this.range[1], time: plot.posToVal(middle, 'x') };
    });
    for (const end of ['pointerup', 'pointercancel'])
      over.addEventListener(end, (event) => {
        fingers.delete(event.pointerId);
        pinch = null;
      });
    over.addEventListener('wheel', (event) => {
      if (!event.ctrlKey && !event.metaKey) return;
      event.preventDefault();
      this.zoom_at(time_at(event), Math.exp(0.004 * event.deltaY));
    }, { passive: false });
  }

  width() {
    return Math.max(240, Math.floor(by_id('plots').clientWidth));
  }

  ranges() {
    return this.plots.map(({ plot }) => [plot.scales.x.min, plot.scales.x.max]);
  }

  resize() {
    const width = this.width();
    for (const { plot } of this.plots)
      if (plot.width !== width) plot.setSize({ width, height: plot.height });
    if (this.plots.length && this.time != null) this.cursor(this.time);
  }
}
