// Names and units of what is drawn.

const linear = new Set(['x', 'y', 'z']);

// "wave_m" as "Wave [mm]".
export function signal_label(name) {
  const metres = name.endsWith('_m');
  const words = (metres ? name.slice(0, -2) : name).replaceAll('_', ' ');
  return { label: words[0].toUpperCase() + words.slice(1), ...(metres ? { unit: 'mm', scale: 1e3 } : { unit: '', scale: 1 }) };
}

export const unit_of = (coordinate) => (linear.has(coordinate) ? 'm' : 'rad');

const tool_words = { x: 'tool x', y: 'tool y', z: 'tool z', rx: 'tool rx', ry: 'tool ry', rz: 'tool rz' };
export const coordinate_label = (name) => tool_words[name] ?? `joint ${name}`;

const minus = (text) => text.replaceAll('-', '−');

// A value of a curve, with as many decimals as give four digits of its largest one.
export function digits(value, largest) {
  if (!Number.isFinite(value)) return '–';
  const decimals = 3 - Math.floor(Math.log10(largest || 1));
  const text = value.toFixed(Math.min(Math.max(decimals, 0), 6));
  return minus(Number(text) === 0 ? text.replace('-', '') : text);
}

// The numbers on an axis: as many decimals as the step between two asks for.
export function ticks(splits) {
  const step = splits[1] - splits[0];
  const whole = (d) => Math.abs(step * 10 ** d - Math.round(step * 10 ** d)) < 1e-3 * step * 10 ** d;
  const decimals = [0, 1, 2, 3, 4, 5, 6, 7].find(whole);
  if (decimals != null) return splits.map((v) => minus(v.toFixed(decimals)));
  return splits.map((v) => (v === 0 ? '0' : minus(v.toExponential(1))));
}
