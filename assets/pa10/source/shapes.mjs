// Solids from rounded profiles. Lengths in millimetres, angles in degrees, z up.
import Module from 'manifold-3d';

const wasm = await Module();
wasm.setup();
export const { Manifold, CrossSection } = wasm;

// [deg] of arc per facet of a fillet: coarse, middling, large.
const filletStep = radius => radius < 4 ? 30 : radius < 20 ? 18 : 10;

// Math.sin may differ in the last bit between versions of Node, sums and products may not.
const radians = degrees => degrees * (Math.PI / 180);
function series(x, term, k) {
  let sum = term;
  for (; k < 40; k += 2) sum += term *= -x * x / (k * (k + 1));
  return sum;
}
export const sin = degrees => { const x = radians(degrees % 360); return series(x, x, 2); };
export const cos = degrees => series(radians(degrees % 360), 1, 1);

/** A polygon of corners [x, y, fillet radius]; a corner without a radius stays sharp. */
export function rounded(corners) {
  const n = corners.length;
  const outline = corners.flatMap((corner, i) =>
    fillet(corners[(i + n - 1) % n], corner, corners[(i + 1) % n]));
  return new CrossSection([outline], 'EvenOdd');
}

function fillet(before, [x, y, radius = 0], after) {
  if (!radius) return [[x, y]];
  const towards = ([px, py]) => {
    const length = Math.sqrt((px - x) ** 2 + (py - y) ** 2);
    return { u: [(px - x) / length, (py - y) / length], length };
  };
  const a = towards(before), b = towards(after);
  const dot = a.u[0] * b.u[0] + a.u[1] * b.u[1];
  const sinHalf = Math.sqrt((1 - dot) / 2), cosHalf = Math.sqrt((1 + dot) / 2);
  const reach = radius * cosHalf / sinHalf;
  if (reach > a.length + 1e-9 || reach > b.length + 1e-9)
    throw new Error(`fillet ${radius} does not fit at (${x}, ${y})`);
  const bisector = [(a.u[0] + b.u[0]) / (2 * cosHalf), (a.u[1] + b.u[1]) / (2 * cosHalf)];
  const centre = [x + bisector[0] * radius / sinHalf, y + bisector[1] * radius / sinHalf];
  const start = [x + a.u[0] * reach - centre[0], y + a.u[1] * reach - centre[1]];
  const end = [x + b.u[0] * reach - centre[0], y + b.u[1] * reach - centre[1]];
  return arc(centre, start, end, 180 - 2 * degreesOf(sinHalf), filletStep(radius));
}

// The angle in [0, 90] with this sine, by bisection.
function degreesOf(sine) {
  let low = 0, high = 90;
  for (let i = 0; i < 40; ++i) {
    const middle = (low + high) / 2;
    if (sin(middle) < sine) low = middle; else high = middle;
  }
  return low;
}

function arc(centre, start, end, sweep, step) {
  const steps = Math.max(1, Math.ceil(sweep / step - 0.5));
  const sign = start[0] * end[1] - start[1] * end[0] > 0 ? 1 : -1;
  const points = [];
  for (let i = 0; i <= steps; ++i) {
    const s = sign * sin(sweep * i / steps), c = cos(sweep * i / steps);
    points.push([centre[0] + c * start[0] - s * start[1], centre[1] + s * start[0] + c * start[1]]);
  }
  return points;
}

/** Turns the z axis to x or y. */
export const alongX = solid => solid.rotate([0, 90, 0]);
export const alongY = solid => solid.rotate([-90, 0, 0]);

/** A profile of corners [radius, z, fillet] turned about z. */
export const turned = (corners, segments = 48) => Manifold.revolve(rounded(corners), segments);

export const cylinder = (radius, z0, z1, edge = 0, segments = 48) =>
  turned([[0, z0], [radius, z0, edge], [radius, z1, edge], [0, z1]], segments);

export const tube = (inner, outer, z0, z1, edge = 0, segments = 48) =>
  turned([[inner, z0], [outer, z0, edge], [outer, z1, edge], [inner, z1]], segments);

/** A box between two corners, its edges rounded all over. */
export function block([x0, y0, z0], [x1, y1, z1], edge = 0, segments = 12) {
  if (!edge) return Manifold.cube([x1 - x0, y1 - y0, z1 - z0]).translate([x0, y0, z0]);
  const ball = Manifold.sphere(edge, segments);
  const inset = (low, high) => [low + edge, high - edge];
  return Manifold.hull(inset(x0, x1).flatMap(x => inset(y0, y1).flatMap(y =>
    inset(z0, z1).map(z => ball.translate([x, y, z])))));
}

/** A rounded outline in the x-y plane, from z0 to z1. */
export const plate = (corners, z0, z1) => rounded(corners).extrude(z1 - z0).translate([0, 0, z0]);

/** The four corners of a rectangle about the origin, for plate(). */
export const rectangle = (x, y, edge) => [[-x, -y, edge], [x, -y, edge], [x, y, edge], [-x, y, edge]];

/** Copies at `count` equal angles about z, the first at `start`. */
export const ring = (count, solid, start = 0) => Manifold.union(
  Array.from({ length: count }, (_, i) => turn(solid, start + 360 * i / count)));

// rotate() by our own sine and cosine.
export function turn(solid, degrees) {
  const c = cos(degrees), s = sin(degrees);
  return solid.transform([c, s, 0, 0, -s, c, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
}

export const mirrored = solid => solid.rotate([0, 0, 180]);
export const bothSides = solid => solid.add(mirrored(solid));

/** Socket head screw seated at z = 0: head of this diameter, with its hexagon socket. */
export function screw(diameter, height = diameter * 0.6) {
  const r = diameter / 2;
  const head = turned([[0, -1], [r, -1], [r, height * 0.8], [r * 0.85, height], [0, height]], 10);
  return head.subtract(Manifold.cylinder(height, r * 0.5, r * 0.5, 6).translate([0, 0, height * 0.4]));
}

const GLYPHS = {  // outlines on a grid 6 high; a second outline is the hole
  P: [4.6, [[0, 0], [0, 6], [3.2, 6], [4, 5.2], [4, 3], [3.2, 2.2], [1.1, 2.2], [1.1, 0]], [[1.1, 3.2], [2.9, 3.2], [2.9, 5], [1.1, 5]]],
  A: [4.6, [[0, 0], [0, 5.2], [0.8, 6], [3.2, 6], [4, 5.2], [4, 0], [2.9, 0], [2.9, 1.7], [1.1, 1.7], [1.1, 0]], [[1.1, 2.7], [2.9, 2.7], [2.9, 5], [1.1, 5]]],
  '-': [3.2, [[0.2, 2.4], [2.4, 2.4], [2.4, 3.5], [0.2, 3.5]]],
  1: [2.8, [[0.9, 0], [0.9, 4.6], [0, 4.1], [0, 5.2], [1.2, 6], [2, 6], [2, 0]]],
  0: [4.6, [[0.8, 0], [0, 0.8], [0, 5.2], [0.8, 6], [3.2, 6], [4, 5.2], [4, 0.8], [3.2, 0]], [[1.1, 1], [2.9, 1], [2.9, 5], [1.1, 5]]],
};

/** A line of text, its middle at the origin, letters `height` high. */
export function text(line, height) {
  let x = 0;
  const polygons = [];
  for (const letter of line) {
    const [advance, ...outlines] = GLYPHS[letter];
    for (const outline of outlines) polygons.push(outline.map(([px, py]) => [px + x, py]));
    x += advance;
  }
  const scale = height / 6;
  return new CrossSection(polygons, 'EvenOdd').translate([0.3 - x / 2, -3]).scale([scale, scale]);
}
