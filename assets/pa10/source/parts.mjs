// Parts that several links share. Millimetres, degrees.
import { Manifold, alongX, alongY, cos, cylinder, plate, rectangle, ring, screw, sin, text, tube, turn, turned } from './shapes.mjs';

export const GAP = 2;  // between parts that turn on each other

/** A link's solids, gathered by colour. */
export class Parts {
  solids = {};
  add(colour, ...solids) { (this.solids[colour] ??= []).push(...solids); return this; }
  addAll(other, place = solid => solid) {
    for (const [colour, solids] of Object.entries(other.solids)) this.add(colour, ...solids.map(place));
    return this;
  }
  cut(colour, tool) { this.solids[colour] = [Manifold.union(this.solids[colour]).subtract(tool)]; return this; }
}

/** A round cover on a face at z = 0, thickness `height`, with screws and a cap in the middle. */
export function cover(colour, radius, height, screws) {
  const rim = height - 1.5, cap = radius * 0.5, dish = radius * 0.66;
  return new Parts()
    .add(colour, turned([
      [0, -4], [radius, -4], [radius, rim, 2], [dish, rim], [dish - 1, rim - 2], [cap, rim - 2], [cap, height, 2], [0, height],
    ]))
    .add('graphite', tube(radius - 2, radius + 1.5, -3, 0.6))
    .add('steel', ring(screws, screw(radius * 0.15, 2).translate([radius * 0.83, 0, rim - 0.5]), 180 / screws));
}

/** A dark joint line around a barrel of this radius, and the groove that holds it. */
export const seam = (radius, z) => tube(radius - 4, radius - 0.6, z - 1.2, z + 1.2);
export const groove = (radius, z) => tube(radius - 2.5, radius + 5, z - 1.2, z + 1.2);

/** Radial screws around a barrel. */
export const radialScrews = (count, diameter, radius, z, start = 0) =>
  ring(count, alongX(screw(diameter, diameter * 0.35)).translate([radius - 0.3, 0, z]), start);

/** A raised panel on a barrel about +x: half width in degrees, between z0 and z1. */
export function panel(radius, halfAngle, z0, z1) {
  const y = radius * sin(halfAngle), x = radius * cos(halfAngle);
  const window = alongX(plate(rectangle((z1 - z0) / 2, y, 8), x / 2, radius + 9)).translate([0, 0, (z0 + z1) / 2]);
  const corner = (angle, z) => turn(alongX(screw(5, 1)).translate([radius + 0.9, 0, z]), angle);
  const inset = halfAngle - 400 / radius;
  return new Parts()
    .add('sky_blue', tube(radius - 3, radius + 1.2, z0, z1, 0.4, 96).intersect(window))
    .add('steel', ...[z0 + 8, z1 - 8].flatMap(z => [corner(-inset, z), corner(inset, z)]));
}

/** Letters on a barrel about its +x line, turned by `angle` from upright. */
export const lettering = (line, height, radius, z, angle) => tube(radius - 1, radius + 0.5, z - 90, z + 90, 0, 96)
  .intersect(text(line, height).extrude(radius + 9).rotate([0, 0, angle]).rotate([90, 0, 90]).translate([0, 0, z]));

/** A cross barrel along y with rounded ends. */
export const crossBarrel = (radius, half, edge, segments = 48) => alongY(cylinder(radius, -half, half, edge, segments));

/** The flesh between a cross barrel and the round section of `neck` radius at height z. */
export const shoulder = (radius, half, neck, z) =>
  Manifold.hull([crossBarrel(radius, half, 14), cylinder(neck, Math.min(z, z - 4), Math.max(z, z - 4))]);

/** The hole, from below z = 0, for a spigot that ends at `top` in the frame of a link whose child is at `plane`. */
export const bore = ([radius, top], plane) => cylinder(radius + GAP, -20, top - plane + GAP);

/** Everything between y = -half and half above `floor`, its lower corners rounded. */
export const slot = (half, floor, edge) => alongX(plate([
  [-floor, -half, edge], [-floor, half, edge], [-400, half], [-400, -half],
], -200, 200));
