// The visual meshes of the Mitsubishi PA-10 (older 7C lengths) with a BarrettHand BH8-262.
// Ours entirely, drawn to published outer sizes; ../README.md names the sources.
// Millimetres, degrees; each link in its own frame: origin at its joint, axes parallel to the base's at q = 0.
import { createHash } from 'node:crypto';
import { mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { hand } from './hand.mjs';
import { objText } from './obj.mjs';
import { GAP, Parts, bore, cover, crossBarrel, groove, lettering, panel, radialScrews, seam, shoulder, slot } from './parts.mjs';
import {
  Manifold, alongX, alongY, block, bothSides, cos, cylinder, mirrored, plate, rectangle, ring, rounded, screw, sin, tube, turn, turned,
} from './shapes.mjs';

// Joint planes, each above the one before (OHRP, CHO: the older 7C).
const PLANE = { S1: 200, S2: 115, S3: 280, E1: 170, E2: 250, W1: 250, W2: 80 };

// Outer sizes. MESH: half, top, bottom, tail, connectorY, spigot[1], S1-S3 and E2 radius. CHO: E1 barrel, W2 radius.
// The rest is drawn to fit: slots leave 2.5 mm beside a barrel, fork floors clear the next link at its limit.
const BASE = { half: 117, top: 200, connectorY: -169, barrel: 98, collar: 110 };
const S1 = { half: 130, bottom: -11, about: PLANE.S2, radius: 72, disc: 110, slot: 82.5, floor: 36 };
const S2 = { half: 80, radius: 71, barrel: 60, spigot: [36, 322] };  // spigot: radius, top
const S3 = { half: 107, about: PLANE.E1, radius: 60, slot: 66.5, floor: 58 };
const E1 = { half: 64, radius: 56, neck: 42, barrel: 50, spigot: [36, 285] };
const E2 = { half: 81, about: PLANE.W1, radius: 44, slot: 53.5, sweep: 122 };  // sweep: of the wrist's tail
const W1 = { half: [54, 51], tail: -116, hub: 42, body: 46, neck: 36, top: 42 };
const W2 = { bottom: -36, radius: 40, pilot: 31.5 };  // pilot: of ISO 9409-1-50

const COLOURS = {  // sky_blue, light_grey: ORV, NTUA; the others are a choice
  sky_blue: [0.61, 0.89, 0.96],
  light_grey: [0.88, 0.88, 0.88],
  graphite: [0.20, 0.21, 0.23],
  aluminium: [0.78, 0.79, 0.80],
  steel: [0.62, 0.64, 0.67],
  navy: [0.09, 0.22, 0.42],
};

// ---- links

function base() {
  const foot = BASE.half;
  const parts = new Parts().add('sky_blue', turned([
    [0, 0], [foot, 0, 1.5], [foot, 18, 5], [BASE.barrel, 18, 5], [BASE.barrel, 148, 12], [BASE.collar, 162, 8],
    [BASE.collar, BASE.top - 14, 4], [0, BASE.top - 14],
  ], 72));
  parts.add('graphite', cylinder(BASE.collar - 8, 150, BASE.top, 0, 72), seam(BASE.barrel, 140));
  parts.cut('sky_blue', groove(BASE.barrel, 140).add(ring(8, cylinder(6.8, 11, 30, 0, 24).translate([108, 0, 0]), 22.5)));
  parts.add('steel', ring(8, screw(11, 7).translate([108, 0, 11]), 22.5));
  parts.add('navy', lettering('PA-10', 20, BASE.barrel, 84, 0));
  return parts.addAll(connectorBox());
}

function connectorBox() {
  const face = BASE.connectorY + 17;
  const plug = radius => new Parts()
    .add('steel', alongY(cylinder(radius, -9, 4, 1.5, 24)).add(alongY(plate(rectangle(radius + 4, radius + 4, 3), 0, 3.5))))
    .add('graphite', alongY(turned([[0, -17], [radius - 4, -17, 3], [radius - 2.5, -9], [radius - 2.5, 0], [0, 0]], 24)));
  const parts = new Parts().add('sky_blue', block([-66, face, 24], [66, -60, 132], 8, 16));
  parts.cut('sky_blue', alongY(plate(rectangle(50, 38, 6), face - 9, face + 2.5)).translate([0, 0, 78]));
  parts.add('graphite', alongY(plate(rectangle(50.5, 38.5, 6), face + 1.5, face + 4)).translate([0, 0, 78]));
  for (const [x, z, radius] of [[-22, 86, 19], [26, 92, 14], [26, 58, 11]])
    parts.addAll(plug(radius), solid => solid.translate([x, face, z]));
  return parts.add('steel', ...[-54, 54].flatMap(x => [36, 120].map(z =>
    alongY(screw(5, 1.5).rotate([180, 0, 0])).translate([x, face + 0.5, z]))));
}

/** The round lower end of a fork, its top rounded so that the hull above runs on smoothly. */
const foot = (radius, bottom, top) => turned([[0, bottom], [radius, bottom, 4], [radius, top, 22], [0, top]], 64);

function s1() {
  const { half } = S1;
  const outer = Manifold.hull([
    foot(S1.disc, S1.bottom, 26),
    crossBarrel(S1.radius, half - 8, 14, 64).translate([0, 0, S1.about]),
  ]);
  const parts = new Parts().add('light_grey', outer.subtract(slot(S1.slot, S1.floor, 12)));
  const face = alongY(cylinder(62, half - 8, half, 0));
  parts.cut('light_grey', bothSides(face.translate([0, 0, S1.about])).add(cylinder(BASE.collar - 6, -20, GAP)));
  return forkCovers(parts, 'sky_blue', 56, half, 8, S1.about, 12);
}

/** The covers on both cheeks of a fork whose outer faces are at y = ±(half - height). */
function forkCovers(parts, colour, radius, half, height, about, screws) {
  const place = solid => alongY(solid).translate([0, half - height, about]);
  const one = cover(colour, radius, height, screws);
  return parts.addAll(one, place).addAll(one, solid => mirrored(place(solid)));
}

function s2() {
  const top = PLANE.S3 - GAP;
  const parts = new Parts().add('sky_blue',
    crossBarrel(S2.radius, S2.half - 1.5, 9), shoulder(S2.radius, 66, S2.barrel, 92),
    turned([[0, 80], [S2.barrel, 80], [S2.barrel, top, 4], [0, top]]));
  parts.cut('sky_blue', groove(S2.barrel, 232));
  parts.add('graphite', seam(S2.barrel, 232), cylinder(S2.spigot[0], 240, S2.spigot[1], 2), bothSides(alongY(tube(40, 58, 70, S2.half))));
  parts.add('steel', radialScrews(8, 6, S2.barrel, 256, 22.5));
  const words = lettering('PA-10', 22, S2.barrel, 152, -90);
  parts.add('navy', turn(words, 90), turn(words, -90));
  return parts.addAll(panel(S2.barrel, 36, 108, 212)).addAll(panel(S2.barrel, 36, 108, 212), mirrored);
}

function s3() {
  const outer = Manifold.hull([
    foot(S3.radius, 0, 28),
    crossBarrel(S3.radius, S3.half - 7, 12).translate([0, 0, S3.about]),
  ]);
  const parts = new Parts().add('light_grey', outer);
  parts.cut('light_grey', slot(S3.slot, S3.floor, 8).add(saddle()).add(bore(S2.spigot, PLANE.S3)));
  return forkCovers(parts, 'sky_blue', 46, S3.half, 7, S3.about, 10);
}

/** Room for the forearm's neck at E1's limit, on either side of the fork's floor. */
function saddle() {
  const limit = 139, clear = E1.neck + 2.5;  // [deg], [mm] from the forearm's axis
  const x = z => ((S3.about - z) * cos(limit - 90) - clear) / sin(limit - 90);
  const wedge = [[x(S3.floor + 9), S3.floor + 9], [x(0), 0], [120, 0], [120, S3.floor + 9]];
  return bothSides(rounded(wedge).extrude(2 * S3.slot).rotate([90, 0, 0]).translate([0, S3.slot, 0]));
}

function e1() {
  const top = PLANE.E2 - GAP;
  const barrel = turned([
    [0, 60], [E1.neck, 60], [E1.neck, 142, 30], [E1.barrel, 174, 20], [E1.barrel, 228, 8],
    [E2.radius, top, 3], [0, top],
  ]);
  const parts = new Parts().add('sky_blue', 
    crossBarrel(E1.radius, E1.half - 1.5, 8), shoulder(E1.radius, 50, E1.neck, 74), barrel);
  parts.cut('sky_blue', groove(E1.barrel, 186));
  parts.add('graphite', seam(E1.barrel, 186), cylinder(E1.spigot[0], 210, E1.spigot[1], 2), bothSides(alongY(tube(30, 46, 55, E1.half))));
  return parts.add('steel', radialScrews(8, 5, E1.barrel, 214));
}

function e2() {
  const outer = Manifold.hull([
    foot(E2.radius, 0, 24),
    crossBarrel(E2.radius, E2.half - 5, 10).translate([0, 0, E2.about]),
  ]);
  const fork = block([-99, -E2.slot, E2.about], [99, E2.slot, 400]).add(crossBarrel(E2.sweep, E2.slot, 0, 96).translate([0, 0, E2.about]));
  const parts = new Parts().add('light_grey', outer.subtract(fork).subtract(bore(E1.spigot, PLANE.E2)));
  return forkCovers(parts, 'sky_blue', 34, E2.half, 5, E2.about, 8);
}

function w1() {
  const [x, y] = W1.half;
  const body = turned([
    [0, W1.tail], [W1.body, W1.tail, 26], [W1.body, -30], [0, -30],
  ]);
  const neck = turned([[0, 0], [W1.neck, 0], [W1.neck, W1.top, 3], [0, W1.top]]);
  const parts = new Parts().add('sky_blue',
    crossBarrel(W1.hub, y - 1.5, 5), shoulder(W1.hub, 40, W1.body, -30), body, neck);
  const lid = alongX(plate(rectangle(33, 26, 8), 30, x - 2)).translate([0, 0, -62]);
  parts.add('light_grey', bothSides(lid));
  const screws = [-26, 26].flatMap(dz => [-19, 19].map(dy => alongX(screw(6, 2)).translate([x - 2, dy, dz - 62])));
  return parts.add('steel', bothSides(Manifold.union(screws)))
    .add('graphite', bothSides(alongY(tube(20, 34, 44, y))), cylinder(30, W1.top - 4, W1.top + GAP));
}

function w2() {
  const parts = new Parts().add('sky_blue', turned([
    [0, W2.bottom], [W2.radius, W2.bottom, 3], [W2.radius, -16, 3], [0, -16],
  ]));
  parts.add('steel', tube(12, W2.pilot + 4, -20, 0, 1));
  parts.cut('steel', ring(8, cylinder(3, -9, 1, 0, 12).translate([25, 0, 0])));
  return parts.add('graphite', seam(W2.radius, -25)).cut('sky_blue', groove(W2.radius, -25));
}

// ---- files

const LINKS = { base, S1: s1, S2: s2, S3: s3, E1: e1, E2: e2, W1: w1, W2: w2, hand };
const SOURCES = ['package.json', 'package-lock.json', 'pa10.mjs', 'hand.mjs', 'parts.mjs', 'shapes.mjs', 'obj.mjs'].map(name => `source/${name}`);
const root = new URL('..', import.meta.url);

function materialFile() {
  return Object.entries(COLOURS).map(([name, rgb]) =>
    `newmtl ${name}\nKd ${rgb.join(' ')}\nKs 0.2 0.2 0.2\nNs 40\nd 1\n`).join('\n');
}

function meshFiles() {
  const files = { 'meshes/pa10.mtl': materialFile() };
  for (const [link, make] of Object.entries(LINKS))
    for (const [colour, solids] of Object.entries(make().solids)) {
      const solid = Manifold.union(solids).simplify(0.01);
      if (solid.status() !== 'NoError' || solid.isEmpty()) throw new Error(`${link} ${colour}: ${solid.status()}`);
      const { text, triangles } = objText(solid, colour, 'pa10.mtl');
      files[`meshes/${link}_${colour}.obj`] = text;
      console.log(`${link}_${colour}`.padEnd(18), `${triangles} triangles`);
    }
  return files;
}

const sum = (name, content) => `${createHash('sha256').update(content).digest('hex')}  ${name}\n`;

function writeMeshes() {
  const files = meshFiles();
  const sums = [
    ...SOURCES.map(name => sum(name, readFileSync(new URL(name, root)))),
    ...Object.entries(files).map(([name, content]) => sum(name, content)),
  ];
  rmSync(new URL('meshes/', root), { recursive: true, force: true });
  mkdirSync(new URL('meshes/', root));
  for (const [name, content] of Object.entries({ ...files, 'meshes/SHA256SUMS': sums.join('') }))
    writeFileSync(new URL(name, root), content);
}

writeMeshes();
