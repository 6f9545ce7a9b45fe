// The BarrettHand BH8-262, half closed, drawn as one rigid body on the flange plane. Millimetres, degrees.
import { Parts } from './parts.mjs';
import { Manifold, alongY, block, cos, cylinder, mirrored, plate, rectangle, screw, sin } from './shapes.mjs';

const HAND = {  // ORV lengths; palm box GraspIt, moved from its finger plane to the flange
  fingerPlane: 91.5, spreadY: 25, fixedX: -50, phalanges: [50, 70, 56],
  palm: { x: [-64.4, 44.5], y: 44.5, z: [8.6, 80] }, pad: 104.3,
  proximal: 75, distal: 67,  // half closed: proximal from the palm plane, distal from the proximal
};
const ADAPTER = 40;  // radius on the flange

export function hand() {
  const [bottom, top] = HAND.palm.z;
  const split = 56;  // between the housing and the top plate
  const parts = new Parts()
    .add('graphite', cylinder(ADAPTER, 0.4, bottom + 1, 1.5), palm(0, bottom, split - 1), palm(3, split - 4, split + 4))
    .add('aluminium', palm(0, split, top))
    .add('graphite', block([-36, -16, top - 4], [30, 16, HAND.pad], 5));
  const lid = alongY(plate(rectangle(26, 15, 5), 40, HAND.palm.y + 1)).translate([8, 0, 31]);
  const screws = [-21, 21].flatMap(x => [-10, 10].map(z => alongY(screw(4, 1)).translate([8 + x, HAND.palm.y + 1, 31 + z])));
  const inward = solid => solid.mirror([0, 1, 0]);
  parts.add('aluminium', lid, inward(lid)).add('steel', ...screws, ...screws.map(inward));
  for (const side of [-1, 1]) parts.addAll(spreadFinger(), solid => solid.translate([0, side * HAND.spreadY, 0]));
  return parts.addAll(fixedFinger(), mirrored);
}

/** The palm's outline from above, `inset` from its skin, between two heights, its edges bevelled. */
function palm(inset, z0, z1) {
  const { x: [back, front], y } = HAND.palm;
  const outline = by => {
    const w = y - by, f = front - by, b = back + by;
    return [[f, -w, 14], [f, w, 14], [-30, w, 14], [b, 20, 10], [b, -20, 10], [-30, -w, 14]];
  };
  return Manifold.hull([plate(outline(inset), z0 + 2, z1 - 2), plate(outline(inset + 2), z0, z1)]);
}

/** A bar with round ends between two points of the x-z plane, `width` wide in y. */
function bar([x0, z0], [x1, z1], r0, r1, width, edge = 2.5) {
  const end = (r, x, z) => alongY(cylinder(r, -width / 2, width / 2, edge, 20)).translate([x, 0, z]);
  return Manifold.hull([end(r0, x0, z0), end(r1, x1, z1)]);
}

/** Proximal and distal phalanges from a knuckle at (x, z), opening towards +x. */
function phalanges(x, z) {
  const [, proximal, distal] = HAND.phalanges;
  const a = HAND.proximal, b = HAND.proximal + HAND.distal;
  const knee = [x + proximal * cos(a), z + proximal * sin(a)];
  const tip = [knee[0] + (distal - 7) * cos(b), knee[1] + (distal - 7) * sin(b)];
  const along = (from, angle, s, inward) => [from[0] + s * cos(angle) - inward * sin(angle), from[1] + s * sin(angle) + inward * cos(angle)];
  const pin = ([px, pz], r, half) => alongY(cylinder(r, -half, half, 1, 16)).translate([px, 0, pz]);
  return new Parts()
    .add('aluminium', bar(along([x, z], a, 0, 0), along(knee, a, 0, 0), 10, 9, 15), bar(knee, tip, 8.5, 7, 17))
    .add('graphite', pin([x, z], 7, 11.5), pin(knee, 6, 10.5))
    .add('graphite', bar(along([x, z], a, 20, 6), along(knee, a, -18, 5.2), 4.5, 4.5, 12, 1.5))
    .add('graphite', bar(along(knee, b, 16, 4.5), along(tip, b, -2, 3.6), 4.5, 4.5, 13, 1.5));
}

function spreadFinger() {
  const x = HAND.phalanges[0], z = HAND.fingerPlane;
  return phalanges(x, z)
    .add('aluminium', cylinder(14, HAND.palm.z[1] - 2, z + 9, 3, 32), Manifold.hull([
      cylinder(13, z - 8, z + 6, 3, 32), block([x - 16, -11, z - 8], [x - 10, 11, z + 6], 3)]))
    .add('aluminium', ...[-1, 1].map(side => bar([x - 16, z], [x, z], 9, 9.5, 4, 1).translate([0, side * 10, 0])))
    .add('graphite', cylinder(6, z + 7, z + 10.5, 1, 24));
}

/** The finger opposite the other two, drawn facing +x. */
function fixedFinger() {
  const z = HAND.fingerPlane, x = -HAND.fixedX, floor = HAND.palm.z[1];
  const cheek = Manifold.hull([
    bar([x, z], [x + 0.1, z], 9.5, 9.5, 5, 1), block([x - 14, -2.5, floor - 4], [x + 11, 2.5, floor], 1),
  ]);
  return phalanges(x, z).add('aluminium', ...[-1, 1].map(side => cheek.translate([0, side * 10.5, 0])));
}
